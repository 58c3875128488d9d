// Outlines: what is inside, what is near, what crosses a rectangle.

import type { Point } from "../document/messages";
import type { Bounds } from "./bounds";
import { isWithin, rectangle } from "./bounds";
import { between, cross, distance, dot, minus } from "./vector";

/** By the even-odd rule. */
export function contains(outline: readonly Point[], [x, y]: Point): boolean {
  let inside = false;
  for (let k = 0, last = outline.length - 1; k < outline.length; last = k++) {
    const [a, b] = [outline[k], outline[last]];
    if (a[1] > y !== b[1] > y && x < ((b[0] - a[0]) * (y - a[1])) / (b[1] - a[1]) + a[0]) inside = !inside;
  }
  return inside;
}

/** The point of a segment that is nearest to a point. */
export function nearestOn(a: Point, b: Point, point: Point): Point {
  const way = minus(b, a);
  const square = dot(way, way);
  const share = square > 0 ? Math.min(Math.max(dot(minus(point, a), way) / square, 0), 1) : 0;
  return between(a, b, share);
}

/** The edges of an outline; an open line has no edge from its end to its beginning. */
export function edgesOf(outline: readonly Point[], isOpen = false): [Point, Point][] {
  const edges = outline.map((point, k): [Point, Point] => [point, outline[(k + 1) % outline.length]]);
  return isOpen || outline.length < 3 ? edges.slice(0, -1) : edges;
}

export function distanceTo(outline: readonly Point[], point: Point, isOpen = false): number {
  if (outline.length === 1) return distance(outline[0], point);
  return Math.min(...edgesOf(outline, isOpen).map(([a, b]) => distance(nearestOn(a, b, point), point)));
}

/** Above 0 if the corners run counter-clockwise, m². */
export const signedArea = (corners: readonly Point[]): number =>
  0.5 * edgesOf(corners).reduce((sum, [a, b]) => sum + cross(a, b), 0);

export const area = (corners: readonly Point[]): number => Math.abs(signedArea(corners));

function crosses([a, b]: [Point, Point], [c, d]: [Point, Point]): boolean {
  const side = (p: Point, q: Point, r: Point) => cross(minus(q, p), minus(r, p));
  return side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0;
}

export const isInside = (outline: readonly Point[], bounds: Bounds): boolean =>
  outline.every((point) => isWithin(point, bounds));

/** Whether an outline and a rectangle have a point in common. */
export function touches(outline: readonly Point[], bounds: Bounds, isOpen = false): boolean {
  if (outline.some((point) => isWithin(point, bounds))) return true;
  const sides = edgesOf(rectangle(bounds));
  if (edgesOf(outline, isOpen).some((edge) => sides.some((side) => crosses(edge, side)))) return true;
  return !isOpen && contains(outline, bounds.lower);
}
