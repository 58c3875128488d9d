// Straight lines, half-lines and segments.

import type { Point } from "../document/messages";
import { cross, distance, dot, minus, plus, times } from "../geometry/vector";

/** The points at + t way, for t from `least` to `most`. */
export interface Line {
  at: Point;
  /** Of length 1. */
  way: Point;
  least: number;
  most: number;
}

/** m: what is nearer is the same place. */
export const tolerance = 1e-6;
/** Lines with a smaller sine of their angle cross nowhere: rounding would move the place. */
const leastSine = 1e-3;

export const lineAlong = (at: Point, way: Point, least = -Infinity, most = Infinity): Line => ({
  at,
  way,
  least,
  most,
});

export function lineOf(from: Point, to: Point): Line {
  const length = distance(from, to);
  return lineAlong(from, times(minus(to, from), 1 / length), 0, length);
}

const placeOn = ({ at, way }: Line, t: number): Point => plus(at, times(way, t));

export const normalOf = ([x, y]: Point): Point => [-y, x];

/** The point of a line that is nearest to a point. */
export function nearestOf(line: Line, point: Point): Point {
  const t = dot(minus(point, line.at), line.way);
  return placeOn(line, Math.min(Math.max(t, line.least), line.most));
}

export const passes = (line: Line, point: Point): boolean => distance(nearestOf(line, point), point) <= tolerance;

export const areParallel = (a: Point, b: Point): boolean => Math.abs(cross(a, b)) < leastSine;

export function crossingOf(a: Line, b: Line): Point | null {
  if (areParallel(a.way, b.way)) return null;
  const t = cross(minus(b.at, a.at), b.way) / cross(a.way, b.way);
  const at = placeOn(a, t);
  const u = dot(minus(at, b.at), b.way);
  const isOn = (line: Line, place: number) => place >= line.least - tolerance && place <= line.most + tolerance;
  return isOn(a, t) && isOn(b, u) ? at : null;
}
