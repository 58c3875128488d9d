// Tests selection by clicks, frames and keys.

import { check, equal } from "../viewer/check.mjs";
import { placed, testPlanner } from "./opened.mjs";

testPlanner("a click selects, Shift adds and removes, the floor clears", { smoke: true }, async (tab) => {
  await tab.click(10, 9.85);
  equal(await tab.selected(), ["/fixtures/2"]);
  equal(await tab.text(".properties h2"), "A3");
  await tab.click(10, 7.45, { modifiers: [] });
  equal(await tab.selected(), ["/fixtures/1"]);
  await tab.page.keyboard.down("Shift");
  await tab.click(10, 9.85);
  equal(await tab.selected(), ["/fixtures/1", "/fixtures/2"]);
  await tab.click(10, 7.45);
  equal(await tab.selected(), ["/fixtures/2"]);
  await tab.page.keyboard.up("Shift");
  await tab.click(2.5, 10);
  equal(await tab.selected(), []);
});

testPlanner("a frame to the right selects what lies inside, to the left what it touches", {}, async (tab) => {
  await tab.drag([18.6, 11.6], [21.5, 5.4]);
  equal(await tab.selected(), [], "not all copies of the row of tables");
  await tab.drag([18.6, 11.6], [24.6, 5.4]);
  equal(await tab.selected(), ["/fixtures/10"], "the row as a whole");
  await tab.drag([20.6, 8], [18.7, 5.7]);
  equal(await tab.selected(), ["/fixtures/10"], "the row is touched");
  await tab.drag([5.6, 16.2], [16.6, 13.9]);
  equal(await tab.selected(), ["/fixtures/8", "/fixtures/9"], "inside");
});

testPlanner("Esc in a frame restores the selection", {}, async (tab) => {
  await tab.click(10, 9.85);
  await tab.drag([5.6, 16.2], [16.6, 13.9], {
    during: async () => {
      equal((await tab.selected()).length, 2);
      await tab.press("Escape");
      equal(await tab.selected(), ["/fixtures/2"]);
    },
  });
  equal(await tab.selected(), ["/fixtures/2"]);
});

testPlanner("Ctrl+A takes everything but hidden and locked kinds", {}, async (tab) => {
  await tab.press("Control+a");
  const all = await tab.selected();
  check(all.length > 10 && all.includes("/transceivers/grids/0") && !all.includes("/room"), `${all}`);
  equal(new Set(all).size, all.length, "rows count once");
  await tab.push("#tab-layers");
  await tab.push('[data-key="lock-fixture"]');
  await tab.push('[data-key="show-grid"]');
  await tab.press("Escape", "Control+a");
  equal(await tab.selected(), ["/transceivers/keep_out/0"]);
  await tab.press("Escape");
  await tab.click(10, 9.85);
  equal(await tab.selected(), [], "a locked fixture");
  await tab.push('[data-key="lock-fixture"]');
  await tab.click(10, 9.85);
  equal(await tab.selected(), ["/fixtures/2"]);
});

testPlanner("one copy of a row is locked; Enter or a double click edits the row", {}, async (tab) => {
  await tab.click(17.2, 5);
  equal(await tab.selected(), ["fixtures/5#1"]);
  check((await tab.text(".properties")).includes("One copy of a row"), "the panel says so");
  const says = async (words) => {
    await tab.until((of) => document.querySelector(".notice").textContent.includes(of), words);
    await tab.page.evaluate(() => window.shelfbeamPlanner.planner.say(""));
    await tab.settle();
  };
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
});

testPlanner("a row is dissolved into single fixtures", {}, async (tab) => {
  await tab.click(17.2, 5);
  await tab.push('[data-key="dissolve"]');
  await tab.steps(1);
  equal(
    tab.json.fixtures.slice(5, 9).map(({ id }) => id),
    ["A1-east", "A2-east", "A3-east", "A4-east"],
  );
  equal(await tab.selected(), ["/fixtures/5", "/fixtures/6", "/fixtures/7", "/fixtures/8"], "all of them are selected");
  await tab.click(17.2, 5);
  equal(await tab.selected(), ["/fixtures/5"]);
});

testPlanner("labels and candidates of an element lead to it", {}, async (tab) => {
  await tab.point(11, 9.4);
  for (let k = 0; k < 6; ++k) await tab.page.mouse.wheel(0, -200);
  await tab.settle();
  await tab.click(11, 9.38);
  equal(await tab.selected(), ["/fixtures/2"], "source of the label");
  await tab.until(() => document.querySelector(".properties h2").textContent.startsWith("A3-front-"));
  await tab.press("Enter");
  equal(await tab.text(".properties h2"), "A3");
});

testPlanner("labels of a locked level cannot be selected", {}, async (tab) => {
  await tab.push("#tab-layers");
  const levels = await tab.page.evaluate(() => document.querySelectorAll('[data-key^="lock-level-"]').length);
  check(levels > 1, `${levels} levels can be locked`);
  await tab.point(11, 9.4);
  for (let k = 0; k < 6; ++k) await tab.page.mouse.wheel(0, -200);
  await tab.settle();
  const isLabel = async () => {
    await tab.click(11, 9.38);
    return tab.page.evaluate(() => window.shelfbeamPlanner.planner.selection.items[0]?.kind === "device");
  };
  equal(await isLabel(), true);
  for (let level = 0; level < levels; ++level) await tab.push(`[data-key="lock-level-${level}"]`);
  equal(await isLabel(), false);
  await tab.page.reload();
  await tab.push("#tab-layers");
  await tab.until(() => document.querySelector('[data-key="lock-level-0"][aria-pressed="true"]') !== null);
});

testPlanner("labels of a file name their place in it", { store: "market-hall" }, async (tab) => {
  await tab.until(() => window.shelfbeamPlanner.planner.document.labels.count > 0);
  await tab.page.evaluate(() => {
    const { document: store, selection } = window.shelfbeamPlanner.planner;
    const all = Array.from({ length: store.labels.count }, (_, index) => index);
    const index = all.find((one) => store.labels.pathOf(one) === null);
    selection.set([{ kind: "device", device: "label", index, path: null }]);
  });
  await tab.until(() => /planogram\.csv\D+\d/.test(document.querySelector(".properties dl")?.textContent ?? ""));
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
