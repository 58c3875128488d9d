// A small shop for tests of snapping.

import assert from "node:assert/strict";

import { outlineOf } from "../../../../src/page/planner/geometry/rigid";

export const reach = 0.1;
export const square = (x, y, width, height = width) => [
  [x, y],
  [x + width, y],
  [x + width, y + height],
  [x, y + height],
];
export const part = (key, kind, outline, more = {}) => ({ key, path: `/${key}`, kind, id: key, outline, ...more });
export const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);
export const isNear = (a, b, slack = 1e-6) => distance(a, b) <= slack;
export const near = (a, b, slack) => assert.ok(isNear(a, b, slack), `${a} is not ${b}`);
export const rejects = (check) => assert.throws(check, /Property failed/);

export const room = part("room", "room", square(0, 0, 12, 9));
/** Two rows with an aisle of 1.5 m, and a table that is turned. */
export const shop = [
  room,
  part("A", "fixture", square(2, 2, 6, 1)),
  part("B", "fixture", square(2, 4.5, 6, 1)),
  part("T", "fixture", outlineOf({ at: [9.5, 2], rotation: 30, length: 1.2, depth: 0.8 })),
];
