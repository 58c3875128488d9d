// Tests several tabs, refusals, lost connections and invalid files.

import { check, equal, says } from "../viewer/check.mjs";
import { placed, testPlanner } from "./opened.mjs";

testPlanner("two tabs show the same store", { smoke: true }, async (tab, given) => {
  const other = await given.tab(tab.server);
  await tab.click(10, 9.85);
  await tab.press("Shift+ArrowUp");
  await tab.steps(1);
  await other.steps(1);
  equal(await other.text(".notice"), "Another tab: Move A3");
  await other.click(10, 9.95);
  equal(await other.selected(), ["/fixtures/2"]);
  await other.press("Delete");
  await other.steps(2);
  await tab.steps(2);
  equal(await tab.selected(), [], "the deleted fixture is not selected any more");
  await tab.press("Control+z");
  await other.steps(1);
  equal(await other.text(".notice"), "Another tab: Undo Delete A3");
  await other.push("#tab-history");
  equal(await other.text(".history [aria-current]"), "Move A3");
});

testPlanner("a gesture follows its element when another tab moves places", {}, async (tab, given) => {
  const other = await given.tab(tab.server);
  const remove = async (x, y) => {
    const { length } = await other.labels();
    await other.click(x, y);
    await other.press("Delete");
    await other.steps(length + 1);
    await tab.steps(length + 1);
  };
  await tab.drag([10, 9.85], [11, 9.85], { during: () => remove(10, 7.45) });
  await tab.steps(2);
  equal((await tab.labels())[1], "Move A3");
  placed(tab.json.fixtures[1].at, [6, 9.4]);
  await tab.click(11, 14.4);
  await tab.dragPixels(await tab.grip("x1"), await tab.at(18, 14.6), { during: () => remove(10, 5.05) });
  await tab.drag([11, 14.4], [12, 13], { during: () => remove(11, 14.4) });
  equal((await tab.labels()).slice(2), ["Delete A1", "Delete F1"], "these gestures end without a change");
});

testPlanner("a refused edit goes back, says why, and is never called saved", {}, async (tab) => {
  tab.server.wire.refuse = "there is no space left on the disk";
  await tab.drag([10, 9.85], [11, 10.35]);
  await tab.until(() => document.querySelector(".saving").dataset.state === "refused");
  says(await tab.text(".notice"), "Not done: Move A3. there is no space left on the disk");
  says(await tab.text(".saving"), "Last change refused");
  equal(
    await tab.page.evaluate(() => window.shelfbeamPlanner.planner.document.parts.of("/fixtures/2")[0].footing.at),
    [5, 9.4],
  );
  tab.server.wire.refuse = null;
  await tab.drag([10, 9.85], [11, 10.35]);
  await tab.steps(1);
  equal(await tab.text(".saving"), "Saved");
});

testPlanner("an edit shows before the answer", {}, async (tab) => {
  const release = tab.server.wire.hold();
  await tab.drag([10, 9.85], [11, 9.85]);
  equal(await tab.text(".saving"), "Saving …");
  const shown = () =>
    tab.page.evaluate(() => window.shelfbeamPlanner.planner.document.parts.of("/fixtures/2")[0].footing.at);
  placed(await shown(), [6, 9.4]);
  await tab.click(10, 7.45);
  await tab.press("Delete");
  await tab.click(11, 14.4);
  await tab.press("ArrowRight");
  release();
  await tab.steps(3);
  equal([tab.json.fixtures.length, tab.json.fixtures[7].id, tab.json.fixtures[7].at], [12, "F1", [6.01, 14.2]]);
});

testPlanner("a lost connection is shown, edits wait for the next one", {}, async (tab) => {
  tab.server.wire.cut();
  await tab.until(() => document.querySelector(".saving").dataset.state === "lost");
  says(await tab.text(".banner"), "connection to shelfbeam is lost");
  await tab.click(10, 9.85);
  await tab.press("Shift+ArrowUp");
  tab.server.wire.mend();
  await tab.steps(1);
  await tab.until(() => document.querySelector(".banner").hidden);
  equal(await tab.text(".saving"), "Saved");
});

testPlanner("an invalid file locks drawing until it is restored", { alone: true }, async (tab) => {
  await tab.click(10, 9.85);
  await tab.press("Control+c");
  tab.server.spoil();
  await tab.until(() => !document.querySelector(".banner").hidden);
  says(await tab.text(".banner"), "store.json was changed by another program and is invalid", "store.json");
  const spoilt = tab.server.text;
  await tab.drag([10, 9.85], [11, 10.35]);
  await tab.press("ArrowRight", "Delete", "Control+z", "Control+v");
  says(await tab.text(".notice"), "The store file is invalid");
  equal(await tab.selected(), ["/fixtures/2"]);
  equal(await tab.page.evaluate(() => document.querySelector('[data-key="field/length"]').disabled), true);
  check(tab.server.text === spoilt, "the invalid file is untouched");
  await tab.push(".banner button");
  await tab.until(() => document.querySelector(".banner").hidden);
  await tab.drag([10, 9.85], [11, 10.35]);
  await tab.steps(1);
});

testPlanner("names with markup stay texts", {}, async (tab) => {
  const name = "<img src=x onerror=alert(1)>";
  await tab.click(11, 14.4);
  await tab.fill("field/id", name);
  await tab.steps(1);
  equal(await tab.text(".properties h2"), name);
  await tab.push("#tab-history");
  await tab.press("Control+f");
  await tab.page.keyboard.type("onerror");
  await tab.until(() => document.querySelectorAll(".results li").length > 0);
  check(!(await tab.page.$("img")), "no element from a name");
  await tab.press("Escape");
});
