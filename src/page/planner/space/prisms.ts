// The fixture or wall that a ray hits first, as prisms over the outlines.

import type { Part, Point } from "../document/messages";
import { contains, edgesOf } from "../geometry/polygon";
import { cross, minus } from "../geometry/vector";
import type { Layers } from "../view/layers";

export interface Ray {
  from: number[];
  way: number[];
}

/** The distance along the ray to a prism from the floor to its height; infinite without a hit. */
export function distanceTo({ outline, height = 0 }: Part, { from, way }: Ray): number {
  let nearest = Infinity;
  const at = (t: number): Point => [from[0] + t * way[0], from[1] + t * way[1]];
  if (Math.abs(way[2]) > 1e-9) {
    const t = (height - from[2]) / way[2];
    if (t > 0 && contains(outline, at(t))) nearest = t;
  }
  for (const [a, b] of edgesOf(outline)) {
    const side = minus(b, a);
    const square = cross([way[0], way[1]], side);
    if (Math.abs(square) < 1e-12) continue;
    const arm = minus(a, [from[0], from[1]]);
    const t = cross(arm, side) / square;
    const share = cross(arm, [way[0], way[1]]) / square;
    const z = from[2] + t * way[2];
    if (t > 0 && t < nearest && share >= 0 && share <= 1 && z >= 0 && z <= height) nearest = t;
  }
  return nearest;
}

export function prismAt(parts: readonly Part[], ray: Ray, layers: Layers): Part | null {
  let [found, least] = [null as Part | null, Infinity];
  for (const part of parts) {
    if ((part.kind !== "fixture" && part.kind !== "wall") || !layers.isFree(part.kind)) continue;
    const away = distanceTo(part, ray);
    if (away < least) [found, least] = [part, away];
  }
  return found;
}
