import assert from "node:assert/strict";
import { test } from "node:test";

import fc from "fast-check";

import { moved, movedPart, movedVector, outlineOf, turnAbout } from "../../../../src/page/planner/geometry/rigid";
import { snapMove } from "../../../../src/page/planner/snap/box";
import { selfCrossings, shortEdges, signedArea } from "../../../../src/page/planner/snap/crossings";
import { mainDirection, segmentsOf } from "../../../../src/page/planner/snap/segments";
import { Snapper } from "../../../../src/page/planner/snap/snap";

const reach = 0.1;
const square = (x, y, width, height = width) => [
  [x, y],
  [x + width, y],
  [x + width, y + height],
  [x, y + height],
];
const part = (key, kind, outline, more = {}) => ({ key, path: `/${key}`, kind, id: key, outline, ...more });
const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);
const isNear = (a, b, slack = 1e-6) => distance(a, b) <= slack;
const near = (a, b, slack) => assert.ok(isNear(a, b, slack), `${a} is not ${b}`);
const rejects = (check) => assert.throws(check, { name: /AssertionError|Error/ });

const room = part("room", "room", square(0, 0, 12, 9));
/** Two rows with an aisle of 1.5 m, and a table that is turned. */
const shop = [
  room,
  part("A", "fixture", square(2, 2, 6, 1)),
  part("B", "fixture", square(2, 4.5, 6, 1)),
  part("T", "fixture", outlineOf({ at: [9.5, 2], rotation: 30, length: 1.2, depth: 0.8 })),
];
const shopSnapper = new Snapper(segmentsOf(shop));
const snap = (pointer, more = {}) => shopSnapper.snap({ pointer, reach, ...more });

test("the edges of outlines attract, those of candidates and of moved parts do not", () => {
  const rail = part("rail", "rail", [...square(0, 0, 1)].slice(0, 3));
  const grid = part("grid", "grid", square(0, 0, 1));
  const area = part("area", "area", square(0, 0, 1));
  const pierced = part("pierced", "room", square(0, 0, 5), { holes: [square(1, 1, 2)] });
  assert.equal(segmentsOf([rail]).length, 2);
  assert.equal(segmentsOf([grid, area]).length, 0);
  assert.equal(segmentsOf([pierced]).length, 8);
  assert.equal(segmentsOf([rail, pierced], new Set(["pierced"])).length, 2);
  assert.equal(mainDirection(shop), 0);
  assert.equal(mainDirection([movedPart(room, turnAbout(100, [3, 1]))]), 10);
});

test("each kind of place, by its rank", () => {
  const of = (pointer, more) => {
    const { at, kind } = snap(pointer, more);
    return [kind, ...at.map((value) => Number(value.toFixed(9)))];
  };
  assert.deepEqual(of([2.05, 2.05]), ["end", 2, 2]);
  assert.deepEqual(of([5.03, 3.05]), ["middle", 5, 3]);
  assert.deepEqual(of([3.3, 3.05]), ["line", 3.3, 3]);
  assert.deepEqual(of([3.35, 4.45], { drawn: [[3.3, 3.2]] }), ["perpendicular", 3.3, 4.5]);
  assert.deepEqual(of([8.8, 3.06]), ["extension", 8.8, 3]);
  // Beyond the end of B, and as high as where the line began.
  assert.deepEqual(of([8.03, 7.02], { drawn: [[5, 7]] }), ["extension", 8, 7]);
  assert.deepEqual(of([6.6, 7.02], { drawn: [[5, 7]] }), ["align", 6.6, 7]);
  assert.deepEqual(of([6.6, 3.9]), [null, 6.6, 3.9]);
  assert.deepEqual(of([2.05, 2.05], { isFree: true }), [null, 2.05, 2.05]);
  const crossed = new Snapper([
    { from: [0, 0], to: [2, 2.5] },
    { from: [0, 2], to: [2.5, 0] },
  ]);
  assert.equal(crossed.snap({ pointer: [0.99, 1.2], reach }).kind, "crossing");
});

test("guides say why, and how far", () => {
  const { guides } = snap([9.53, 0.8]);
  assert.equal(guides.length, 1);
  assert.equal(guides[0].kind, "align");
  near(guides[0].from, [9.5, 2]);
  assert.ok(Math.abs(guides[0].distance - 1.2) < 1e-9);
});

test("Shift keeps multiples of 15 degrees to the previous edge, and lines cut the ray", () => {
  const along = (pointer, drawn, more) => snap(pointer, { drawn, isOrtho: true, ...more });
  near(along([5, 6.7], [[3.3, 6.65]]).at, [5, 6.65]);
  assert.equal(along([5, 6.7], [[3.3, 6.65]]).kind, "angle");
  const cut = along([3.33, 5.56], [[3.3, 6.65]]);
  assert.equal(cut.kind, "crossing");
  near(cut.at, [3.3, 5.5]);
  // The previous edge has 10 degrees.
  const edge = movedVector([1, 0], turnAbout(10, [0, 0]));
  const [x, y] = along(
    [5, 7.9],
    [
      [3.3 - edge[0], 6.65 - edge[1]],
      [3.3, 6.65],
    ],
  ).at;
  assert.ok(Math.abs((Math.atan2(y - 6.65, x - 3.3) * 180) / Math.PI - 40) < 1e-9);
});

const coordinate = fc.integer({ min: -600, max: 600 }).map((value) => value / 100);
const place = fc.tuple(coordinate, coordinate);
/** Off the grid of the others, so that rounding decides nothing. */
const offGrid = place.map(([x, y]) => [x + 0.00313, y + 0.00171]);
const segment = fc.tuple(place, place).filter(([from, to]) => distance(from, to) > 0.02);
const segments = fc.array(segment, { maxLength: 12 }).map((all) => all.map(([from, to]) => ({ from, to })));
const drawing = fc.uniqueArray(place, { maxLength: 4, selector: String });

/** A pointer that is near one of the segments more often than not. */
const scene = fc
  .record({ all: segments, drawn: drawing, away: offGrid, share: fc.double({ min: 0, max: 1, noNaN: true }) })
  .map(({ all, drawn, away, share }) => {
    const [first] = all;
    if (!first) return { all, request: { pointer: away, reach, drawn } };
    const at = (k) => first.from[k] + share * (first.to[k] - first.from[k]) + away[k] / 60;
    return { all, request: { pointer: [at(0), at(1)], reach, drawn } };
  });

const staysWithin = (snapOf) =>
  fc.assert(
    fc.property(scene, ({ all, request }) => {
      const { at, kind } = snapOf(all, request);
      if (kind === null) assert.deepEqual(at, request.pointer);
      else assert.ok(distance(at, request.pointer) <= reach + 1e-9);
    }),
  );
const usual = (all, request) => new Snapper(all).snap(request);

test("the result is within reach of the pointer, or the pointer itself", () => {
  staysWithin(usual);
  // Negative control: a longer reach than the one that was asked for.
  rejects(() => staysWithin((all, request) => usual(all, { ...request, reach: 3 * reach })));
});

const rank = ["end", "crossing", "middle", "line", "extension"];
/** At the same distance from the pointer: one place of each kind. */
const ranked = (snapOf) =>
  fc.assert(
    fc.property(fc.integer({ min: 0, max: 359 }), fc.shuffledSubarray(rank, { minLength: 1 }), (turn, kinds) => {
      const away = 0.05;
      const turned = (points) => points.map((point) => moved(point, turnAbout(turn, [1, 2])));
      const pair = (points) => ({ from: turned(points)[0], to: turned(points)[1] });
      const lines = {
        end: [
          [
            [away, 0],
            [3, 1.7],
          ],
        ],
        crossing: [
          [
            [-2, -away],
            [2.7, -away],
          ],
          [
            [-0.9, -0.9 - away],
            [0.6, 0.6 - away],
          ],
        ],
        middle: [
          [
            [-3.1, away - 0.9],
            [3.1, away + 0.9],
          ],
        ],
        line: [
          [
            [-away, -1.3],
            [-away, 2.1],
          ],
        ],
        extension: [
          [
            [-away, 0.9],
            [-away, 2.1],
          ],
        ],
      };
      fc.pre(!(kinds.includes("line") && kinds.includes("extension")));
      const all = kinds.flatMap((kind) => lines[kind].map(pair));
      const best = rank.find((kind) => kinds.includes(kind));
      const { kind } = snapOf(all, { pointer: turned([[0, 0]])[0], reach: 0.06, frame: 0 });
      // Two lines that happen to cross in reach come before all but ends.
      assert.ok(kind === best || (kind === "crossing" && best !== "end" && kinds.length > 1), `${kind}, not ${best}`);
    }),
  );

test("at the same distance the rank decides", () => {
  ranked(usual);
  rejects(() => ranked((all, request) => ({ ...usual(all, request), kind: "line" })));
});

const isStable = (snapOf) =>
  fc.assert(
    fc.property(scene, fc.boolean(), ({ all, request }, isOrtho) => {
      const once = snapOf(all, { ...request, isOrtho });
      const again = snapOf(all, { ...request, isOrtho, pointer: once.at, held: once });
      near(again.at, once.at, 2e-6);
      assert.equal(again.kind, once.kind);
    }),
  );

test("snapping a snapped place again changes nothing", () => {
  isStable((all, request) => usual(all, { ...request, held: request.held?.kind ? request.held : undefined }));
  // Negative control: without the memory, a place on a line jumps to an end near it.
  rejects(() => isStable((all, request) => usual(all, { ...request, held: undefined })));
});

const isRigid = (snapOf) =>
  fc.assert(
    fc.property(
      scene,
      fc.integer({ min: -180, max: 180 }),
      place,
      fc.boolean(),
      fc.boolean(),
      ({ all, request }, turn, fixed, isOrtho, isBox) => {
        const motion = turnAbout(turn, fixed);
        const carry = (point) => moved(point, motion);
        const before = snapOf(all, { ...request, isOrtho, isBox, frame: 0 });
        const after = snapOf(
          all.map(({ from, to }) => ({ from: carry(from), to: carry(to) })),
          {
            ...request,
            isOrtho,
            isBox,
            pointer: carry(request.pointer),
            drawn: request.drawn.map(carry),
            frame: turn,
          },
        );
        near(after.at, carry(before.at), 1e-5);
        assert.equal(after.kind, before.kind);
      },
    ),
  );

test("it is the same wherever the plan lies, and however it is turned", () => {
  isRigid(usual);
  rejects(() => isRigid((all, request) => usual(all, { ...request, frame: 0 })));
});

const caught = (snapOf) =>
  fc.assert(
    fc.property(fc.double({ min: 0, max: 1.95, noNaN: true }), fc.integer({ min: 0, max: 359 }), (share, direction) => {
      const drawn = [
        [0, 0],
        [4, 0.3],
        [4.2, 3],
      ];
      const pointer = movedVector([share * reach, 0], turnAbout(direction, [0, 0]));
      const { at, kind } = snapOf([], { pointer, reach, drawn, closes: true });
      assert.deepEqual([kind, at], ["close", [0, 0]]);
    }),
  );

test("the first corner attracts from twice as far", () => {
  caught(usual);
  rejects(() => caught((all, request) => usual(all, { ...request, closes: false })));
  const drawn = square(0, 0, 3).slice(0, 3);
  assert.notEqual(usual([], { pointer: [0.15, 0.15], reach, drawn: drawn.slice(0, 2), closes: true }).kind, "close");
  assert.equal(usual([], { pointer: [0.15, 0.16], reach, drawn, closes: true }).kind, null);
});

const typed = (snapOf) =>
  fc.assert(
    fc.property(
      scene,
      fc.double({ min: 0.01, max: 50, noNaN: true }),
      fc.option(fc.double({ min: -360, max: 360, noNaN: true }), { nil: undefined }),
      fc.boolean(),
      fc.boolean(),
      ({ all, request }, length, angle, isOrtho, isFree) => {
        fc.pre(request.drawn.length > 0);
        const from = request.drawn[request.drawn.length - 1];
        const { at } = snapOf(all, { ...request, length, angle, isOrtho, isFree });
        assert.ok(Math.abs(distance(at, from) - length) < 1e-9);
        if (angle === undefined) return;
        const way = [Math.cos((angle * Math.PI) / 180), Math.sin((angle * Math.PI) / 180)];
        near(at, [from[0] + length * way[0], from[1] + length * way[1]], 1e-9);
        const alone = snapOf(all, { ...request, angle });
        const off = (alone.at[0] - from[0]) * way[1] - (alone.at[1] - from[1]) * way[0];
        assert.ok(Math.abs(off) < 1e-9);
      },
    ),
  );

test("what is typed holds exactly", () => {
  typed(usual);
  rejects(() => typed((all, { length, angle, ...request }) => usual(all, request)));
});

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
const polygon = fc
  .uniqueArray(fc.tuple(whole, whole), { minLength: 3, maxLength: 8, selector: String })
  .map((corners) => corners.map(([x, y]) => [x, y]));

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
    { numRuns: 1000 },
  );

test("edges of a drawing that cross or touch are found, and no others", () => {
  findsCrossings(selfCrossings);
  rejects(() => findsCrossings((corners, isClosed) => selfCrossings(corners, isClosed).slice(1)));
  rejects(() => findsCrossings((corners) => selfCrossings(corners, false)));
});

test("area and length of a drawing", () => {
  assert.equal(signedArea(square(1, 1, 2)), 4);
  assert.equal(signedArea(square(1, 1, 2).reverse()), -4);
  const corners = [
    [0, 0],
    [1, 0],
    [1.004, 0.003],
    [0, 0.001],
  ];
  assert.deepEqual([shortEdges(corners, false), shortEdges(corners, true)], [[1], [1, 3]]);
});

/** The numbers of changes of the kind while the pointer trembles by a pixel along a way. */
function changes(from, to, isHeld) {
  let most = 0;
  let held;
  for (let k = 0; k <= 400; ++k) {
    const at = (share) => from.map((value, axis) => value + share * (to[axis] - value));
    const pixel = reach / 10 / distance(from, to);
    const kinds = [0, pixel, 0, pixel, 0].map((offset) => {
      const result = snap(at(k / 400 + offset), { held: isHeld ? held : undefined });
      held = result;
      return result.kind;
    });
    const count = kinds.slice(2).filter((kind, j) => kind !== kinds[j + 1]).length;
    most = Math.max(most, count);
  }
  return most;
}

test("marks do not flicker at the ends of reaches", () => {
  const ways = [
    [
      [3.3, 3.4],
      [3.4, 2.9],
    ],
    [
      [2.6, 3.05],
      [1.8, 3.04],
    ],
    [
      [4.2, 3.02],
      [5.6, 3.05],
    ],
    [
      [2.4, 2.6],
      [1.7, 1.7],
    ],
    [
      [9, 1.7],
      [10.9, 3.6],
    ],
  ];
  for (const [from, to] of ways) assert.equal(changes(from, to, true), 0);
  // Negative control: without the memory they do.
  assert.ok(ways.some(([from, to]) => changes(from, to, false) > 0));
});

test("a held place is left for a better one, and when the pointer leaves", () => {
  const line = snap([3.3, 3.05]);
  assert.equal(snap([3.4, 3.13], { held: line }).kind, "line");
  assert.notEqual(snap([3.4, 3.15], { held: line }).kind, "line");
  assert.equal(snap([3.4, 3.13]).kind, null);
  assert.equal(snap([2.08, 3.02], { held: line }).kind, "line");
  assert.equal(snap([2.05, 3.02], { held: line }).kind, "end");
});

test("the last centimetre joins, even with a short reach and another place held", () => {
  const close = { reach: 0.002 };
  const held = snap([3.3, 3.001], close);
  assert.equal(held.kind, "line");
  assert.equal(snap([2.006, 3.006], { ...close, held }).kind, "end");
  assert.equal(snap([2.008, 3.008], { ...close, held }).kind, null);
  assert.equal(snap([2.006, 3.006], { ...close, isFree: true }).kind, null);
});

test("a rectangle keeps the width of the aisle", () => {
  // A and B are 1.5 m apart.
  const drawn = snap([7.03, 6.98], { drawn: [[3, 8.2]], isBox: true });
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
  near(to(4.44, 6.97).at, [4.44, 7]);
  assert.deepEqual(
    to(4.44, 6.97).guides.map((one) => one.distance),
    [1.5, 1.5],
  );
  near(to(2.04, 6.2).at, [2, 6.2]);
  // In the middle between B and the wall, a single movement of a box between two rows.
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
  const shifts = fc.tuple(
    fc.double({ min: -21, max: -8, noNaN: true }),
    fc.double({ min: -21, max: -10, noNaN: true }),
  );
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
      { numRuns: 500 },
    );
  isRight(turn);
  rejects(() => isRight(0));
});

test("the work does not grow with the shop", () => {
  const corner = fc.double({ min: 0, max: 80, noNaN: true });
  const footing = fc.record({
    at: fc.tuple(corner, corner),
    rotation: fc.constantFrom(0, 90, 180, 270, 30),
    length: fc.double({ min: 0.5, max: 8, noNaN: true }),
    depth: fc.double({ min: 0.4, max: 1.2, noNaN: true }),
  });
  const fixtures = (count) =>
    fc.sample(footing, { numRuns: count, seed: 7 }).map((one, k) => part(`${k}`, "fixture", outlineOf(one)));
  const drawn = [
    [1, 1],
    [5, 1.2],
  ];
  const most = (parts) => {
    const snapper = new Snapper(segmentsOf(parts));
    let found = 0;
    for (const [k, pointer] of fc.sample(fc.tuple(corner, corner), { numRuns: 100, seed: 8 }).entries())
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
