import assert from "node:assert/strict";
import { test } from "node:test";

import { addPoint, back, begin, dragged, end } from "../../../../src/page/planner/draw/stroke";

test("a stroke grows, refuses crossing edges, closes, and shrinks", () => {
  const grown = (points) => points.reduce((step, point) => addPoint(step.stroke, point), { stroke: begin("room") });
  const three = grown([
    [0, 0],
    [4, 0],
    [4, 4],
  ]); // prettier-ignore
  assert.equal(three.stroke.points.length, 3);
  const refused = addPoint(three.stroke, [2, -1]);
  assert.equal(refused.stroke.points.length, 3);
  assert.equal(refused.stroke.crossings.length, 2);
  assert.deepEqual(addPoint(three.stroke, [0, 0]).done, [
    [0, 0],
    [4, 0],
    [4, 4],
  ]); // prettier-ignore
  assert.deepEqual(addPoint(three.stroke, [4, 4]).done?.length, 3, "a double click");
  assert.equal(back(three.stroke).points.length, 2);
  const bow = grown([
    [0, 0],
    [4, 4],
    [4, 0],
  ]).stroke; // prettier-ignore
  assert.ok(
    "stroke" in
      end({
        ...bow,
        points: [
          [0, 0],
          [4, 4],
          [4, 0],
          [0, 4],
        ],
      }),
    "the closing edge crosses",
  ); // prettier-ignore
  assert.deepEqual(addPoint(addPoint(begin("run"), [0, 0]).stroke, [3, 0]).done, [
    [0, 0],
    [3, 0],
  ]); // prettier-ignore
  assert.deepEqual(dragged(begin("zone"), [0, 0], [2, 1]), [
    [0, 0],
    [2, 0],
    [2, 1],
    [0, 1],
  ]); // prettier-ignore
  const turned = dragged(begin("zone"), [0, 0], [0, 2], 45);
  turned.forEach((corner, k) =>
    assert.ok(Math.hypot(corner[0] - [0, 1, 0, -1][k], corner[1] - [0, 1, 2, 1][k]) < 1e-9),
  );
  assert.equal(dragged(begin("zone"), [0, 0], [2, 0]), null);
  assert.equal(end(begin("wall")).stroke.points.length, 0);
});
