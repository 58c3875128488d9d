import assert from "node:assert/strict";
import { test } from "node:test";

import fc from "fast-check";

import { area, distanceTo } from "../../../../src/page/planner/geometry/polygon";
import { fixtureLine, simplified } from "../../../../src/page/planner/make/outline";
import { double, points, rectangle } from "./support.mjs";

const circle = (count, radius) =>
  Array.from({ length: count }, (_, k) => {
    const angle = (2 * Math.PI * k) / count;
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
  });

test("outlines lose corners that change them by less than 2 mm", () => {
  const square = points("0,0 1,0.001 2,0 2,0 2,2 0,2 0,1");
  const byPlace = ([x, y], [u, v]) => x - u || y - v;
  assert.deepEqual(simplified(square).sort(byPlace), points("0,0 0,2 2,0 2,2"));
  const begun = simplified(points("1,0 2,0 2,1 0,1 0,0"));
  assert.equal(begun.length, 4, "an outline that begins in the middle of an edge");
  const column = simplified(circle(158, 0.2));
  assert.ok(column.length >= 8 && column.length < 40, `${column.length} corners`);
  assert.ok(Math.abs(area(column) / (Math.PI * 0.04) - 1) < 0.03);
  fc.assert(
    fc.property(fc.integer({ min: 3, max: 200 }), double(0.05, 20), (count, radius) => {
      const outline = circle(count, radius);
      const kept = simplified(outline);
      for (const corner of outline) assert.ok(distanceTo(kept, corner) <= 0.00201);
      assert.ok(kept.every((corner) => outline.includes(corner)));
    }),
  );
});

test("a rectangle is a fixture along its middle, or with its back to the nearest wall", () => {
  const outline = rectangle(1, 1, 7, 2);
  assert.deepEqual(fixtureLine(outline, false, []), {
    line: points("1,1.5 7,1.5"),
    depth: 1,
  });
  const walls = [
    { from: [0, 0], to: [10, 0] },
    { from: [10, 2.1], to: [0, 2.1] },
  ];
  // The front is to the right of the line, away from the upper wall.
  assert.deepEqual(fixtureLine(outline, true, walls), {
    line: points("1,2 7,2"),
    depth: 1,
  });
  assert.deepEqual(fixtureLine(outline, true, walls.slice(0, 1)).line, points("7,1 1,1"));
  const [a, b, c, d] = outline;
  for (const turned of [
    [b, c, d, a],
    [d, c, b, a],
  ])
    assert.equal(fixtureLine(turned, true, walls).depth, 1);
  assert.equal(fixtureLine([a, b, c], false, []), null);
});
