import assert from "node:assert/strict";
import { test } from "node:test";

import fc from "fast-check";

import { numberFrom, numbersFrom, Unreadable } from "../../../../src/page/planner/form/parse";
import { parseLength, parseNumber } from "../../../../src/page/planner/geometry/lengths";
import { metre, unitNamed } from "../../../../src/page/planner/geometry/units";
import { double } from "./support.mjs";

const inMetres = (typed) => parseLength(typed, 1);

test("lengths as people type them", () => {
  const lengths = {
    1.33: 1.33,
    "1,33": 1.33,
    ".5": 0.5,
    "3*1.33": 3.99,
    "3 x 1.33": 3.99,
    "1.33*3": 3.99,
    "180cm": 1.8,
    "180 cm": 1.8,
    "45mm": 0.045,
    "6ft": 1.8288,
    "5'11\"": 1.8034,
    "5′ 11″": 1.8034,
    "2m + 40cm": 2.4,
    "2 m 40 cm": 2.4,
    "12/5": 2.4,
    "3m/2": 1.5,
    "(1+2)*2": 6,
    "-1.5": -1.5,
    "−1.5": -1.5,
    "4 - 40cm": 3.6,
    "12'-6\"": 3.81,
    "12' 6 1/2\"": 3.8227,
    '5 1/2"': 0.1397,
    "12ft - 30cm": 3.3576,
    "1.250": 1.25,
    "1,250": 1.25,
    "1 250 mm": 1.25,
    "1,200.5mm": 1.2005,
    "1e3": 1000,
  };
  for (const [typed, metres] of Object.entries(lengths))
    assert.ok(Math.abs(inMetres(typed) - metres) < 1e-9, `${typed}: ${inMetres(typed)}`);
});

test("numbers without a unit are in the unit of the file", () => {
  assert.equal(parseLength("1800", 0.001), 1800);
  assert.ok(Math.abs(parseLength("1.8m", 0.001) - 1800) < 1e-9);
  assert.ok(Math.abs(parseLength("1m + 200", 0.001) - 1200) < 1e-9);
  assert.ok(Math.abs(parseLength("6", 0.3048) - 6) < 1e-9);
});

test("other texts are no lengths", () => {
  const wrong = ["", "abc", "1..2", "3**2", "2m*2m", "1/0", "1/2m", "(1", "1)", "5 6", "6ft 3", "12'-6", "12' - 6\""];
  wrong.push("1,200mm", "1.200cm", '5-1/2" x', "1;2", "m", "--", "1e999");
  for (const typed of wrong) assert.equal(inMetres(typed), null, typed);
});

test("a number has no unit of length", () => {
  const numbers = { "45°": 45, "90 / 2": 45, "-30 deg": -30, "120%": null, "4°5": null, "2m": null };
  for (const [typed, number] of Object.entries(numbers)) assert.equal(parseNumber(typed), number, typed);
});

test("any number is read as it is written, and no text throws", () => {
  fc.assert(
    fc.property(double(-1e6, 1e6), (value) => {
      const rounded = Number(value.toFixed(4)) + 0;
      assert.ok(Math.abs(inMetres(rounded.toFixed(4)) - rounded) < 1e-9);
    }),
  );
  fc.assert(
    fc.property(fc.stringMatching(/^[0-9.,'"x*+/() mcftin-]{0,24}$/), (typed) => {
      const found = inMetres(typed);
      assert.ok(found === null || Number.isFinite(found));
    }),
  );
});

test("of two readings of a number, the limits decide", () => {
  const mm = unitNamed("mm");
  assert.throws(() => numberFrom("1,200", "length", mm), /1.2 mm or 1200 mm/);
  assert.equal(numberFrom("1,200", "length", mm, { least: 100, most: 1e5 }), 1200);
  assert.equal(numberFrom("1800", "length", mm), 1800, "as it is written");
  assert.equal(numberFrom("1.525", "none", metre, { least: 1, most: 4 }), 1.525);
  assert.throws(() => numberFrom("1.525", "none", metre), Unreadable);
  assert.equal(numberFrom("1.525", "degrees", metre, { least: -360, most: 360 }), 1.525);
});

test("lists with decimal commas are read, or refused", () => {
  const list = (typed, size) => numbersFrom(typed, "length", metre, size);
  for (const typed of [
    "0,3; 0,7; 1,1",
    "0.3, 0.7, 1.1",
    "0.3 0.7 1.1",
    "0.3,0.7,1.1",
    "30 cm; 70cm; 110cm",
    "30 cm, 70cm, 110cm",
  ])
    assert.deepEqual(list(typed), [0.3, 0.7, 1.1], typed);
  assert.deepEqual(list("1,2", 2), [1, 2], "the coordinates of a point");
  assert.deepEqual(list("1.5,2", 2), [1.5, 2]);
  assert.deepEqual(list(""), []);
  assert.deepEqual(list("1,2,3"), [1, 2, 3]);
  assert.deepEqual(numbersFrom("11.811, 35.433", "length", unitNamed("in")), [11.811, 35.433]);
  for (const typed of ["0,3 0,7", "0,3, 0,7", "1,2", "0,3,0,7", "a; b", "1;;2", ";", "2 400 3 000"])
    assert.throws(() => list(typed), Unreadable, typed);
  assert.throws(() => list("0,3 0,7", 3), Unreadable);
});
