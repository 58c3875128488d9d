import assert from "node:assert/strict";
import { test } from "node:test";

import fc from "fast-check";

import { Refused } from "../../../../src/page/planner/document/connection";
import { Newest } from "../../../../src/page/planner/document/newest";
import { addPoint, begin } from "../../../../src/page/planner/draw/stroke";
import { axisOf, headed, headingOf, lowered, tilted, tiltOf, turned } from "../../../../src/page/planner/units/aim";
import { mountAt, mountWords } from "../../../../src/page/planner/units/mount";
import { alongFace, meets } from "../../../../src/page/planner/units/surface";
import { double, isNear, part, square } from "./support.mjs";

const close = (a, b) => isNear(a, b, 2e-5);

test("tilt and direction of an axis, by the compass", () => {
  assert.equal(tiltOf([0, 0, -1]), 0);
  assert.equal(headingOf([0, 0, -1]), null);
  assert.equal(headingOf([0, 0, 1]), null);
  assert.deepEqual([tiltOf([0, 1, 0]), headingOf([0, 1, 0])], [90, 0]);
  assert.deepEqual([tiltOf([1, 0, -1]), headingOf([1, 0, -1])], [45, 90], "east");
  assert.deepEqual(headingOf([-1, 0, -1]), 270, "west");
  assert.deepEqual(axisOf(0, 123), [0, 0, -1]);
  fc.assert(
    fc.property(double(1, 179), double(0, 359), (tilt, heading) => {
      const axis = axisOf(tilt, heading);
      assert.ok(Math.abs(Math.hypot(...axis) - 1) < 1e-5);
      assert.ok(Math.abs(tiltOf(axis) - tilt) < 2e-3);
      const turn = Math.abs(headingOf(axis) - heading) % 360;
      assert.ok(Math.min(turn, 360 - turn) < 1e-2, `${headingOf(axis)} instead of ${heading}`);
    }),
  );
});

test("a unit turns as a whole, and leans to the side to which it leaned", () => {
  const down = { axis: [0, 0, -1], roll_deg: 0 };
  assert.deepEqual(turned(down, 90), { axis: [0, 0, -1], roll_deg: 270 }, "a turn to the left, seen from above");
  assert.deepEqual(turned(turned(down, 90), -90), down);
  assert.deepEqual(headingOf(tilted(down, 30).axis), 0);
  const east = { axis: axisOf(30, 90), roll_deg: 10 };
  assert.equal(headingOf(tilted(east, 60).axis), 90);
  const south = headed(east, 180);
  assert.ok(Math.abs(headingOf(south.axis) - 180) < 1e-2 && Math.abs(tiltOf(south.axis) - 30) < 1e-2);
  assert.ok(close(headed(south, 90).axis, east.axis));
  assert.ok(Math.abs(headed(south, 90).roll_deg - 10) < 1e-2, "the angle about the axis comes back");
  assert.deepEqual(headed(down, 90), down, "straight down is no direction");
});

test("tilts on faces count downwards from the horizontal", () => {
  assert.ok(close(lowered([0, -1, 0], 0), [0, -1, 0]));
  assert.ok(close(lowered([0, -1, 0], 90), [0, 0, -1]));
  assert.ok(lowered([1, 0, 0], 30)[2] < 0 && lowered([1, 0, 0], -30)[2] > 0);
  assert.deepEqual(lowered([0, 0, -1], 30), [0, 0, -1], "no face");
});

test("one request at a time, and then the newest", async () => {
  const asked = [];
  const newest = new Newest((wanted) => new Promise((answer) => asked.push({ wanted, answer })));
  const first = newest.get(1);
  const second = newest.get(2);
  const third = newest.get(3);
  assert.equal(await second, null, "overtaken");
  assert.deepEqual(
    asked.map(({ wanted }) => wanted),
    [1],
  );
  asked[0].answer("a");
  assert.equal(await first, "a");
  await new Promise(setImmediate);
  assert.deepEqual(
    asked.map(({ wanted }) => wanted),
    [1, 3],
  );
  const fourth = newest.get(4);
  newest.stop();
  assert.equal(await fourth, null, "stopped before it was asked");
  asked[1].answer("c");
  assert.equal(await third, null, "late");
  const fifth = newest.get(5);
  await new Promise(setImmediate);
  asked[2].answer("e");
  assert.equal(await fifth, "e", "it goes on after a stop");
  const failing = new Newest(() => Promise.reject(new Error("lost")));
  assert.equal(await failing.get(1), null);
  assert.equal(await failing.get(2), null, "an error does not end it");
});

test("a refused mount gives its reason", async () => {
  const refusing = { request: () => Promise.reject(new Refused({ message: "no such unit" })) };
  assert.equal(await mountAt(refusing, { at: [0, 0], unit: 7 }), "no such unit");
  const mount = { position: [1, 2, 3], axis: [0, 0, -1], roll_deg: 0, on: "ceiling", name: "" };
  assert.deepEqual(await mountAt({ request: () => Promise.resolve({ mount }) }, { at: [1, 2] }), mount);
});

test("where a unit is mounted, in words", () => {
  const words = (on, name) => mountWords({ position: [0, 0, 0], axis: [0, 0, -1], roll_deg: 0, on, name });
  assert.equal(words("ceiling", ""), "below the ceiling");
  assert.equal(words("rail", "R1"), "on rail R1");
  assert.equal(words("rail"), "on a rail");
  assert.equal(words("face", "column 2"), "on the face of column 2");
  assert.equal(words("face", "wall 2"), "on wall 2");
  assert.equal(words("free", ""), "hanging freely");
});

test("a tool of single points ends with each of them", () => {
  for (const tool of ["unit", "faces"]) assert.deepEqual(addPoint(begin(tool), [1, 2]), { done: [[1, 2]] });
  assert.equal(addPoint(begin("rail"), [1, 2]).stroke.points.length, 1);
});

const column = { ...part("column", "fixture", square(4, 4, 1)), path: "/fixtures/0", height: 3 };
const ray = (from, to) => ({ from, way: to.map((value, axis) => value - from[axis]) });
const mounted = (on, position, axis) => ({ on, position, axis, roll_deg: 0 });

test("a ray meets the height of a ceiling or rail", () => {
  for (const on of ["ceiling", "rail", "free"]) {
    const mount = mounted(on, [1, 1, 3], [0, 0, -1]);
    assert.ok(close(meets(ray([0, 0, 1], [1, 2, 2]), mount, []), [2, 4, 3]));
    assert.equal(meets(ray([0, 0, 1], [1, 0, 1]), mount, []), null, "along the ceiling");
    assert.equal(meets(ray([0, 0, 1], [1, 0, 0]), mount, []), null, "away from it");
  }
});

test("a ray meets a face, and the next one around the corner", () => {
  const south = mounted("face", [4.5, 3.98, 2], [0, -1, 0]);
  const eye = [8, 0, 2.5];
  assert.ok(close(meets(ray(eye, [4.7, 4, 1.5]), south, [column]), [4.7, 4, 1.5]));
  assert.ok(close(meets(ray(eye, [5, 4.4, 1.5]), south, [column]), [5, 4.4, 1.5]), "the east face");
  const beside = meets(ray(eye, [3, 4, 2]), south, [column]);
  assert.ok(close([beside[1]], [3.98]), "beside the column, the plane of the face goes on");
  assert.ok(close(meets(ray(eye, [4.7, 3.98, 1.5]), south, []), [4.7, 3.98, 1.5]), "a wall without an outline");
});

test("arrow keys move along a face as it is seen", () => {
  assert.deepEqual(alongFace([0, -1], [1, 2]), [1, 0, 2]);
  assert.ok(close(alongFace([0.5, 0], [1, 0]), [0, 1, 0]), "to the north, for somebody who looks to the west");
});
