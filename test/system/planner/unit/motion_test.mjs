import assert from "node:assert/strict";
import { test } from "node:test";

import fc from "fast-check";

import { EditBuilder } from "../../../../src/page/planner/document/edit";
import { aligned, distributed } from "../../../../src/page/planner/elements/arrange";
import { movedAxis, movedRoll } from "../../../../src/page/planner/elements/axis";
import { nextId } from "../../../../src/page/planner/elements/copies";
import { elementAt } from "../../../../src/page/planner/elements/kinds";
import { moveElement } from "../../../../src/page/planner/elements/motion";
import { resizedFrame } from "../../../../src/page/planner/elements/resize";
import {
  mirrorAt,
  moved,
  movedFooting,
  outlineOf,
  shiftBy,
  turnAbout,
} from "../../../../src/page/planner/geometry/rigid";
import { unitNamed } from "../../../../src/page/planner/geometry/units";
import { double, near, points } from "./support.mjs";

const metre = unitNamed("m");

const store = {
  units: "m",
  room: {
    outline: points("0,0 10,0 10,8 0,8"),
    height: points("0,0,3 10,0,3 0,8,4"),
    zones: [{ id: "zone", polygon: points("1,1 2,1 2,2"), height: 2.5 }],
    inner_walls: [{ id: "wall", from: [4, 0], to: [4, 3] }],
    openings: [{ wall: 0, at: 1, width: 1, top: 2 }],
  },
  fixtures: [
    { type: "gondola", id: "A{n}", at: [2, 2], length: 4, depth: 1, height: 2, repeat: { count: 3, step: [0, 2] } },
    { type: "box", id: "box", min: [5, 5, 0], max: [6, 7, 1] },
    { type: "box", id: "table", at: [5, 1, 0.2], size: [2, 1, 1], rotation_deg: 30 },
    { type: "prism", id: "prism", polygon: points("7,1 8,1 8,2"), top: 1 },
    { type: "cylinder", id: "column", at: [3, 7], radius: 0.3, top: 2 },
    { type: "panel", id: "panel", corners: points("1,5,2 2,5,2 2,5,3") },
    { type: "gondola", id: "row", at: [1, 1], length: 1, depth: 0.5, height: 2, repeat: { count: 3, step: 1 } },
  ],
  labels: [{ id: "label", position: [1, 2, 1], normal: [0, 1, 0.3] }],
  measuring_planes: [{ id: "plane", origin: [1, 2, 1], axes: points("1,0,0 0,0,1"), size: [3, 2] }],
  transceivers: {
    grids: [{ min: [1, 1], max: [5, 3], spacing: 1, z: 3 }],
    areas: [{ area: points("1,1 2,1 2,2"), axes: points("0,0,-1 1,0,-1") }, { area: "room" }],
    rails: [{ id: "rail", points: points("1,1,3 4,1,3") }],
    on: [{ fixture: "box" }],
    list: [{ id: "unit", position: [4, 4, 3], axis: [1, 0, -1] }],
    keep_out: [{ min: [1, 1], max: [2, 3] }, { polygon: points("3,3 4,3 4,4") }],
  },
};

function partOf({ value }) {
  if (value.type !== "gondola" && value.type !== "box") return [];
  if (!value.at) return [];
  const [length, depth] = value.size ?? [value.length, value.depth];
  const footing = { at: value.at.slice(0, 2), rotation: value.rotation_deg ?? 0, length, depth };
  return [{ key: "x", path: "", kind: "fixture", id: "", type: value.type, outline: outlineOf(footing), footing }];
}

function after(path, ...motions) {
  let json = store;
  for (const motion of motions) {
    const element = elementAt(json, path);
    const builder = new EditBuilder(json);
    const why = moveElement(
      builder,
      { ...element, effective: element.value, parts: partOf(element), unit: metre },
      motion,
    );
    if (why) return why;
    json = builder.json;
  }
  return elementAt(json, path).value;
}

const all = [
  ...["/room", "/room/zones/0", "/room/inner_walls/0", "/labels/0", "/measuring_planes/0"],
  ...["grids/0", "areas/0", "rails/0", "list/0", "keep_out/0", "keep_out/1"].map((path) => `/transceivers/${path}`),
  ...store.fixtures.map((_, k) => `/fixtures/${k}`),
];

test("every kind of element moves, and back", () => {
  for (const path of all) {
    const there = after(path, shiftBy([0.5, -0.25]));
    assert.notDeepEqual(there, elementAt(store, path).value, path);
    assert.deepEqual(after(path, shiftBy([0.5, -0.25]), shiftBy([-0.5, 0.25])), elementAt(store, path).value, path);
  }
  assert.deepEqual(after("/room", shiftBy([1, 2])).height, points("1,2,3 11,2,3 1,10,4"));
  assert.deepEqual(after("/labels/0", shiftBy([1, 2])), { id: "label", position: [2, 4, 1], normal: [0, 1, 0.3] });
});

test("four quarter turns change nothing but angles", () => {
  const quarter = turnAbout(90, [3, 2]);
  for (const path of all) {
    const { rotation_deg, roll_deg, ...value } = after(path, quarter, quarter, quarter, quarter);
    const { rotation_deg: before, ...own } = elementAt(store, path).value;
    assert.ok((rotation_deg ?? 0) === (before ?? 0), path);
    assert.ok((roll_deg ?? 0) % 360 === 0, path);
    assert.deepEqual(own, Object.fromEntries(Object.keys(own).map((key) => [key, value[key]])), path);
  }
});

test("the mirror image of a measuring plane faces where the mirror shows it", () => {
  const plane = after("/measuring_planes/0", mirrorAt(0, [3, 0]));
  // The plane faces -y, along the mirror.
  assert.deepEqual([plane.origin, plane.axes[0], plane.normal], points("5,2,1 -1,0,0 0,-1,0"));
  // Negative control: the mirrored axes alone face +y.
  assert.equal(plane.axes[0][2] * plane.axes[1][0] - plane.axes[0][0] * plane.axes[1][2], 1);
});

test("a row turns with its steps", () => {
  const turned = after("/fixtures/0", turnAbout(90, [0, 0]));
  assert.deepEqual([turned.at, turned.rotation_deg, turned.repeat.step], [[-2, 2], 90, [-2, 0]]);
});

test("rectangles become other shapes where they must", () => {
  const block = after("/fixtures/1", turnAbout(30, [5, 5]));
  assert.deepEqual([block.at, block.size, block.rotation_deg, block.min], [[5, 5, 0], [1, 2, 1], 30, undefined]);
  assert.equal(after("/transceivers/keep_out/0", turnAbout(45, [1, 1])).polygon.length, 4);
  assert.deepEqual(after("/fixtures/1", turnAbout(90, [5, 5])).min, [3, 5, 0]);
});

test("what has no place of its own stays", () => {
  assert.equal(after("/transceivers/areas/1", shiftBy([1, 0])), "follows");
  assert.equal(after("/transceivers/on/0", shiftBy([1, 0])), "follows");
  assert.equal(after("/room/openings/0", shiftBy([1, 0])), "follows");
  assert.equal(after("/transceivers/grids/0", turnAbout(30, [0, 0])), "grid");
});

test("a fixture against a wall slides along it", () => {
  const json = { fixtures: [{ type: "gondola", id: "A", against: { wall: 0, from: 1 }, length: 1, depth: 1 }] };
  const element = elementAt(json, "/fixtures/0");
  const part = { outline: [], against: { along: [0, 1] } };
  const context = { ...element, effective: element.value, parts: [part], unit: metre };
  const builder = new EditBuilder(json);
  assert.equal(moveElement(builder, context, shiftBy([3, 0.5])), null);
  assert.deepEqual(builder.ops, [{ path: "/fixtures/0/against/from", before: 1, after: 1.5 }]);
  assert.equal(moveElement(new EditBuilder(json), context, turnAbout(90, [0, 0])), "against");
});

const footings = fc.record({
  at: fc.tuple(double(-20, 20), double(-20, 20)),
  rotation: fc.integer({ min: 0, max: 359 }),
  length: double(0.5, 10),
  depth: double(0.3, 2),
});
const point = fc.tuple(fc.integer({ min: -9, max: 9 }), fc.integer({ min: -9, max: 9 }));

test("a mirrored rectangle covers the mirror image of the rectangle, and faces as it", () => {
  fc.assert(
    fc.property(footings, point, fc.constantFrom(0, 1), (footing, fixed, axis) => {
      const motion = mirrorAt(axis, fixed);
      const image = outlineOf(footing).map((corner) => moved(corner, motion));
      const [a, b, c, d] = outlineOf(movedFooting(footing, motion));
      // The front runs the other way.
      near([b, a, d, c].flat(), image.flat());
    }),
  );
});

test("a turned rectangle covers the turned rectangle", () => {
  fc.assert(
    fc.property(footings, point, fc.integer({ min: -360, max: 360 }), (footing, fixed, degrees) => {
      const motion = turnAbout(degrees, fixed);
      const image = outlineOf(footing).map((corner) => moved(corner, motion));
      near(outlineOf(movedFooting(footing, motion)).flat(), image.flat());
    }),
  );
});

test("the opposite side stays when a side moves", () => {
  const corners = { x0: [1, 2], x1: [0, 3], y0: [2, 3], y1: [0, 1] };
  fc.assert(
    fc.property(footings, point, fc.constantFrom("x0", "x1", "y0", "y1"), (footing, to, side) => {
      const frame = { ...footing, sides: ["x0", "x1", "y0", "y1"] };
      const next = resizedFrame(frame, side, to, metre);
      const [before, now] = [outlineOf(frame), outlineOf(next)];
      for (const corner of corners[side]) near(now[corner], before[corner]);
      const size = side.startsWith("x") ? next.length : next.depth;
      assert.ok(size >= 0.05 && Math.abs(size * 100 - Math.round(size * 100)) < 1e-6);
    }),
  );
});

/** The direction of a unit's light that leaves it at an angle from its x direction, by the formula of the documentation. */
function lightOf(axis, roll, phi) {
  const size = Math.hypot(...axis);
  const a = axis.map((value) => value / size);
  const along = Math.abs(a[0]) > Math.cos((0.08 * Math.PI) / 180) ? [0, 1, 0] : [1, 0, 0];
  const share = a.reduce((sum, value, k) => sum + value * along[k], 0);
  const part = along.map((value, k) => value - share * a[k]);
  const x = part.map((value) => value / Math.hypot(...part));
  const y = [a[1] * x[2] - a[2] * x[1], a[2] * x[0] - a[0] * x[2], a[0] * x[1] - a[1] * x[0]];
  const angle = ((roll + phi) * Math.PI) / 180;
  return x.map((value, k) => Math.cos(angle) * value + Math.sin(angle) * y[k]);
}

test("the light of a unit turns with it", () => {
  const axes = fc
    .tuple(double(-1, 1), double(-1, 1), double(-1, 1))
    .filter((axis) => Math.hypot(...axis) > 0.1 && Math.hypot(axis[1], axis[2]) > 0.01);
  fc.assert(
    fc.property(axes, fc.integer({ min: 0, max: 359 }), fc.integer({ min: 0, max: 359 }), (axis, roll, degrees) => {
      const motion = turnAbout(degrees, [0, 0]);
      const next = movedAxis(axis, motion);
      fc.pre(Math.hypot(next[1], next[2]) > 0.01);
      const light = lightOf(axis, roll, 40);
      const [x, y] = moved([light[0], light[1]], motion);
      near(lightOf(next, movedRoll(axis, roll, motion), 40), [x, y, light[2]], 1e-5);
    }),
  );
});

test("alignment and distribution", () => {
  const box = (x, y, w, h) => ({ lower: [x, y], upper: [x + w, y + h] });
  const boxes = [box(0, 0, 2, 1), box(5, 3, 1, 1), box(2.5, 7, 1, 2)];
  assert.deepEqual(aligned(boxes, "left"), points("0,0 -5,0 -2.5,0"));
  assert.deepEqual(aligned(boxes, "top"), points("0,8 0,5 0,0"));
  assert.deepEqual(distributed(boxes, 0), points("0,0 0,0 0.5,0"));
});

test("new ids are free", () => {
  const taken = new Set(["A1", "A2", "A4", "till", "till 2", "P{n}", "007", "008"]);
  assert.equal(nextId("A1", taken), "A3");
  assert.equal(nextId("till", taken), "till 3");
  assert.equal(nextId("P{n}", taken), "P{n}-2");
  assert.equal(nextId("007", taken), "009");
});
