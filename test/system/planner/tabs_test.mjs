// Tests several tabs, refusals, lost connections and invalid files.

import { check, equal, says } from "../viewer/check.mjs";
import { placed, testPlanner } from "./opened.mjs";

const shownAt = (tab) => tab.state(({ planner }) => planner.document.parts.of("/fixtures/2")[0].footing.at);

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
  const { wire } = tab.server;
  wire.refuse = "there is no space left on the disk";
  await tab.drag([10, 9.85], [11, 10.35]);
  await tab.until(() => document.querySelector(".saving").dataset.state === "refused");
  await tab.notice("Not done: Move A3. there is no space left on the disk");
  says(await tab.text(".saving"), "Last change refused");
  equal(await shownAt(tab), [5, 9.4]);
  wire.refuse = null;
  const release = wire.hold();
  await tab.drag([10, 9.85], [11, 10.35]);
  equal(await tab.text(".saving"), "Saving …");
  placed(await shownAt(tab), [6, 9.9], "shown before the answer");
  await tab.click(10, 7.45);
  await tab.press("Delete");
  await tab.click(11, 14.4);
  await tab.press("ArrowRight"); // its number is another by now
  release();
  await tab.steps(3);
  equal(await tab.text(".saving"), "Saved");
  const { length, 7: shifted } = tab.json.fixtures;
  equal([length, shifted.id, shifted.at], [12, "F1", [6.01, 14.2]]);
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
  const spoilt = tab.server.text.slice(0, -20);
  tab.server.write(spoilt);
  await tab.until(() => !document.querySelector(".banner").hidden);
  says(await tab.text(".banner"), "store.json was changed by another program and is invalid", "store.json");
  await tab.drag([10, 9.85], [11, 10.35]);
  await tab.press("ArrowRight", "Delete", "Control+z", "Control+v");
  await tab.notice("The store file is invalid");
  equal(await tab.selected(), ["/fixtures/2"]);
  check(await tab.has('[data-key="field/length"]:disabled'), "no value can be typed");
  check(tab.server.text === spoilt, "the invalid file is untouched");
  await tab.push(".banner button");
  await tab.until(() => document.querySelector(".banner").hidden);
  await tab.drag([10, 9.85], [11, 10.35]);
  await tab.steps(1);
});
