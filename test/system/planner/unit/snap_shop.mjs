// A small shop for tests of snapping.

import { outlineOf } from "../../../../src/page/planner/geometry/rigid";
import { part, square } from "./support.mjs";

export const reach = 0.1;
export const room = part("room", "room", square(0, 0, 12, 9));
/** Two rows with an aisle of 1.5 m, and a table that is turned. */
export const shop = [
  room,
  part("A", "fixture", square(2, 2, 6, 1)),
  part("B", "fixture", square(2, 4.5, 6, 1)),
  part("T", "fixture", outlineOf({ at: [9.5, 2], rotation: 30, length: 1.2, depth: 0.8 })),
];
