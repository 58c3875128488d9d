// Tests the tools that draw: corners by clicks, drags, typed values and keys, and what they add to the store.

import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { check, equal, near, says } from "../viewer/check.mjs";
import { parse } from "./jsonc.mjs";
import { placed, testPlanner } from "./opened.mjs";

const scope = (tab) => tab.page.evaluate(() => window.shelfbeamPlanner.page.gestures.scope);
const corners = async (tab) => (await scope(tab)).stroke.points.length;
const word = (tab) => tab.page.evaluate(() => document.querySelector(".overlay .word")?.textContent ?? "");
const last = (list) => list[list.length - 1];

/** Clicks on places that nothing attracts. */
async function freely(tab, ...places) {
  await tab.page.keyboard.down("Alt");
  for (const [x, y] of places) await tab.click(x, y);
  await tab.page.keyboard.up("Alt");
}

testPlanner("draw: a room by its corners, closed at the first one", { smoke: true }, async (tab) => {
  const { room } = tab.json;
  await tab.press("r");
  await freely(tab, [1, 1], [24, 1], [24, 12], [18, 16], [1, 16]);
  equal(await corners(tab), 5);
  await tab.point(1.1, 1.15);
  equal(await word(tab), "first corner");
  await tab.click(1.1, 1.15);
  await tab.steps(1);
  equal(await tab.labels(), ["Draw the room"]);
  placed(tab.json.room.outline, [
    [1, 1],
    [24, 1],
    [24, 12],
    [18, 16],
    [1, 16],
  ]); // prettier-ignore
  equal([tab.json.room.height, tab.json.room.floor], [room.size[2], room.floor]);
});

testPlanner("draw: Esc, Ctrl+Z and Backspace in the middle", {}, async (tab) => {
  await tab.press("z");
  await freely(tab, [2, 2], [4, 2], [4, 4]);
  await tab.press("Backspace");
  equal(await corners(tab), 2);
  await tab.press("Escape");
  equal(await corners(tab), 0);
  await freely(tab, [2, 2], [4, 2], [4, 4]);
  await tab.press("Control+z");
  equal(await corners(tab), 0);
  check(await tab.isUntouched(), "nothing was drawn");
  await tab.drag([2, 2], [5, 4], { during: () => tab.press("Escape") });
  check(await tab.isUntouched(), "a cancelled drag draws nothing");
  await tab.press("Escape");
  equal((await scope(tab)).kind, "idle");
});

testPlanner("draw: Esc and Ctrl+Z in the middle of every tool", {}, async (tab) => {
  for (const key of ["r", "w", "o", "g", "b", "z", "k", "a"]) {
    await tab.press(key);
    equal((await scope(tab)).kind, "drawing", key);
    if (key === "g") await tab.choose("tool/Preset", "row");
    for (const cancel of ["Escape", "Control+z"]) {
      await freely(tab, [2, 2]);
      await tab.point(4, 2.5);
      equal(await corners(tab), 1, `${key}: a corner`);
      await tab.press(cancel);
      equal(await corners(tab), 0, `${key}: none after ${cancel}`);
      equal((await scope(tab)).kind, "drawing", `${key}: the tool stays`);
    }
    await tab.drag([2, 2], [4, 3], { keys: ["Alt"], during: () => tab.press("Control+z") });
    await tab.press("Escape");
    equal((await scope(tab)).kind, "idle", key);
  }
  await tab.click(10, 9.85);
  await tab.press("n");
  await tab.point(10, 12);
  await tab.press("Escape");
  equal((await scope(tab)).kind, "idle");
  check(await tab.isUntouched(), "nothing was drawn");
});

testPlanner("draw: from 1 m to 500 m across", {}, async (tab) => {
  const across = async () => 660 / (await tab.view()).scale;
  const wheel = async (delta, isDone) => {
    for (let k = 0; k < 60 && !isDone(await across()); ++k) {
      await tab.page.mouse.move(...(await tab.at(21, 15.5)));
      await tab.page.mouse.wheel(0, delta);
      await tab.settle();
    }
    check(isDone(await across()), `${await across()} m across`);
  };
  await wheel(-200, (metres) => metres <= 1);
  await tab.press("b");
  await tab.page.keyboard.down("Alt");
  await tab.drag([21, 15.5], [20.8, 15.3]);
  await tab.page.keyboard.up("Alt");
  await tab.steps(1);
  placed(last(tab.json.fixtures).size.slice(0, 2), [0.2, 0.2]);
  await wheel(300, (metres) => metres >= 500);
  await tab.press("z");
  await tab.drag([100, 100], [130, 150], { keys: ["Alt"] });
  await tab.steps(2);
  equal(last(tab.json.room.zones).polygon.length, 4);
  await tab.press("Escape");
});

testPlanner("draw: edges must not cross", {}, async (tab) => {
  await tab.press("b");
  await freely(tab, [20, 1], [22, 1], [22, 3], [21, 0.5]);
  equal(await corners(tab), 3);
  equal((await scope(tab)).stroke.crossings.length, 2);
  check(await tab.page.evaluate(() => document.querySelectorAll(".crossing").length === 2), "both edges are shown");
  says(await tab.text(".notice"), "Edges would cross here.");
  await tab.press("Escape");
});

testPlanner("draw: walls by typed lengths and angles, ended by Enter", {}, async (tab) => {
  await tab.press("w");
  await freely(tab, [2, 1]);
  await tab.point(4, 1.5);
  await tab.page.keyboard.type("2*1.5");
  await tab.press("Tab");
  await tab.page.keyboard.type("90");
  await tab.press("Enter");
  equal(await corners(tab), 2);
  await tab.page.keyboard.type("180cm");
  await tab.press("Tab");
  await tab.page.keyboard.type("0");
  await tab.press("Enter", "Enter");
  await tab.steps(1);
  const walls = tab.json.room.inner_walls.slice(-2);
  const [x, y] = walls[0].from;
  placed([x, y], [2, 1]);
  near(walls[0].to[1] - y, 3, 1e-6, "the typed length");
  near(walls[1].to[0] - x, 1.8, 1e-6, "the second typed length");
  equal(walls[0].to, walls[1].from);
});

testPlanner("draw: a door in an outer wall, and in an inner one", {}, async (tab) => {
  await tab.press("o");
  await freely(tab, [3, 0.05], [4.2, 0.05]);
  await tab.steps(1);
  const door = last(tab.json.room.openings);
  placed([door.at, door.width], [3, 1.2]);
  equal([door.wall, door.top], [0, 2.1]);
  await tab.click(12, 12);
  await tab.click(13, 12);
  await tab.until(() => document.querySelector(".notice").textContent.includes("There is no wall here."));
  await tab.press("Escape");
});

testPlanner("draw: a row of whole modules, and shelving that clings to a wall", {}, async (tab) => {
  await tab.press("g");
  await tab.choose("tool/Preset", "end");
  await tab.page.evaluate(() => document.querySelector(".surface").focus());
  await freely(tab, [20, 14], [20, 17]);
  await tab.steps(1);
  const row = last(tab.json.fixtures);
  equal([row.preset, row.rotation_deg], ["end", 90]);
  near(row.length, 2.7, 1e-9, "three modules of 0.9 m");
  await tab.page.keyboard.press("Escape");
});

testPlanner("draw: like the last fixture, with the widths of the aisles", {}, async (tab) => {
  await tab.press("g");
  await tab.choose("tool/Preset", "row");
  await freely(tab, [3.5, 1]);
  await tab.page.keyboard.down("Alt");
  await tab.point(15.2, 1);
  const widths = await tab.page.evaluate(() =>
    [...document.querySelectorAll(".overlay .distance")].map((one) => Number.parseFloat(one.textContent)),
  );
  await tab.page.keyboard.up("Alt");
  await freely(tab, [15.2, 1]);
  await tab.steps(1);
  const { at, ...others } = last(tab.json.fixtures);
  equal([others.preset, others.length], ["row", undefined]);
  placed(at, [3.5, 0.55]);
  placed(widths.sort(), [2 - at[1] - 0.9, at[1]].sort(), "the aisles to the check-outs and the wall");
  await tab.fill("field/depth", "0.7");
  await tab.steps(2);
  placed(last(tab.json.fixtures).at, [3.5, 0.65], "the middle stays");
  await tab.click(20, 16.5);
  await tab.click(20, 4.6);
  await tab.steps(3);
  const { preset, depth, length, rotation_deg } = last(tab.json.fixtures);
  equal([preset, depth, length, rotation_deg], ["row", 0.7, undefined, 270]);
  await tab.press("Control+z");
  await tab.steps(2);
  equal(await tab.text('[data-key="tool/Preset"] option:checked'), "Like the last one", "undo keeps its corrections");
  await tab.click(20, 16.5);
  await tab.click(20, 4.6);
  await tab.steps(3);
  equal(last(tab.json.fixtures).depth, 0.7);
  await tab.press("Escape");
});

testPlanner("draw: rows of copies at a typed distance", {}, async (tab) => {
  await tab.click(22, 9);
  await tab.press("Escape");
  await tab.click(10, 9.85);
  await tab.fill("field/depth", "0.9");
  await tab.steps(1);
  await tab.page.evaluate(() => document.querySelector(".properties").scrollTo(0, 1e4));
  await tab.press("n");
  const isSeen = () => document.querySelector('[data-key="tool/count"]').getBoundingClientRect().top > 40;
  check(await tab.page.evaluate(isSeen), "the panel scrolls to the number");
  await tab.page.keyboard.type("3");
  await tab.press("Enter");
  await tab.point(10, 8.5);
  await tab.page.keyboard.type("0.5");
  await tab.press("Tab");
  await tab.page.keyboard.type("-90");
  await tab.press("Enter");
  await tab.steps(2);
  const { repeat } = tab.json.fixtures[2];
  equal([repeat.count, repeat.step], [3, [0, -0.5]]);
  equal((await tab.labels())[1], "Draw rows");
  await tab.press("n");
  const number = () => document.querySelector('[data-key="tool/count"]')?.value ?? null;
  equal(await tab.page.evaluate(number), "2", "not that of another row");
  await tab.press("Escape");
  equal(await tab.page.evaluate(number), null, "the tool is left");
});

testPlanner("draw: what is typed is exact, and what is no length is refused", {}, async (tab) => {
  await tab.press("w");
  await freely(tab, [20, 13]);
  await tab.point(22, 13.05);
  await tab.page.keyboard.type("1,33");
  await tab.press("Enter");
  await tab.page.keyboard.type("1abc");
  await tab.press("Enter");
  equal(await corners(tab), 2, "no corner");
  says(await tab.text(".notice"), "This is no length");
  await tab.press("Escape");
  equal((await scope(tab)).typed.length, "", "Esc takes the text back first");
  equal(await corners(tab), 2);
  await tab.page.evaluate(() => document.querySelector(".surface").focus());
  await tab.press("m"); // another tool keeps the walls so far
  await tab.steps(1);
  const { from, to } = last(tab.json.room.inner_walls);
  near(to[0] - from[0], 1.33, 1e-9, "the typed length");
  equal(to[1], from[1], "straight, because the pointer was almost there");
  await tab.press("Escape");
});

/** The grocery with another unit of length, and without what has places. */
const inUnit = (units, factor) => (folder) => {
  const file = join(folder, "store.json");
  const store = parse(readFileSync(file, "utf8"));
  const room = { ...store.room, size: store.room.size.map((value) => Math.round(value * factor)) };
  const label = { id: "L", position: [1, 1, 1].map((value) => value * factor), normal: [0, 0, 1], type: "standard" };
  const unit = { id: "T", position: [2, 2, 3].map((value) => value * factor), type: "ceiling" };
  const { presets: _, ...others } = store;
  writeFileSync(
    file,
    JSON.stringify({ ...others, units, room, fixtures: [], labels: [label], transceivers: { list: [unit] } }),
  );
};

for (const [unit, factor, typed, expected] of [
  ["mm", 1000, "1800", 1800],
  ["ft", 1 / 0.3048, "5'6\"", 5.5],
])
  testPlanner(`draw: in ${unit}`, { prepare: inUnit(unit, factor) }, async (tab) => {
    await tab.press("w");
    await freely(tab, [4, 4]);
    await tab.point(8, 4.02);
    await tab.page.keyboard.type(typed);
    await tab.press("Enter", "Enter");
    await tab.steps(1);
    const [{ from, to }] = tab.json.room.inner_walls;
    near(to[0] - from[0], expected, 1e-9, "the typed length");
    await tab.press("Escape");
  });

testPlanner("draw: doors beside the end of a wall, and rows beside fixtures", {}, async (tab) => {
  await tab.press("w");
  await freely(tab, [20, 13], [20, 17.98]);
  await tab.press("Enter");
  await tab.steps(1);
  await tab.press("o");
  await tab.click(20.05, 17.95);
  await tab.click(21.2, 17.95);
  await tab.steps(2);
  equal(last(tab.json.room.openings).wall, 2, "the wall along which the door runs");
  await tab.click(10, 17.99);
  await tab.click(10.01, 17.5);
  await tab.until(() => document.querySelector(".notice").textContent.includes("Draw the opening along its wall"));
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
  const box = last(tab.json.fixtures);
  placed([box.at[0], box.at[1], box.size[0], box.size[1]], [20, 0.6, 2, 1.2]);
  await tab.press("Escape");
  await tab.press("k", "ArrowLeft", "Enter");
  equal(await corners(tab), 1);
  for (const [key, times] of [
    ["ArrowRight", 4],
    ["ArrowUp", 4],
    ["ArrowLeft", 4],
  ]) {
    // prettier-ignore
    for (let k = 0; k < times; ++k) await tab.press(`Shift+${key}`);
    await tab.press("Enter");
  }
  equal(await corners(tab), 4);
  await tab.press("Enter");
  await tab.steps(2);
  equal((await tab.labels())[1], "Draw a keep-out area");
  equal(last(tab.json.transceivers.keep_out).polygon.length, 4);
  await tab.press("Escape");
});

testPlanner("draw: Shift keeps to steps of 15 degrees, and corners attract", {}, async (tab) => {
  await tab.press("w");
  await freely(tab, [3, 1]);
  await tab.page.keyboard.down("Shift");
  await tab.point(6, 1.2);
  const { end } = await scope(tab);
  near(end.at[1], (await scope(tab)).stroke.points[0][1], 1e-9, "along the frame");
  await tab.page.keyboard.up("Shift");
  const [x, y] = tab.json.fixtures[2].at;
  await tab.point(x + 0.03, y - 0.03);
  equal(await word(tab), "corner");
  await tab.press("Escape", "Escape");
});
