import assert from "node:assert/strict";
import { test } from "node:test";

import fc from "fast-check";

import { area, contains, distanceTo, touches } from "../../../../src/page/planner/geometry/polygon";
import { roundLength } from "../../../../src/page/planner/plan/scale_bar";
import { distanceTo as distanceAlong } from "../../../../src/page/planner/space/prisms";
import { pointsOf } from "../../../../src/page/planner/view/fan";
import { itemAt } from "../../../../src/page/planner/view/hit";
import { Selection } from "../../../../src/page/planner/view/selection";
import { Viewport } from "../../../../src/page/planner/view/viewport";
import { double, near, part, square } from "./support.mjs";

const changes = { note: () => {} };

test("zooming keeps the place under the pointer, and stays within limits", () => {
  fc.assert(
    fc.property(double(0, 700), double(0, 700), double(0.01, 100), (x, y, factor) => {
      const viewport = new Viewport(changes);
      viewport.resize(700, 500);
      const before = viewport.toWorld([x, y]);
      viewport.zoom(factor, [x, y]);
      const after = viewport.toWorld([x, y]);
      near(after, before, 1e-9);
      assert.ok(viewport.scale >= 0.5 && viewport.scale <= 6000);
      near(viewport.toScreen(after), [x, y]);
    }),
  );
});

test("everything fits", () => {
  const viewport = new Viewport(changes);
  viewport.resize(700, 500);
  viewport.fit({ lower: [10, 10], upper: [30, 14] });
  const [[left, bottom], [right, top]] = [viewport.toScreen([10, 10]), viewport.toScreen([30, 14])];
  assert.ok(left >= 40 && right <= 660 && top >= 40 && bottom <= 460 && right - left > 500);
});

test("outlines", () => {
  assert.ok(contains(square(0, 0, 2), [1, 1]) && !contains(square(0, 0, 2), [3, 1]));
  assert.equal(area(square(0, 0, 2)), 4);
  assert.equal(distanceTo(square(0, 0, 2), [3, 1]), 1);
  assert.ok(touches(square(0, 0, 10), { lower: [4, 4], upper: [5, 5] }), "a frame inside of an outline touches it");
  assert.ok(touches(square(0, 0, 2), { lower: [1, -5], upper: [1.5, 5] }), "a frame across an outline touches it");
  assert.ok(!touches(square(0, 0, 2), { lower: [3, 3], upper: [5, 5] }));
});

test("the smallest outline at a point is found, and lines only at their lines", () => {
  const all = [
    part("room", "room", square(0, 0, 20)),
    part("zone", "zone", square(2, 2, 8)),
    part("large", "fixture", square(3, 3, 6)),
    part("small", "fixture", square(4, 4, 1)),
  ];
  const none = { kind: "label", count: 0, position: [] };
  const sight = (hidden = []) => ({
    document: { parts: { all }, labels: none, units: { ...none, kind: "unit" } },
    layers: { isFree: (kind) => !hidden.includes(kind), isLevelFree: () => true },
    fan: { reach: 0, isCovered: () => false },
    mover: { shown: null },
  });
  const at = (point, hidden) => itemAt(sight(hidden), point, 0.1)?.path ?? null;
  assert.equal(at([4.5, 4.5]), "/small");
  assert.equal(at([6, 6]), "/large");
  assert.equal(at([2.5, 2.5]), null, "in a zone");
  assert.equal(at([2, 5]), "/zone", "on the border of a zone");
  assert.equal(at([15, 15]), null, "on the floor");
  assert.equal(at([20, 15]), "/room");
  assert.equal(at([4.5, 4.5], ["fixture"]), null);
});

test("the scale bar has a round length that fits", () => {
  fc.assert(
    fc.property(double(0.5, 6000), fc.constantFrom(1, 0.3048), (scale, unit) => {
      const length = roundLength(scale, unit);
      const pixels = length * unit * scale;
      assert.ok(pixels <= 130.0001 && pixels > 130 / 2.51, `${pixels}`);
      assert.ok(["1", "2", "5"].includes(length.toExponential(6)[0]));
    }),
  );
});

test("labels at one point are ranked by their heights", () => {
  const position = Float32Array.from([1, 1, 0.8, 1, 1, 0.3, 2, 1, 0.3, 1, 1, 1.7]);
  const { ranks, groups } = pointsOf({ count: 4, position });
  assert.deepEqual([...ranks], [1, 0, 0, 2]);
  assert.deepEqual([...groups], [0, 0, 1, 0]);
});

test("a ray hits the top or a side of a fixture", () => {
  const fixture = { ...part("a", "fixture", square(0, 0, 2)), height: 1.5 };
  assert.equal(distanceAlong(fixture, { from: [1, 1, 5], way: [0, 0, -1] }), 3.5);
  assert.equal(distanceAlong(fixture, { from: [-4, 1, 1], way: [1, 0, 0] }), 4);
  assert.equal(distanceAlong(fixture, { from: [-4, 1, 2], way: [1, 0, 0] }), Infinity);
  assert.equal(distanceAlong(fixture, { from: [5, 1, 1], way: [1, 0, 0] }), Infinity);
});

test("a selection of thousands takes no time", () => {
  const selection = new Selection(changes);
  const paths = Array.from({ length: 20000 }, (_, k) => `/labels/${k}`);
  const begin = performance.now();
  selection.setPaths(paths);
  selection.setPaths([...paths].reverse());
  assert.ok(paths.every((path) => selection.has({ kind: "element", path })));
  assert.ok(performance.now() - begin < 2000);
});
