// Rectangles parallel to the axes of the plan.

import type { Part, Point } from "../document/messages";

export interface Bounds {
  lower: Point;
  upper: Point;
}

/** Null without points. */
export function boundsOf(points: Iterable<Point>): Bounds | null {
  const lower: Point = [Infinity, Infinity];
  const upper: Point = [-Infinity, -Infinity];
  for (const point of points)
    for (const axis of [0, 1]) {
      lower[axis] = Math.min(lower[axis], point[axis]);
      upper[axis] = Math.max(upper[axis], point[axis]);
    }
  return lower[0] <= upper[0] ? { lower, upper } : null;
}

/** From corner to corner. */
export const boundsBetween = ({ from, to }: { from: Point; to: Point }): Bounds => ({
  lower: [Math.min(from[0], to[0]), Math.min(from[1], to[1])],
  upper: [Math.max(from[0], to[0]), Math.max(from[1], to[1])],
});

export const boundsOfParts = (parts: readonly Part[]): Bounds | null =>
  boundsOf(parts.flatMap(({ outline }) => outline));

export const middleOf = ({ lower, upper }: Bounds): Point => [0.5 * (lower[0] + upper[0]), 0.5 * (lower[1] + upper[1])];

export const joined = (all: readonly (Bounds | null)[]): Bounds | null =>
  boundsOf(all.flatMap((bounds) => (bounds ? [bounds.lower, bounds.upper] : [])));

export const isWithin = ([x, y]: Point, { lower, upper }: Bounds, margin = 0): boolean =>
  x >= lower[0] - margin && x <= upper[0] + margin && y >= lower[1] - margin && y <= upper[1] + margin;

export const rectangle = ({ lower: [x, y], upper: [u, v] }: Bounds): Point[] => [
  [x, y],
  [u, y],
  [u, v],
  [x, v],
];
