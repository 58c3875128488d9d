import assert from "node:assert/strict";
import { test } from "node:test";

import { addPoint, back, begin, dragged, end } from "../../../../src/page/planner/draw/stroke";
import { near, points } from "./support.mjs";

const grown = (text, tool = "room") =>
  points(text).reduce((step, point) => addPoint(step.stroke, point), { stroke: begin(tool) });

test("a stroke grows, refuses crossing edges, closes, and shrinks", () => {
  const three = grown("0,0 4,0 4,4");
  assert.equal(three.stroke.points.length, 3);
  const refused = addPoint(three.stroke, [2, -1]);
  assert.equal(refused.stroke.points.length, 3);
  assert.equal(refused.stroke.crossings.length, 2);
  assert.deepEqual(addPoint(three.stroke, [0, 0]).done, points("0,0 4,0 4,4"));
  assert.deepEqual(addPoint(three.stroke, [4, 4]).done?.length, 3, "a double click");
  assert.equal(back(three.stroke).points.length, 2);
  const bow = { ...grown("0,0 4,4 4,0").stroke, points: points("0,0 4,4 4,0 0,4") };
  assert.ok("stroke" in end(bow), "the closing edge crosses");
  assert.deepEqual(grown("0,0 3,0", "run").done, points("0,0 3,0"));
  assert.equal(end(begin("wall")).stroke.points.length, 0);
});

test("a drag draws a rectangle", () => {
  assert.deepEqual(dragged(begin("zone"), [0, 0], [2, 1]), points("0,0 2,0 2,1 0,1"));
  near(dragged(begin("zone"), [0, 0], [0, 2], 45).flat(), [0, 0, 1, 1, 0, 2, -1, 1], 1e-9);
  assert.equal(dragged(begin("zone"), [0, 0], [2, 0]), null);
});
