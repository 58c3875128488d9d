// Tests what is special about kinds of elements: their handles, and what follows others.

import { check, equal } from "../viewer/check.mjs";
import { placed, testPlanner } from "./opened.mjs";

testPlanner("outlines of rooms move with their slopes, corners and edges", { store: "market-hall" }, async (tab) => {
  await tab.list("Room"); // fixtures stand at all its walls
  equal(await tab.selected(), ["/room"]);
  await tab.dragPixels(await tab.grip("vertex:/outline/2"), await tab.at(25, 5));
  await tab.steps(1);
  placed(tab.json.room.outline[2], [25, 5]);
  await tab.dragPixels(await tab.grip("edge:/outline/6"), await tab.at(-1, 6));
  await tab.steps(2);
  placed([...tab.json.room.outline[6], ...tab.json.room.outline[0]], [-1, 12, -1, 0]);
  await tab.press("Shift+ArrowUp");
  await tab.steps(3);
  placed(tab.json.room.outline[0], [-1, 0.1]);
});

testPlanner("rooms by their sizes, grids, and keep-out areas have handles", {}, async (tab) => {
  await tab.click(10, 0);
  equal(await tab.selected(), ["/room"]);
  await tab.dragPixels(await tab.grip("x1"), await tab.at(26, 9));
  await tab.steps(1);
  placed(tab.json.room.size, [26, 18, 3.6]);
  await tab.click(1, 5);
  equal(await tab.selected(), ["/transceivers/grids/0"]);
  await tab.dragPixels(await tab.grip("x1 y1"), await tab.at(23, 16));
  await tab.steps(2);
  const [{ min, max }] = tab.json.transceivers.grids;
  placed([...min, ...max], [1, 1, 23, 16]);
  await tab.click(21.5, 13.6);
  equal(await tab.selected(), ["/transceivers/keep_out/0"]);
  await tab.dragPixels(await tab.grip("x0"), await tab.at(19, 13.7));
  await tab.steps(3);
  placed(tab.json.transceivers.keep_out[0].min, [19, 12.5]);
});

testPlanner("the whole drawing moves, with its room", { store: "market-hall" }, async (tab) => {
  const { outline } = tab.json.room;
  const index = tab.json.fixtures.findIndex(({ at }) => at);
  const [x, y] = tab.json.fixtures[index].at;
  await tab.press("Control+a", "Shift+ArrowRight");
  await tab.steps(1);
  check((await tab.selected()).includes("/room"), "the room is selected");
  outline.forEach(([u, v], k) => placed(tab.json.room.outline[k], [u + 0.1, v]));
  placed(tab.json.fixtures[index].at.slice(0, 2), [x + 0.1, y]);
});
