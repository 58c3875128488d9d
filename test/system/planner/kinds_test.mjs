// Tests what is special about kinds of elements: their handles, and what follows others.

import { check, equal } from "../viewer/check.mjs";
import { placed, testPlanner } from "./opened.mjs";

/** Selects an element in the list by its name. */
async function find(tab, name) {
  await tab.page.fill(".objects input[type=search]", name);
  await tab.settle();
  await tab.page.click(".object >> nth=0");
  await tab.settle();
  await tab.page.evaluate(() => document.querySelector(".surface").focus());
}

testPlanner(
  "the outline of a room moves with its slopes; corners and edges are dragged",
  { store: "market-hall" },
  async (tab) => {
    // Fixtures stand at all its walls.
    await find(tab, "Room");
    equal(await tab.selected(), ["/room"]);
    await tab.dragPixels(await tab.grip("vertex:/outline/2"), await tab.at(25, 5));
    await tab.steps(1);
    placed(tab.json.room.outline[2], [25, 5]);
    await tab.dragPixels(await tab.grip("edge:/outline/6"), await tab.at(-1, 6));
    await tab.steps(2);
    placed(
      [tab.json.room.outline[6], tab.json.room.outline[0]],
      [
        [-1, 12],
        [-1, 0],
      ],
    );
    await tab.press("Shift+ArrowUp");
    await tab.steps(3);
    placed(tab.json.room.outline[0], [-1, 0.1]);
  },
);

testPlanner("a room by its size stays at the origin", {}, async (tab) => {
  await tab.click(10, 0);
  equal(await tab.selected(), ["/room"]);
  await tab.press("ArrowRight");
  await tab.until(() => document.querySelector(".notice").textContent.includes("begins at the origin"));
  check(await tab.isUntouched(), "the store is untouched");
  await tab.dragPixels(await tab.grip("x1"), await tab.at(26, 9));
  await tab.steps(1);
  placed(tab.json.room.size, [26, 18, 3.6]);
});

testPlanner("grids, boxes and keep-out areas have handles", {}, async (tab) => {
  await tab.click(1, 5);
  equal(await tab.selected(), ["/transceivers/grids/0"]);
  await tab.dragPixels(await tab.grip("x1 y1"), await tab.at(23, 16));
  await tab.steps(1);
  placed(
    [tab.json.transceivers.grids[0].min, tab.json.transceivers.grids[0].max],
    [
      [1, 1],
      [23, 16],
    ],
  );
  await tab.click(21.5, 13.6);
  equal(await tab.selected(), ["/transceivers/keep_out/0"]);
  await tab.dragPixels(await tab.grip("x0"), await tab.at(19, 13.7));
  await tab.steps(2);
  placed(tab.json.transceivers.keep_out[0].min, [19, 12.5]);
});

testPlanner("what follows something else says so", { store: "market-hall" }, async (tab) => {
  await find(tab, "Area 1");
  await tab.press("ArrowRight");
  await tab.until(() => document.querySelector(".notice").textContent.includes("no place of its own"));
  check(await tab.isUntouched(), "the store is untouched");
});

testPlanner("the whole drawing moves, with its room", { store: "market-hall" }, async (tab) => {
  const { outline } = tab.json.room;
  const [fixture] = tab.json.fixtures.filter(({ at }) => at);
  await tab.press("Control+a", "Shift+ArrowRight");
  await tab.steps(1);
  equal(await tab.selected().then((paths) => paths.includes("/room")), true);
  outline.forEach(([x, y], k) => placed(tab.json.room.outline[k], [x + 0.1, y]));
  placed(tab.json.fixtures.find(({ id }) => id === fixture.id).at, [fixture.at[0] + 0.1, fixture.at[1]]);
  await tab.press("Control+z");
  await tab.steps(0);
  check(await tab.isUntouched(), "the store is untouched");
});
