import assert from "node:assert/strict";
import { test } from "node:test";

import fc from "fast-check";

import { moved, movedPart, movedVector, turnAbout } from "../../../../src/page/planner/geometry/rigid";
import { mainDirection, segmentsOf } from "../../../../src/page/planner/snap/segments";
import { Snapper } from "../../../../src/page/planner/snap/snap";
import { reach, room, shop } from "./snap_shop.mjs";
import { distance, double, near, part, points, rejects, square, times } from "./support.mjs";

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
  assert.deepEqual(of([8.8, 3.03]), ["extension", 8.8, 3]);
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

test("what is remote attracts from near only, also where a pixel is many centimetres", () => {
  const far = { reach: 0.4 };
  const isFree = (pointer, more) => assert.equal(snap(pointer, { ...far, ...more }).kind, null, `${pointer}`);
  assert.equal(snap([8.7, 3.05], far).kind, "extension"); // of a row that ends at 8
  isFree([8.7, 3.12]);
  isFree([9.62, 1.2]); // 12 cm beside a corner of the table
  isFree([4.44, 7.12], { drawn: [[3, 8]], isBox: true }); // 12 cm beside an equal aisle
  near(snap([8.25, 3.25], far).at, [8, 3]);
  near(snap([5.7, 3.3], far).at, [5.7, 3]);
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
  const begin = [3.3 - edge[0], 6.65 - edge[1]];
  const [x, y] = along([5, 7.9], [begin, [3.3, 6.65]]).at;
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
  .record({ all: segments, drawn: drawing, away: offGrid, share: double(0, 1) })
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
/** 2 cm from the pointer: one place of each kind. */
const ranked = (snapOf) =>
  fc.assert(
    fc.property(fc.integer({ min: 0, max: 359 }), fc.shuffledSubarray(rank, { minLength: 1 }), (turn, kinds) => {
      const turned = (text) => points(text).map((point) => moved(point, turnAbout(turn, [1, 2])));
      const pair = (ends) => ({ from: turned(ends)[0], to: turned(ends)[1] });
      const lines = {
        end: ["0.02,0 3,1.7"],
        crossing: ["-2,-0.02 2.7,-0.02", "-0.9,-0.92 0.6,0.58"],
        middle: ["-3.1,-0.88 3.1,0.92"],
        line: ["-0.02,-1.3 -0.02,2.1"],
        extension: ["-0.02,0.9 -0.02,2.1"],
      };
      fc.pre(!(kinds.includes("line") && kinds.includes("extension")));
      const all = kinds.flatMap((kind) => lines[kind].map(pair));
      const best = rank.find((kind) => kinds.includes(kind));
      const { kind } = snapOf(all, { pointer: turned("0,0")[0], reach: 0.06, frame: 0 });
      // Two lines that happen to cross in reach come before all but ends.
      assert.ok(kind === best || (kind === "crossing" && best !== "end" && kinds.length > 1), `${kind}, not ${best}`);
    }),
  );

test("at the same distance the rank decides", () => {
  ranked(usual);
  rejects(() => ranked((all, request) => ({ ...usual(all, request), kind: "line" })));
});

test("snapping a snapped place again changes nothing", () => {
  fc.assert(
    fc.property(scene, fc.boolean(), ({ all, request }, isOrtho) => {
      const once = usual(all, { ...request, isOrtho });
      const again = usual(all, { ...request, isOrtho, pointer: once.at, held: once.kind ? once : undefined });
      near(again.at, once.at, 2e-6);
      assert.equal(again.kind, once.kind);
    }),
  );
  // Without the memory, a place on a line jumps to an end near it.
  const once = snap([2.09, 3.06]);
  const again = [{ held: once }, {}].map((more) => snap(once.at, more).kind);
  assert.deepEqual([once.kind, ...again], ["line", "line", "end"]);
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
    fc.property(double(0, 1.95), fc.integer({ min: 0, max: 359 }), (share, direction) => {
      const drawn = points("0,0 4,0.3 4.2,3");
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
      double(0.01, 50),
      fc.option(double(-360, 360), { nil: undefined }),
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

/** The numbers of changes of the kind while the pointer trembles by a pixel along a way. */
function changes(from, to, isHeld) {
  const steps = times(100, 400);
  let most = 0;
  let held;
  for (let k = 0; k <= steps; ++k) {
    const at = (share) => from.map((value, axis) => value + share * (to[axis] - value));
    const pixel = reach / 10 / distance(from, to);
    const kinds = [0, pixel, 0, pixel, 0].map((offset) => {
      const result = snap(at(k / steps + offset), { held: isHeld ? held : undefined });
      held = result;
      return result.kind;
    });
    const count = kinds.slice(2).filter((kind, j) => kind !== kinds[j + 1]).length;
    most = Math.max(most, count);
  }
  return most;
}

test("marks do not flicker at the ends of reaches", () => {
  const ways = ["3.3,3.4 3.4,2.9", "2.6,3.05 1.8,3.04", "4.2,3.02 5.6,3.05", "2.4,2.6 1.7,1.7", "9,1.7 10.9,3.6"].map(
    points,
  );
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

test("an edge at right angles is as long as one of the last", () => {
  const snapper = new Snapper([]);
  const drawn = points("0,0 3,0 3,2");
  const request = { reach, drawn };
  const found = snapper.snap({ ...request, pointer: [0.05, 2.95 - 1] });
  near(found.at, [0, 2]);
  assert.equal(snapper.snap({ ...request, pointer: [1.03, 2.02] }).kind, "length");
  near(snapper.snap({ ...request, pointer: [1.03, 2.02] }).at, [1, 2]);
  const turned = snapper.snap({ ...request, pointer: [4.46, 3.42], isOrtho: true });
  assert.equal(turned.kind, "length");
  near(turned.at, [3 + Math.SQRT2, 2 + Math.SQRT2]);
  assert.notEqual(snapper.snap({ ...request, pointer: [1.4, 2.03] }).kind, "length");
});
