// Tests each kind of element: moved, turned, edited, and undone.

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

const market = [
  ["bakery wall", "/room/inner_walls/0", "field/thickness", "0.2", ({ thickness }) => thickness === 0.2],
  ["sign", "/fixtures/12", "field/material", null, () => true],
  ["column", "/fixtures/11", "field/radius", "25cm", ({ radius }) => radius === 0.25],
  ["rail", "/transceivers/rails/0", "field/spacing", "2*0.6", ({ spacing }) => spacing === 1.2],
  ["Keep-out 1", "/transceivers/keep_out/0", "field/z/1", "4", ({ z }) => z[1] === 4],
  ["Area 3", "/transceivers/areas/2", "field/z", "3.4", ({ z }) => z === 3.4],
  // Last, because it then extends outside the room, which leaves nothing to resolve the others in.
  ["wing", "/room/zones/1", "field/id", "hall", ({ id }) => id === "hall"],
];

testPlanner("every kind of element moves, turns and changes", { store: "market-hall" }, async (tab) => {
  let steps = 0;
  for (const [name, path, field, typed, isChanged] of market) {
    const value = () =>
      path
        .split("/")
        .slice(1)
        .reduce((found, key) => found[key], tab.json);
    await find(tab, name);
    equal(await tab.selected(), [path]);
    const before = JSON.stringify(value());
    await tab.press("Shift+ArrowLeft"); // to the right, the wing would leave the room
    await tab.steps(++steps);
    check(JSON.stringify(value()) !== before, `${name} moves`);
    const moved = JSON.stringify(value());
    await tab.press("r");
    await tab.steps(++steps);
    check(JSON.stringify(value()) !== moved, `${name} turns`);
    if (typed === null) continue;
    await tab.fill(field, typed);
    await tab.steps(++steps);
    check(isChanged(value()), `${name}: ${JSON.stringify(value())}`);
  }
});

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
