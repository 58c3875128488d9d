import assert from "node:assert/strict";
import { test } from "node:test";

import fc from "fast-check";

import { signedArea } from "../../../../src/page/planner/geometry/polygon";
import { selfCrossings } from "../../../../src/page/planner/snap/crossings";
import { rejects, square, times } from "./support.mjs";

/** The exact answer for whole numbers. */
function meet([a, b], [c, d]) {
  const turn = (p, q, r) => Math.sign((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
  const holds = (p, q, r) =>
    turn(p, q, r) === 0 &&
    Math.min(p[0], q[0]) <= r[0] &&
    r[0] <= Math.max(p[0], q[0]) &&
    Math.min(p[1], q[1]) <= r[1] &&
    r[1] <= Math.max(p[1], q[1]);
  if (holds(a, b, c) || holds(a, b, d) || holds(c, d, a) || holds(c, d, b)) return true;
  return turn(a, b, c) !== turn(a, b, d) && turn(c, d, a) !== turn(c, d, b);
}

const whole = fc.integer({ min: -5, max: 5 });
const polygon = fc.uniqueArray(fc.tuple(whole, whole), { minLength: 3, maxLength: 8, selector: String });

const findsCrossings = (crossingsOf) =>
  fc.assert(
    fc.property(polygon, fc.boolean(), (corners, isClosed) => {
      const count = corners.length - (isClosed ? 0 : 1);
      const edge = (k) => [corners[k], corners[(k + 1) % corners.length]];
      const expected = [];
      for (let j = 1; j < count; ++j)
        for (let i = 0; i < j; ++i) {
          const [shared] = edge(i).filter((corner) => edge(j).includes(corner));
          const others = [...edge(i), ...edge(j)].filter((corner) => corner !== shared);
          // With a common corner, edges overlap if they leave it in the same direction.
          const [u, v] = others.map((corner) => corner.map((value, k) => value - (shared?.[k] ?? 0)));
          const isWrong = shared
            ? u[0] * v[1] === u[1] * v[0] && u[0] * v[0] + u[1] * v[1] > 0
            : meet(edge(i), edge(j));
          if (isWrong) expected.push([i, j]);
        }
      assert.deepEqual(crossingsOf(corners, isClosed), expected);
    }),
    { numRuns: times(200, 5000) },
  );

test("edges of a drawing that cross or touch are found, and no others", () => {
  findsCrossings(selfCrossings);
  rejects(() => findsCrossings((corners, isClosed) => selfCrossings(corners, isClosed).slice(1)));
  rejects(() => findsCrossings((corners) => selfCrossings(corners, false)));
});

test("the area of a drawing says which way it runs", () => {
  assert.equal(signedArea(square(1, 1, 2)), 4);
  assert.equal(signedArea(square(1, 1, 2).reverse()), -4);
});
