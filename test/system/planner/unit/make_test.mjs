import assert from "node:assert/strict";
import { test } from "node:test";

import fc from "fast-check";

import { EditBuilder } from "../../../../src/page/planner/document/edit";
import { outlineOf } from "../../../../src/page/planner/geometry/rigid";
import { addBlock } from "../../../../src/page/planner/make/block";
import { addHole, addZone, isBare, losesWalls, setRoom } from "../../../../src/page/planner/make/room";
import { addRun, runAlong, setRows } from "../../../../src/page/planner/make/run";
import { addOpening, addWalls, along, wallLines, wallNear } from "../../../../src/page/planner/make/walls";
import { double, isNear, near, points, rectangle, site } from "./support.mjs";

const room = { size: [20, 15, 3.5], floor: "floor", ceiling: "white", walls: { x0: "plaster", x1: "glass" } };
const bare = { room, fixtures: [], transceivers: { areas: [{ type: "t", area: "room", spacing: 1 }] } };

test("the first rectangle is a box at the origin", () => {
  const builder = new EditBuilder(bare);
  assert.ok(isBare(bare));
  assert.deepEqual(setRoom(builder, site(bare), rectangle(2, 3, 14, 11)), [2, 3]);
  assert.deepEqual(builder.json.room, { size: [12, 8, 3.5], floor: "floor", ceiling: "white", walls: "plaster" });
});

test("another outline keeps materials, zones and inner walls, and begins at 0 only in a bare shop", () => {
  const outline = points("1,1 9,1 9,5 4,7 1,7");
  const first = new EditBuilder(bare);
  assert.deepEqual(setRoom(first, site(bare), outline), [1, 1]);
  assert.deepEqual(first.json.room.outline[3], [3, 6]);
  assert.equal(first.json.room.height, 3.5);
  const walls = [{ id: "W1", from: [1, 1], to: [2, 2] }];
  const drawn = { ...bare, room: { ...room, inner_walls: walls, openings: [{ wall: "y0", at: 1, width: 1, top: 2 }] } };
  const second = new EditBuilder(drawn);
  assert.deepEqual(setRoom(second, site(drawn), outline), [0, 0]);
  assert.deepEqual(second.json.room.outline, outline);
  assert.deepEqual(second.json.room.inner_walls, walls);
  assert.ok(losesWalls(drawn) && !losesWalls(bare));
  const holed = { ...drawn, room: { outline, height: 3, holes: [rectangle(5, 2, 6, 3)] } };
  const third = new EditBuilder(holed);
  setRoom(third, site(holed), rectangle(0, 0, 9, 8));
  assert.deepEqual(third.json.room.holes, holed.room.holes, "a rectangle with a shaft stays an outline");
  assert.equal(second.json.room.openings, undefined);
});

test("a hole makes an outline of a box", () => {
  const builder = new EditBuilder(bare);
  addHole(builder, site(bare), rectangle(2, 2, 4, 4));
  const { outline, height, walls, holes } = builder.json.room;
  assert.deepEqual(outline, rectangle(0, 0, 20, 15));
  assert.deepEqual([height, walls], [3.5, "plaster"]);
  assert.deepEqual(holes, [rectangle(2, 2, 4, 4)]);
});

test("lengths are those of the file", () => {
  const feet = { ...bare, units: "ft", room: { ...room, size: [60, 40, 12] } };
  const builder = new EditBuilder(feet);
  addZone(builder, site(feet, "ft"), rectangle(0, 0, 3.048, 6.096), 2.4384);
  addWalls(builder, site(feet, "ft"), points("0,0 3.048,0 3.048,3.048"), 0.1524);
  assert.deepEqual(builder.json.room.zones[0].polygon, rectangle(0, 0, 10, 20));
  assert.equal(builder.json.room.zones[0].height, 8);
  const walls = builder.json.room.inner_walls;
  assert.deepEqual([walls[0].id, walls[1].id, walls[1].from, walls[1].to], ["W1", "W2", [10, 0], [10, 10]]);
  assert.equal(walls[0].thickness, 0.5);
});

test("doors and windows are on the nearest wall, in either direction", () => {
  const json = { ...bare, room: { ...room, inner_walls: [{ id: "W1", from: [5, 2], to: [5, 8] }] } };
  const walls = wallLines(site(json));
  assert.equal(walls.length, 5);
  const top = wallNear(walls, points("8,14.8 9,14.9"), 0.5);
  assert.equal(top.number, 2);
  assert.equal(wallNear(walls, points("8,7 9,7"), 0.5), null);
  const builder = new EditBuilder(json);
  const window = { bottom: 0.9, top: 2.1, material: "glass" };
  addOpening(builder, site(json), top, points("8,14.9 6.5,15"), window);
  assert.deepEqual(builder.json.room.openings, [{ wall: 2, at: 12, width: 1.5, ...window }]);
  const inner = wallNear(walls, points("5.1,3 5,4"), 0.5);
  addOpening(builder, site(json), inner, points("5,3 5,4"), { bottom: 0, top: 2.1 });
  assert.deepEqual(builder.json.room.inner_walls[0].openings, [{ at: 1, width: 1, top: 2.1 }]);
  assert.equal(along(inner, [5, 20]), 6);
});

const twoSided = {
  preset: "row",
  own: {},
  effective: { type: "gondola", length: 1.25, depth: 0.9, height: 1.6, faces: ["front", "back"] },
  prefix: null,
  module: 1.25,
  base: { length: 1.25, depth: 0.9, height: 1.6 },
};
const single = { ...twoSided, preset: "wall", effective: { ...twoSided.effective, depth: 0.5, faces: ["front"] } };

test("a run has whole modules, and its middle line or its back is where it was drawn", () => {
  fc.assert(
    fc.property(fc.tuple(double(6, 14), double(5, 10)), double(0.2, 8), double(0, 360), ([x, y], length, degrees) => {
      const way = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
      const after = (distance) => [x + distance * way[0], y + distance * way[1]];
      const drawn = [[x, y], after(length)];
      const builder = new EditBuilder(bare);
      for (const preset of [twoSided, single]) {
        const run = runAlong(site(bare), preset, [], drawn);
        assert.equal(run.length, Math.max(1, Math.round(length / 1.25)) * 1.25);
        const exact = runAlong(site(bare), preset, [], drawn, { isExact: true });
        near([exact.length], [length], 1e-9);
        const corners = outlineOf({ ...run, rotation: run.rotation });
        const middle = (a, b) => a.map((value, k) => 0.5 * (value + b[k]));
        const isMiddle = preset === twoSided;
        near(isMiddle ? middle(corners[0], corners[3]) : corners[3], [x, y], 1e-9);
        near(isMiddle ? middle(corners[1], corners[2]) : corners[2], after(run.length), 1e-9);
        const path = addRun(builder, site(bare), preset, run);
        near(builder.get(path).at, run.at, 1e-4);
      }
    }),
  );
});

test("shelving with a front alone clings to a wall near its line", () => {
  const walls = wallLines(site(bare));
  const against = (text, preset = single, more = {}) => runAlong(site(bare), preset, walls, points(text), more).against;
  const run = runAlong(site(bare), single, walls, points("18,14.4 8,14.5"));
  assert.deepEqual(run.against, { wall: 2, from: 2 });
  assert.equal(run.length, 10);
  assert.deepEqual(against("8,14.4 18,14.4"), { wall: 2, from: 2 }, "the beginning of the line stays");
  for (const far of ["8,12 16,12", "8,14.5 14,10"]) assert.equal(against(far), null);
  assert.equal(against("8,14.5 18,14.5", twoSided), null);
  assert.equal(against("8,14.5 18,14.5", single, { isFree: true }), null);
  const builder = new EditBuilder(bare);
  addRun(builder, site(bare), single, run);
  assert.deepEqual(builder.json.fixtures, [{ preset: "wall", id: "G1", against: { wall: 2, from: 2 }, length: 10 }]);
});

test("a run like another fixture has its keys and the letter of its id", () => {
  const builder = new EditBuilder({ ...bare, fixtures: [{ id: "A1" }] });
  const around = { ...site(bare), taken: new Set(["A1"]) };
  const add = (preset, text) => addRun(builder, around, preset, runAlong(around, preset, [], points(text)));
  add({ ...twoSided, own: { height: 2, labels: { spacing: 0.8 } }, prefix: "A" }, "1,1 4,1");
  const { at, ...others } = builder.json.fixtures[1];
  assert.deepEqual(others, { preset: "row", height: 2, labels: { spacing: 0.8 }, id: "A2", length: 2.5 });
  const box = { preset: null, own: { type: "box" }, prefix: null, module: null, base: null };
  add({ ...box, effective: { type: "box", size: [1, 0.8, 0.9] } }, "1,1 4,1");
  assert.deepEqual(builder.json.fixtures[2].size, [3, 0.8, 0.9]);
  assert.equal(runAlong(around, { ...box, effective: { type: "prism" } }, [], points("1,1 4,1")), null);
  // One module that is as long as its model, but not as its preset.
  add({ ...twoSided, module: 0.9, prefix: "E" }, "1,2 1.9,2");
  assert.equal(builder.json.fixtures[3].length, 0.9);
});

test("tables with labels at fixed places are a row", () => {
  const builder = new EditBuilder(bare);
  const effective = { type: "box", size: [1.2, 0.8, 1.2], labels: [{ position: [0.6, 0, 1], normal: [0, -1, 0] }] };
  const base = { length: 1.2, depth: 0.8, height: 1.2 };
  const pallet = { preset: "pallet", own: {}, prefix: null, module: 1.2, effective, base };
  const run = runAlong(site(bare), pallet, [], points("1,1 4.5,1"), { isExact: true });
  addRun(builder, site(bare), pallet, run);
  const { at, ...others } = builder.json.fixtures[0];
  assert.deepEqual(others, { preset: "pallet", id: "B{n}", repeat: { count: 3, step: 1.2 } });
});

test("shelving at an inner wall does not cling to the outer wall behind it", () => {
  const walled = { ...bare, room: { ...room, inner_walls: [{ from: [2, 14.2], to: [12, 14.2], thickness: 0.12 }] } };
  const run = runAlong(site(walled), single, wallLines(site(walled)), points("10,14.14 4,14.14"));
  assert.equal(run.against, null);
});

test("what names a fixture names the first of its rows", () => {
  const fixtures = [{ id: "Promo" }, { id: "E", against: { fixture: "Promo", side: "left" } }, { id: "Promo1" }];
  const builder = new EditBuilder({ ...bare, fixtures });
  setRows(builder, { ...site(bare), taken: new Set(["Promo", "E", "Promo1"]) }, "/fixtures/0", 2, [0, 2]);
  assert.deepEqual(builder.json.fixtures[0], { id: "Promo{n}", repeat: { first: 2, count: 2, step: [0, 2] } });
  assert.equal(builder.json.fixtures[1].against.fixture, "Promo2");
});

test("rows of a run are one element", () => {
  const builder = new EditBuilder({ ...bare, fixtures: [{ preset: "row", id: "G7", at: [1, 1] }] });
  setRows(builder, site(bare), "/fixtures/0", 6, [0, 2.4]);
  assert.deepEqual(builder.json.fixtures[0], {
    preset: "row",
    id: "G{n}",
    at: [1, 1],
    repeat: { first: 7, count: 6, step: [0, 2.4] },
  });
});

test("a block of four right angles is a box, another one a prism", () => {
  const blockOf = (corners, top) => {
    const builder = new EditBuilder(bare);
    return builder.get(addBlock(builder, site(bare), corners, top, "steel"));
  };
  const turned = (degrees, [x, y]) => {
    const [c, s] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
    return [5 + c * x - s * y, 5 + s * x + c * y];
  };
  fc.assert(
    fc.property(double(-180, 180), fc.integer({ min: 0, max: 3 }), fc.boolean(), (degrees, first, isReversed) => {
      const corners = rectangle(0, 0, 2, 1).map((corner) => turned(degrees, corner));
      const box = blockOf(
        [0, 1, 2, 3].map((k) => corners[(first + (isReversed ? 4 - k : k)) % 4]),
        0.9,
      );
      assert.equal(box.type, "box");
      const rotation = box.rotation_deg ?? 0;
      const outline = outlineOf({ at: box.at.slice(0, 2), rotation, length: box.size[0], depth: box.size[1] });
      for (const corner of corners) assert.ok(outline.some((other) => isNear(corner, other, 1e-3)));
      assert.ok(rotation <= 45.001 || rotation >= 314.999);
    }),
  );
  assert.equal(blockOf(points("1,1 2,1 1,2"), 1).type, "prism");
  const column = blockOf(rectangle(1, 1, 1.5, 1.5), "ceiling");
  assert.deepEqual([column.type, column.top], ["prism", "ceiling"]);
});
