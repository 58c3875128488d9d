import assert from "node:assert/strict";
import { test } from "node:test";

import fc from "fast-check";

import { drawingOf } from "../../../../src/page/planner/backdrop/drawing";
import {
  angleBetween,
  boundsOfPicture,
  comparisonOf,
  cropBetween,
  isAskew,
  matrixOf,
  placementOf,
  replacedBy,
  shifted,
  straighteningOf,
  toPixel,
  toWorld,
  turnedTo,
  withScale,
} from "../../../../src/page/planner/backdrop/transform";
import { unitNamed } from "../../../../src/page/planner/geometry/units";
import { Viewport } from "../../../../src/page/planner/view/viewport";

const changes = { note: () => {} };
const metre = unitNamed("m");
const foot = unitNamed("ft");

const within = (min, max) => fc.double({ min, max, noNaN: true });
const pixels = fc.tuple(within(0, 2480), within(0, 1754));
const lines = fc
  .record({ from: pixels, to: pixels, length: within(0.5, 100) })
  .filter(({ from, to }) => Math.hypot(to[0] - from[0], to[1] - from[1]) > 20);
const drawings = fc.record(
  {
    file: fc.constant("plan.png"),
    size: fc.constant([2480, 1754]),
    at: fc.tuple(within(-50, 50), within(-50, 50)),
    scale: lines,
    check: lines,
    rotation_deg: within(-180, 180),
    crop: fc.constant([100, 200, 2000, 1500]),
  },
  { requiredKeys: ["file", "size", "at"] },
);
const units = fc.constantFrom(...["m", "cm", "mm", "ft", "in"].map(unitNamed));

const plan = (more = {}) => ({ file: "plan.png", size: [2000, 1000], at: [0, 0], ...more });
const lineOf = (x, y, u, v, length) => ({ from: [x, y], to: [u, v], length });
const worldOf = (drawing, pixel, unit = metre) => toWorld(placementOf(drawing, unit), pixel);

function near(found, expected, slack = 1e-6) {
  const isNear = found.every((value, k) => Math.abs(value - expected[k]) <= slack);
  assert.ok(isNear, `found ${found}, expected ${expected}`);
}

/** What rounding to a tenth of a millimetre moves, m. */
const rounding = 2e-4;

test("pixels and places are mapped both ways, and to the screen", () => {
  fc.assert(
    fc.property(drawings, pixels, units, (drawing, pixel, unit) => {
      const placement = placementOf(drawing, unit);
      const world = toWorld(placement, pixel);
      near(toPixel(placement, world), pixel, 1e-5);
      near(toWorld(placement, [0, 1754]), [drawing.at[0] * unit.factor, drawing.at[1] * unit.factor]);
      const viewport = new Viewport(changes);
      viewport.resize(700, 500);
      const [a, b, c, d, e, f] = matrixOf(placement, viewport);
      const [x, y] = pixel;
      near([a * x + c * y + e, b * x + d * y + f], viewport.toScreen(world), 1e-5);
    }),
  );
});

test("without a scale, the picture is 20 m wide", () => {
  near(worldOf(plan(), [2000, 0]), [20, 10]);
  near(worldOf(plan({ at: [10, 0] }), [2000, 0], foot), [23.048, 10]);
  near(worldOf(plan({ rotation_deg: 90 }), [2000, 1000]), [0, 20]);
});

test("the scale line has its length, and what must stay stays", () => {
  fc.assert(
    fc.property(drawings, lines, units, fc.boolean(), (drawing, line, unit, isStraight) => {
      for (const keeps of ["line", "corner"]) {
        const scaled = withScale(drawing, unit, { line, isStraight, keeps });
        const [from, to] = [line.from, line.to].map((pixel) => worldOf(scaled, pixel, unit));
        const way = [to[0] - from[0], to[1] - from[1]];
        near([Math.hypot(...way)], [line.length * unit.factor], 1e-6 * line.length);
        if (keeps === "line") near(from, worldOf(drawing, line.from, unit), rounding);
        else near(scaled.at, drawing.at, 0);
        if (isStraight) assert.ok(Math.min(...way.map(Math.abs)) <= 2e-6 * line.length);
      }
    }),
  );
});

test("a line becomes horizontal or vertical, whichever is nearer", () => {
  assert.equal(straighteningOf(plan(), lineOf(0, 0, 100, 0)), 0);
  assert.ok(Math.abs(straighteningOf(plan(), lineOf(0, 100, 100, 99)) + 0.5729) < 1e-4);
  assert.ok(Math.abs(straighteningOf(plan(), lineOf(50, 0, 51, 100)) - 0.5729) > 1, "not to the horizontal");
  assert.equal(straighteningOf(plan({ rotation_deg: 3 }), lineOf(100, 0, 0, 0)), -3);
  const line = (degrees) => lineOf(0, 0, Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180));
  assert.deepEqual(
    [0, 0.004, 1, -4.9, 5.1, 45, 86, 90, 179].map((degrees) => isAskew(plan(), line(degrees))),
    [false, false, true, true, false, false, true, false, true],
  );
});

test("a turn keeps the middle of what is shown, a shift everything else", () => {
  fc.assert(
    fc.property(drawings, units, within(-720, 720), within(-9, 9), (drawing, unit, degrees, way) => {
      const turned = turnedTo(drawing, unit, degrees);
      const [left, upper, right, lower] = drawing.crop ?? [0, 0, 2480, 1754];
      const middle = [0.5 * (left + right), 0.5 * (upper + lower)];
      near(worldOf(turned, middle, unit), worldOf(drawing, middle, unit), rounding);
      assert.ok(Math.abs(turned.rotation_deg ?? 0) <= 180);
      const moved = shifted(drawing, unit, [way, -way]);
      const [x, y] = worldOf(drawing, middle, unit);
      near(worldOf(moved, middle, unit), [x + way, y - way], rounding);
    }),
  );
});

test("another file takes the place of the picture", () => {
  fc.assert(
    fc.property(drawings, fc.integer({ min: 500, max: 9000 }), (drawing, width) => {
      const size = [width, Math.round((width * 1754) / 2480)];
      const replaced = replacedBy(drawing, { file: "new.png", size });
      const [before, after] = [drawing, replaced].map((one) => ({ ...one, crop: undefined }));
      // Heights are whole pixels, and so are crops.
      const slack = (placementOf(replaced, metre).step * 2480) / 500 + 0.02;
      const [old, now] = [before, after].map((one) => boundsOfPicture(one, metre));
      near([...now.lower, ...now.upper], [...old.lower, ...old.upper], slack);
      if (drawing.scale && drawing.check && comparisonOf(drawing)) {
        const [was, is] = [drawing, replaced].map((one) => comparisonOf(one)?.difference ?? 0);
        assert.ok(Math.abs(was - is) < 0.02 * (1 + Math.abs(was)), `${was} ${is}`);
      }
    }),
  );
  const taller = replacedBy(plan({ scale: lineOf(0, 1000, 500, 1000, 5), crop: [0, 500, 1000, 1000] }), {
    file: "tall.png",
    size: [1000, 800],
  });
  assert.deepEqual(taller.scale, lineOf(0, 800, 250, 800, 5), "the lower left corner stays");
  assert.deepEqual(taller.crop, [0, 550, 500, 800]);
});

test("a second length checks the scale", () => {
  const scale = lineOf(0, 0, 1000, 0, 10);
  const checked = (check) => comparisonOf(plan({ scale, check }));
  assert.equal(checked(undefined), null);
  assert.equal(checked(lineOf(0, 0, 1000, 300, 10)), null, "in the same direction");
  assert.equal(checked(lineOf(0, 0, 0, 500, 5)).agrees, true);
  const stretched = checked(lineOf(0, 500, 0, 0, 4.9));
  assert.ok(!stretched.agrees && Math.abs(stretched.difference - 0.020408) < 1e-5 && stretched.byScale === 5);
  assert.equal(checked(lineOf(0, 0, 0, 500, 5.04)).agrees, true);
  fc.assert(
    fc.property(lines, lines, (a, b) => {
      const angle = angleBetween(a, b);
      assert.ok(angle >= 0 && angle <= 90);
      assert.ok(Math.abs(angle - angleBetween({ from: b.to, to: b.from }, a)) < 1e-9);
    }),
  );
});

test("crops are whole pixels inside the picture", () => {
  assert.deepEqual(cropBetween(plan(), [1500.4, 900], [-20, 100.6]), [0, 101, 1500, 900]);
  assert.equal(cropBetween(plan(), [0, 0], [2000, 1000]), undefined);
  assert.equal(cropBetween(plan(), [-9, 0], [-3, 500]), undefined);
});

test("values that the store reader refuses count as missing", () => {
  assert.equal(drawingOf({}), null);
  assert.equal(drawingOf({ drawing: { file: "a.png", size: [0, 10] } }), null);
  const { at, scale, check, crop } = drawingOf({
    drawing: {
      file: "a.png",
      size: [10, 10],
      at: "here",
      scale: lineOf(1, 1, 1, 1, 5),
      check: lineOf(1, 1, 2, 1, -5),
      crop: [5, 0, 2, 9],
    },
  });
  assert.deepEqual([at, scale, check, crop], [[0, 0], undefined, undefined, undefined]);
});
