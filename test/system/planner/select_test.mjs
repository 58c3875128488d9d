// Tests selection by clicks, frames and keys.

import { check, equal } from "../viewer/check.mjs";
import { placed, testPlanner } from "./opened.mjs";

testPlanner("a click selects, Shift adds and removes, the floor clears", { smoke: true }, async (tab) => {
  await tab.click(10, 9.85);
  equal(await tab.selected(), ["/fixtures/2"]);
  equal(await tab.text(".properties h2"), "A3");
  await tab.click(10, 7.45);
  equal(await tab.selected(), ["/fixtures/1"]);
  await tab.click(10, 9.85, { keys: ["Shift"] });
  equal(await tab.selected(), ["/fixtures/1", "/fixtures/2"]);
  await tab.click(10, 7.45, { keys: ["Shift"] });
  equal(await tab.selected(), ["/fixtures/2"]);
  await tab.click(2.5, 10);
  equal(await tab.selected(), []);
});

testPlanner("a frame to the right selects what lies inside, to the left what it touches", {}, async (tab) => {
  for (const [from, to, expected, why] of [
    [[18.6, 11.6], [21.5, 5.4], [], "not all copies of the row of tables"],
    [[18.6, 11.6], [24.6, 5.4], ["/fixtures/10"], "the row as a whole"],
    [[20.6, 8], [18.7, 5.7], ["/fixtures/10"], "the row is touched"],
    [[5.6, 16.2], [16.6, 13.9], ["/fixtures/8", "/fixtures/9"], "inside"],
  ]) {
    await tab.drag(from, to);
    equal(await tab.selected(), expected, why);
  }
  const during = async () => {
    equal((await tab.selected()).length, 2);
    await tab.press("Escape");
    equal(await tab.selected(), ["/fixtures/2"], "Esc restores the selection");
  };
  await tab.click(10, 9.85);
  await tab.drag([5.6, 16.2], [16.6, 13.9], { during });
  equal(await tab.selected(), ["/fixtures/2"]);
});

testPlanner("Ctrl+A takes everything but hidden and locked kinds", {}, async (tab) => {
  await tab.press("Control+a");
  const all = await tab.selected();
  check(all.length > 10 && all.includes("/transceivers/grids/0") && !all.includes("/room"), `${all}`);
  equal(new Set(all).size, all.length, "rows count once");
  await tab.push("#tab-layers");
  await tab.use("lock-fixture");
  await tab.use("show-grid");
  await tab.press("Escape", "Control+a");
  equal(await tab.selected(), ["/transceivers/keep_out/0"]);
  await tab.press("Escape");
  await tab.click(10, 9.85);
  equal(await tab.selected(), [], "a locked fixture");
  await tab.use("lock-fixture");
  await tab.click(10, 9.85);
  equal(await tab.selected(), ["/fixtures/2"]);
});

testPlanner("one copy of a row is locked; Enter or a double click edits the row", {}, async (tab) => {
  const says = async (words) => {
    await tab.notice(words);
    await tab.hush();
  };
  await tab.click(17.2, 5);
  equal(await tab.selected(), ["fixtures/5#1"]);
  check((await tab.text(".properties")).includes("One copy of a row"), "the panel says so");
  await tab.drag([17.2, 5], [18.2, 6]);
  await says("dissolve it");
  for (const key of ["ArrowRight", "Delete", "r", "Control+d", "Control+x"]) {
    await tab.press(key);
    await says("Press Enter to edit the row");
  }
  check(await tab.isUntouched(), "the store is untouched");
  await tab.press("Enter");
  equal(await tab.selected(), ["/fixtures/5"]);
  await tab.page.mouse.dblclick(...(await tab.at(17.2, 7.3)));
  await tab.settle();
  equal(await tab.selected(), ["/fixtures/5"]);
  await tab.press("ArrowRight");
  await tab.steps(1);
  equal(tab.json.fixtures[5].at, [17.46, 4.6]);
  await tab.press("Escape", "Escape");
  await tab.click(17.2, 5);
  await tab.use("dissolve");
  await tab.steps(2);
  const single = [5, 6, 7, 8].map((k) => `/fixtures/${k}`);
  equal(await tab.selected(), single, "all of them are selected");
  await tab.click(17.2, 5);
  equal(await tab.selected(), single.slice(0, 1));
});

testPlanner("labels of an element lead to it, unless their level is locked", {}, async (tab) => {
  const isLabel = async () => {
    await tab.click(11, 9.38);
    return tab.state(({ planner }) => planner.selection.items[0]?.kind === "device");
  };
  await tab.push("#tab-layers");
  const levels = await tab.count('[data-key^="lock-level-"]');
  check(levels > 1, `${levels} levels can be locked`);
  await tab.wheel(11, 9.4, -200, 6);
  equal(await isLabel(), true);
  equal(await tab.selected(), ["/fixtures/2"], "source of the label");
  await tab.until(() => document.querySelector(".properties h2").textContent.startsWith("A3-front-"));
  await tab.press("Enter");
  equal(await tab.text(".properties h2"), "A3");
  for (let level = 0; level < levels; ++level) await tab.use(`lock-level-${level}`);
  equal(await isLabel(), false);
  await tab.reload();
  await tab.push("#tab-layers");
  await tab.until(() => document.querySelector('[data-key="lock-level-0"][aria-pressed="true"]') !== null);
});

testPlanner("a listed label and a listed unit are elements", { store: "chiller" }, async (tab) => {
  await tab.click(0.9, 8.27);
  equal(await tab.selected(), ["/labels/0"]);
  await tab.drag([0.9, 8.27], [1.1, 8.07]);
  await tab.steps(1);
  placed(tab.json.labels[0].position, [1.1, 8.08, 0.9]);
  await tab.click(10.6, 2.6);
  equal(await tab.selected(), ["/transceivers/list/6"]);
  await tab.press("Shift+ArrowLeft");
  await tab.steps(2);
  equal(tab.json.transceivers.list[6].position, [10.5, 2.6, 3.15]);
});

testPlanner("the list shows one kind; chips keep one kind of the selection", {}, async (tab) => {
  for (const [kind, count] of Object.entries({ keep_out: 1, grid: 1, fixture: 13, room: 1 })) {
    await tab.page.selectOption(".objects select", kind);
    await tab.settle();
    equal(await tab.evaluate(() => document.querySelector(".object").ariaSetSize), String(count), kind);
    check((await tab.text(".objects .note")).includes(`${count} of 16 elements`), kind);
  }
  await tab.page.selectOption(".objects select", "");
  const selectAll = async () => {
    await tab.page.focus(".surface");
    await tab.press("Control+a");
  };
  await selectAll();
  equal(await tab.texts(".chip"), ["13 fixtures", "1 grid", "1 keep-out area"]);
  await tab.use("chip-fixture");
  equal((await tab.selected()).length, 13);
  equal(await tab.texts(".chip"), [], "one kind needs no chips");
  await selectAll();
  await tab.use("chip-grid");
  equal(await tab.selected(), ["/transceivers/grids/0"]);
});
