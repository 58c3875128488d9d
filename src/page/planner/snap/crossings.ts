// Edges that cross in a drawing in progress.

import type { Point } from "../document/messages";
import { edgesOf, nearestOn } from "../geometry/polygon";
import { cross, distance, minus } from "../geometry/vector";
import { tolerance } from "./lines";

/** Edge k begins at corner k. */
export type EdgePair = [number, number];

type Edge = [Point, Point];

const side = ([a, b]: Edge, point: Point): number => Math.sign(cross(minus(b, a), minus(point, a)));

const isOn = ([a, b]: Edge, point: Point): boolean => distance(nearestOn(a, b, point), point) <= tolerance;

const touch = (a: Edge, b: Edge): boolean => b.some((end) => isOn(a, end)) || a.some((end) => isOn(b, end));

const cut = (a: Edge, b: Edge): boolean => side(a, b[0]) * side(a, b[1]) < 0 && side(b, a[0]) * side(b, a[1]) < 0;

/** Neighbours have a corner in common; they overlap if one turns back over the other. */
const foldsBack = ([from, corner]: Edge, [, to]: Edge): boolean => isOn([from, corner], to) || isOn([corner, to], from);

/**
 * The pairs of edges that cross or touch, other than neighbours at their corner: of a line with a new corner at its end,
 * or of a polygon.
 */
export function selfCrossings(corners: readonly Point[], isClosed: boolean): EdgePair[] {
  const edges = edgesOf(corners, !isClosed);
  const { length } = edges;
  const found: EdgePair[] = [];
  for (let j = 1; j < length; ++j)
    for (let i = 0; i < j; ++i) {
      const [first, last] = [edges[i], edges[j]];
      const isBefore = j === i + 1;
      const isAround = isClosed && length > 2 && i === 0 && j === length - 1;
      const isWrong = isBefore
        ? foldsBack(first, last)
        : isAround
          ? foldsBack(last, first)
          : cut(first, last) || touch(first, last);
      if (isWrong) found.push([i, j]);
    }
  return found;
}
