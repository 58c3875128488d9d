// The place on an outline that a point near it means: a corner, the foot of a perpendicular, or a place on an edge.

import type { Part, Point } from "../document/messages";
import { isWithin } from "./bounds";
import { edgesOf, nearestOn } from "./polygon";
import { distance, dot, minus } from "./vector";

export interface Attached {
  at: Point;
  /** What it is attached to; null: nothing is near. */
  to: "corner" | "perpendicular" | "edge" | null;
}

/** `from`: the beginning of the line that ends here. `reach`: m. */
export function attach(parts: readonly Part[], point: Point, from: Point | null, reach: number): Attached {
  let edge: Attached = { at: point, to: null };
  let [corner, foot] = [null as Attached | null, null as Attached | null];
  const isNearer = (candidate: Point, than: Attached | null) =>
    distance(candidate, point) <= Math.min(reach, than?.to ? distance(than.at, point) : Infinity);
  for (const part of parts)
    for (const outline of [part.outline, ...(part.holes ?? [])])
      for (const [a, b] of edgesOf(outline, part.kind === "rail")) {
        const around = {
          lower: [Math.min(a[0], b[0]), Math.min(a[1], b[1])] as Point,
          upper: [Math.max(a[0], b[0]), Math.max(a[1], b[1])] as Point,
        };
        if (!isWithin(point, around, reach)) continue;
        for (const end of [a, b]) if (isNearer(end, corner)) corner = { at: end, to: "corner" };
        const near = nearestOn(a, b, point);
        if (isNearer(near, edge)) edge = { at: near, to: "edge" };
        if (!from) continue;
        const below = nearestOn(a, b, from);
        const isSquare = Math.abs(dot(minus(below, from), minus(b, a))) < 1e-9;
        if (isSquare && isNearer(below, foot)) foot = { at: below, to: "perpendicular" };
      }
  return corner ?? foot ?? edge;
}
