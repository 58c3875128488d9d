// Tests the tools that draw: corners by clicks, drags, typed values and keys, and what they add to the store.

import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { check, equal, near, says } from "../viewer/check.mjs";
import { parse } from "./jsonc.mjs";
import { placed, testPlanner } from "./opened.mjs";

const corners = async (tab) => (await tab.scope()).stroke.points.length;
const word = async (tab) => (await tab.text(".overlay .word")) ?? "";

/** Types a length, and an angle beside it. */
async function typeEdge(tab, length, angle) {
  await tab.page.keyboard.type(length);
  await tab.press("Tab");
  await tab.page.keyboard.type(angle);
  await tab.press("Enter");
}

testPlanner("draw: a room by its corners, closed at the first one", { smoke: true }, async (tab) => {
  const { room } = tab.json;
  await tab.press("r");
  await tab.freely([1, 1], [24, 1], [24, 12], [18, 16], [1, 16]);
  equal(await corners(tab), 5);
  await tab.point(1.1, 1.15);
  equal(await word(tab), "first corner");
  await tab.click(1.1, 1.15);
  await tab.steps(1);
  equal(await tab.labels(), ["Draw the room"]);
  const { outline, height, floor } = tab.json.room;
  placed(outline.flat(), [1, 1, 24, 1, 24, 12, 18, 16, 1, 16]);
  equal([height, floor], [room.size[2], room.floor]);
});

testPlanner("draw: Esc, Ctrl+Z and Backspace in the middle of every tool", {}, async (tab) => {
  await tab.press("z");
  await tab.freely([2, 2], [4, 2], [4, 4]);
  await tab.press("Backspace");
  equal(await corners(tab), 2);
  await tab.press("Escape", "Escape");
  for (const key of ["r", "w", "o", "g", "b", "z", "k", "a", "t"]) {
    await tab.press(key);
    equal((await tab.scope()).kind, "drawing", key);
    if (key === "g") await tab.choose("tool/Preset", "row");
    for (const cancel of ["Escape", "Control+z"]) {
      await tab.freely([2, 2]);
      await tab.point(4, 2.5);
      equal(await corners(tab), 1, `${key}: a corner`);
      await tab.press(cancel);
      equal(await corners(tab), 0, `${key}: none after ${cancel}`);
      equal((await tab.scope()).kind, "drawing", `${key}: the tool stays`);
      await tab.drag([2, 2], [4, 3], { keys: ["Alt"], during: () => tab.press(cancel) });
    }
    await tab.press("Escape");
    equal((await tab.scope()).kind, "idle", key);
  }
  await tab.click(10, 9.85);
  await tab.press("n");
  await tab.point(10, 12);
  await tab.press("Escape");
  equal((await tab.scope()).kind, "idle");
  check(await tab.isUntouched(), "nothing was drawn");
});

testPlanner("draw: from 1 m to 500 m across", {}, async (tab) => {
  const zoom = async (delta, isDone) => {
    const across = async () => 660 / (await tab.view()).scale;
    for (let k = 0; k < 60 && !isDone(await across()); ++k) await tab.wheel(21, 15.5, delta);
    check(isDone(await across()), `${await across()} m across`);
  };
  await zoom(-200, (metres) => metres <= 1);
  await tab.press("b");
  await tab.drag([21, 15.5], [20.8, 15.3], { keys: ["Alt"] });
  await tab.steps(1);
  placed(tab.json.fixtures.at(-1).size.slice(0, 2), [0.2, 0.2]);
  await zoom(300, (metres) => metres >= 500);
  await tab.press("z");
  await tab.drag([100, 100], [130, 150], { keys: ["Alt"] });
  await tab.steps(2);
  equal(tab.json.room.zones.at(-1).polygon.length, 4);
  await tab.press("Escape");
});

testPlanner("draw: walls by typed lengths and angles, whose edges must not cross", {}, async (tab) => {
  await tab.press("w");
  await tab.freely([2, 1]);
  await tab.point(4, 1.5);
  await typeEdge(tab, "2*1.5", "90");
  equal(await corners(tab), 2);
  await typeEdge(tab, "180cm", "0");
  await tab.press("Enter");
  await tab.steps(1);
  const walls = tab.json.room.inner_walls.slice(-2);
  const [x, y] = walls[0].from;
  placed([x, y], [2, 1]);
  near(walls[0].to[1] - y, 3, 1e-6, "the typed length");
  near(walls[1].to[0] - x, 1.8, 1e-6, "the second typed length");
  equal(walls[0].to, walls[1].from);
  await tab.press("b");
  await tab.freely([20, 1], [22, 1], [22, 3], [21, 0.5]);
  equal(await corners(tab), 3);
  equal(await tab.count(".crossing"), 2, "both edges are shown");
  await tab.notice("Edges would cross here.");
  await tab.press("Escape");
});

testPlanner("draw: a row of whole modules, and doors in walls", {}, async (tab) => {
  await tab.press("o");
  await tab.freely([3, 0.05], [4.2, 0.05]);
  await tab.steps(1);
  const door = tab.json.room.openings.at(-1);
  placed([door.at, door.width], [3, 1.2]);
  equal([door.wall, door.top], [0, 2.1]);
  await tab.click(12, 12);
  await tab.click(13, 12);
  await tab.notice("There is no wall here.");
  await tab.press("Escape", "g");
  await tab.choose("tool/Preset", "end");
  await tab.page.focus(".surface");
  await tab.freely([20, 14], [20, 17]);
  await tab.steps(2);
  const row = tab.json.fixtures.at(-1);
  equal([row.preset, row.rotation_deg], ["end", 90]);
  near(row.length, 2.7, 1e-9, "three modules of 0.9 m");
  await tab.press("Escape");
});

testPlanner("draw: like the last fixture, with the widths of the aisles", {}, async (tab) => {
  await tab.press("g");
  await tab.choose("tool/Preset", "row");
  await tab.freely([3.5, 1]);
  let widths;
  await tab.holding(["Alt"], async () => {
    await tab.point(15.2, 1);
    widths = (await tab.texts(".overlay .distance")).map(Number.parseFloat);
  });
  await tab.freely([15.2, 1]);
  await tab.steps(1);
  const { at, ...others } = tab.json.fixtures.at(-1);
  equal([others.preset, others.length], ["row", undefined]);
  placed(at, [3.5, 0.55]);
  placed(widths.sort(), [2 - at[1] - 0.9, at[1]].sort(), "the aisles to the check-outs and the wall");
  await tab.fill("field/depth", "0.7");
  await tab.steps(2);
  placed(tab.json.fixtures.at(-1).at, [3.5, 0.65], "the middle stays");
  for (const isAgain of [false, true]) {
    if (isAgain) {
      await tab.press("Control+z");
      await tab.steps(2);
      const preset = await tab.text('[data-key="tool/Preset"] option:checked');
      equal(preset, "Like the last one", "undo keeps its corrections");
    }
    await tab.click(20, 16.5);
    await tab.click(20, 4.6);
    await tab.steps(3);
    const { preset, depth, length, rotation_deg } = tab.json.fixtures.at(-1);
    equal([preset, depth, length, rotation_deg], ["row", 0.7, undefined, 270]);
  }
  await tab.press("Escape");
});

testPlanner("draw: rows of copies at a typed distance", {}, async (tab) => {
  await tab.click(10, 9.85);
  await tab.fill("field/depth", "0.9");
  await tab.steps(1);
  await tab.evaluate(() => document.querySelector(".properties").scrollTo(0, 1e4));
  await tab.press("n");
  const isSeen = () => document.querySelector('[data-key="tool/count"]').getBoundingClientRect().top > 40;
  check(await tab.evaluate(isSeen), "the panel scrolls to the number");
  await tab.page.keyboard.type("3");
  await tab.press("Enter");
  await tab.point(10, 8.5);
  await typeEdge(tab, "0.5", "-90");
  await tab.steps(2);
  const { repeat } = tab.json.fixtures[2];
  equal([repeat.count, repeat.step], [3, [0, -0.5]]);
  equal((await tab.labels())[1], "Draw rows");
  await tab.press("n");
  const number = () => tab.evaluate(() => document.querySelector('[data-key="tool/count"]')?.value ?? null);
  equal(await number(), "2", "not that of another row");
  await tab.press("Escape");
  equal(await number(), null, "the tool is left");
});

testPlanner("draw: what is typed is exact, and what is no length is refused", {}, async (tab) => {
  await tab.press("w");
  await tab.freely([20, 13]);
  await tab.point(22, 13.05);
  await tab.page.keyboard.type("1,33");
  await tab.press("Enter");
  await tab.page.keyboard.type("1abc");
  await tab.press("Enter");
  equal(await corners(tab), 2, "no corner");
  await tab.notice("This is no length");
  await tab.press("Escape");
  equal((await tab.scope()).typed.length, "", "Esc takes the text back first");
  equal(await corners(tab), 2);
  await tab.page.focus(".surface");
  await tab.press("m"); // another tool keeps the walls so far
  await tab.steps(1);
  const { from, to } = tab.json.room.inner_walls.at(-1);
  near(to[0] - from[0], 1.33, 1e-9, "the typed length");
  equal(to[1], from[1], "straight, because the pointer was almost there");
  await tab.press("Escape");
});

/** The grocery in feet, without elements that have places. */
function inFeet(folder) {
  const file = join(folder, "store.json");
  const { presets: _, ...store } = parse(readFileSync(file, "utf8"));
  const labels = [{ id: "L", position: [3, 3, 3], normal: [0, 0, 1], type: "standard" }];
  const transceivers = { list: [{ id: "T", position: [6, 6, 9], type: "ceiling" }] };
  const room = { ...store.room, size: [82, 59, 12] };
  writeFileSync(file, JSON.stringify({ ...store, units: "ft", room, fixtures: [], labels, transceivers }));
}

testPlanner("draw: in feet", { prepare: inFeet }, async (tab) => {
  await tab.press("w");
  await tab.freely([4, 4]);
  await tab.point(8, 4.02);
  await tab.page.keyboard.type("5'6\"");
  await tab.press("Enter", "Enter");
  await tab.steps(1);
  const [{ from, to }] = tab.json.room.inner_walls;
  near(to[0] - from[0], 5.5, 1e-9, "the typed length");
  await tab.press("Escape");
});

testPlanner("draw: doors beside the end of a wall, and rows beside fixtures", {}, async (tab) => {
  await tab.press("w");
  await tab.freely([20, 13], [20, 17.98]);
  await tab.press("Enter");
  await tab.steps(1);
  await tab.press("o");
  await tab.click(20.05, 17.95);
  await tab.click(21.2, 17.95);
  await tab.steps(2);
  equal(tab.json.room.openings.at(-1).wall, 2, "the wall along which the door runs");
  await tab.click(10, 17.99);
  await tab.click(10.01, 17.5);
  await tab.notice("Draw the opening along its wall");
  await tab.press("Escape");
  await tab.click(10, 5.05);
  await tab.press("n");
  await tab.fill("tool/count", "2");
  await tab.click(10, 3.5);
  await tab.steps(3);
  const [row] = tab.json.fixtures;
  equal([row.id, row.repeat.first], ["A{n}", 5], "A2 to A4 are others");
});

testPlanner("draw: a block by a drag, and by keys alone", {}, async (tab) => {
  await tab.press("b");
  await tab.drag([20, 0.6], [22, 1.8], { keys: ["Alt"] });
  await tab.steps(1);
  const { at, size } = tab.json.fixtures.at(-1);
  placed([at[0], at[1], size[0], size[1]], [20, 0.6, 2, 1.2]);
  await tab.press("Escape");
  await tab.press("k", "ArrowLeft", "Enter");
  equal(await corners(tab), 1);
  for (const key of ["ArrowRight", "ArrowUp", "ArrowLeft"]) await tab.press(...Array(4).fill(`Shift+${key}`), "Enter");
  equal(await corners(tab), 4);
  await tab.press("Enter");
  await tab.steps(2);
  equal((await tab.labels())[1], "Draw a keep-out area");
  equal(tab.json.transceivers.keep_out.at(-1).polygon.length, 4);
  await tab.press("Escape", "t", "Enter", ...Array(3).fill("Shift+ArrowRight"), "Enter", "Enter");
  await tab.steps(3);
  const [rail] = tab.json.transceivers.rails;
  equal([(await tab.labels())[2], rail.points.length], ["Draw a rail", 2]);
  await tab.press("Escape");
});

testPlanner("draw: Shift keeps to steps of 15 degrees, and corners attract", {}, async (tab) => {
  await tab.press("w");
  await tab.freely([3, 1]);
  await tab.holding(["Shift"], async () => {
    await tab.point(6, 1.2);
    const { end, stroke } = await tab.scope();
    near(end.at[1], stroke.points[0][1], 1e-9, "along the frame");
  });
  const [x, y] = tab.json.fixtures[2].at;
  await tab.point(x + 0.03, y - 0.03);
  equal(await word(tab), "corner");
  await tab.press("Escape", "Escape");
});

testPlanner("draw: a rail with a corner, below the ceiling", { smoke: true }, async (tab) => {
  const count = () => tab.state(({ planner }) => planner.document.units.count);
  const before = await count();
  await tab.press("t");
  await tab.fill("tool/below", "20cm");
  await tab.fill("tool/railId", "track");
  await tab.page.focus(".surface");
  await tab.freely([5, 8.6], [9, 8.6]);
  await tab.press("Enter");
  await tab.steps(1);
  equal(await tab.labels(), ["Draw a rail"]);
  const [rail] = tab.json.transceivers.rails;
  equal([rail.id, rail.type, rail.spacing], ["track", "ceiling", 0.5]);
  placed(rail.points.flat(), [5, 8.6, 3.4, 9, 8.6, 3.4]);
  check((await count()) > before, "it has candidates");
  await tab.freely([5, 6.2]);
  await typeEdge(tab, "4", "0");
  await tab.press("Enter");
  await tab.steps(2);
  equal(tab.json.transceivers.rails.at(-1).id, "R1");
  await tab.press("Escape");
});

testPlanner("draw: candidates around a column, on one face, and along a wall", { smoke: true }, async (tab) => {
  const last = () => tab.json.transceivers.on.at(-1);
  await tab.press("c");
  await tab.point(2.7, 3.7);
  equal(await tab.count(".overlay .trace.face"), 4);
  await tab.click(2.7, 3.7);
  await tab.steps(1);
  equal(await tab.labels(), ["Draw candidates on faces"]);
  equal(last(), { type: "ceiling", fixture: "C1", z: 2.4, spacing: 1, tilt_deg: 30 });
  await tab.choose("tool/Faces", "the face at the pointer");
  await tab.fill("tool/faceHeight", "2");
  await tab.page.focus(".surface");
  await tab.click(10, 7.05);
  await tab.steps(2);
  equal(last(), { type: "ceiling", fixture: "A2", face: "south", z: 1.9, spacing: 1, tilt_deg: 30 });
  await tab.click(24.95, 9);
  await tab.steps(3);
  equal([last().wall, last().face], [1, undefined]);
  await tab.click(12, 8.65);
  await tab.notice("There is no fixture or wall with a name here");
  equal(await tab.problems(), []);
  says(await tab.text(".properties"), "Spacing");
  await tab.picture("mounts");
  await tab.press("Escape");
});
