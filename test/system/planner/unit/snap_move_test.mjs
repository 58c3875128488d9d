import assert from "node:assert/strict";
import { test } from "node:test";

import fc from "fast-check";

import { moved, movedPart, movedVector, outlineOf, turnAbout } from "../../../../src/page/planner/geometry/rigid";
import { snapMove } from "../../../../src/page/planner/snap/box";
import { segmentsOf } from "../../../../src/page/planner/snap/segments";
import { Snapper } from "../../../../src/page/planner/snap/snap";
import { reach, shop } from "./snap_shop.mjs";
import { distance, double, near, part, points, rejects, square, times } from "./support.mjs";

const shopSnapper = new Snapper(segmentsOf(shop));

test("a rectangle keeps the width of the aisle", () => {
  // A and B are 1.5 m apart.
  const drawn = shopSnapper.snap({ pointer: [7.03, 6.98], reach, drawn: [[3, 8.2]], isBox: true });
  assert.equal(drawn.kind, "gap");
  assert.ok(Math.abs(drawn.at[1] - 7) < 1e-9);
  assert.deepEqual(
    drawn.guides.filter(({ kind }) => kind === "gap").map((one) => one.distance),
    [1.5, 1.5],
  );
});

test("a moved outline joins corners, lies on sides, and keeps gaps", () => {
  const box = square(20, 20, 1.3, 0.6);
  const to = (x, y, more) => {
    const { shift, guides } = snapMove(shopSnapper, box, [x - 20, y - 20], { reach, ...more });
    return { at: [20 + shift[0], 20 + shift[1]], kinds: guides.map(({ kind }) => kind), guides };
  };
  near(to(8.06, 2.04).at, [8, 2]);
  assert.ok(to(8.06, 2.04).kinds.includes("end"));
  near(to(4.44, 5.56).at, [4.44, 5.5]);
  assert.deepEqual(to(4.44, 5.56).kinds, ["line"]);
  near(to(4.44, 7.02).at, [4.44, 7]);
  near(to(4.44, 6.93).at, [4.44, 6.95]); // in the middle between B and the wall
  assert.deepEqual(
    to(4.44, 7.02).guides.map((one) => one.distance),
    [1.5, 1.5],
  );
  near(to(2.04, 6.2).at, [2, 6.2]);
  // In the middle between A and B.
  near(to(4.44, 3.44).at, [4.44, 3.45]);
  near(to(4.44, 3.44, { axis: 0 }).at, [4.44, 3.44]);
  near(to(8.06, 2.04, { isFree: true }).at, [8.06, 2.04]);
  near(to(6, 1).at, [6, 1]);
});

test("a moved outline follows a turned room", () => {
  const turn = 23;
  const motion = turnAbout(turn, [4, -2]);
  const snapper = new Snapper(segmentsOf(shop.map((one) => movedPart(one, motion))));
  const box = square(20, 20, 1.3, 0.6);
  const shifts = fc.tuple(double(-21, -8), double(-21, -10));
  const isRight = (frame) =>
    fc.assert(
      fc.property(shifts, (shift) => {
        const before = snapMove(shopSnapper, box, shift, { reach });
        const after = snapMove(
          snapper,
          box.map((corner) => moved(corner, motion)),
          movedVector(shift, motion),
          { reach, frame },
        );
        near(after.shift, movedVector(before.shift, motion), 1e-6);
        assert.ok(distance(before.shift, shift) <= Math.SQRT2 * reach);
      }),
      { numRuns: times(100, 500) },
    );
  isRight(turn);
  rejects(() => isRight(0));
});

test("the work does not grow with the shop", () => {
  const corner = double(0, 80);
  const footing = fc.record({
    at: fc.tuple(corner, corner),
    rotation: fc.constantFrom(0, 90, 180, 270, 30),
    length: double(0.5, 8),
    depth: double(0.4, 1.2),
  });
  const fixtures = (count) =>
    fc.sample(footing, { numRuns: count, seed: 7 }).map((one, k) => part(`${k}`, "fixture", outlineOf(one)));
  const drawn = points("1,1 5,1.2");
  const most = (parts) => {
    const snapper = new Snapper(segmentsOf(parts));
    let found = 0;
    for (const [k, pointer] of fc.sample(fc.tuple(corner, corner), { numRuns: times(5, 100), seed: 8 }).entries())
      for (const size of [0.002, 0.1, 0.3, 20]) {
        snapper.snap({ pointer, reach: size, drawn, isOrtho: k % 3 === 0, isBox: k % 3 === 1 });
        found = Math.max(found, snapper.index.examined);
        snapMove(snapper, parts[0].outline, pointer, { reach: size });
        found = Math.max(found, snapper.index.examined);
      }
    return found;
  };
  // 256 segments and 64 near the pointer, 8 at the beginning, and 64 bodies; of a moved outline 256, 128 and 64.
  assert.ok(most(fixtures(500)) <= 448);
  assert.ok(most(fixtures(2500)) <= 448);
});
