// What unit tests share.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";

import fc from "fast-check";

import { unitNamed } from "../../../../src/page/planner/geometry/units";

export { points, rectangle, square } from "../shapes.mjs";

// The same values in every run: a property that holds except for ties would fail now and then.
const drawn = { seed: 1 };
fc.configureGlobal(drawn);

/** The number of random or damaged inputs to try: `many` in the slow test, which sets MANY. */
export const times = (few, many) => (process.env.MANY ? many : few);
/** Of a time: a pause of the collector of garbage does not count. */
export const leastOfThree = (measure, ...of) => Math.min(measure(...of), measure(...of), measure(...of));
/** A negative control: a check of a property that does not hold. */
export function rejects(check) {
  fc.configureGlobal({ ...drawn, endOnFailure: true }); // nobody reads the counterexample
  try {
    assert.throws(check, /Property failed/);
  } finally {
    fc.configureGlobal(drawn);
  }
}

export const part = (key, kind, outline, more = {}) => ({ key, path: `/${key}`, kind, id: key, outline, ...more });
export const site = (json, unit = "m") => ({ json, unit: unitNamed(unit), taken: new Set() });

export const distance = (a, b) => Math.hypot(...a.map((value, k) => value - b[k]));
export const isNear = (found, expected, slack = 1e-6) =>
  found.length === expected.length && distance(found, expected) <= slack;
export const near = (found, expected, slack) =>
  assert.ok(isNear(found, expected, slack), `${found} instead of ${expected}`);

export const double = (min, max) => fc.double({ min, max, noNaN: true });
export const bytesOf = (text) => new TextEncoder().encode(text);
export const dataFile = (name) => readFileSync(`${process.env.EXAMPLES}/../test/data/${name}`);
