// Equal gaps: a rectangle as far from its neighbour as this one is from the next, or in the middle between two.

import type { Point } from "../document/messages";
import { boundsOf, middleOf, type Bounds } from "../geometry/bounds";
import { movedVector, rest } from "../geometry/rigid";
import { unitAt } from "../geometry/vector";
import type { Guide, Pull } from "./choice";
import { lineAlong } from "./lines";
import type { SegmentIndex } from "./segment_index";

/** Places in the frame of the room, and back. */
export const intoFrame = (point: Point, frame: number): Point => movedVector(point, { ...rest, turn: -frame });
export const outOfFrame = (point: Point, frame: number): Point => movedVector(point, { ...rest, turn: frame });

export interface Gap {
  /** How far the rectangle, or its side, moves along the axis. */
  shift: number;
  /** The gaps between which it is the same, along the axis; the first begins or ends at the rectangle. */
  spans: [number, number][];
  /** Where on the other axis. */
  level: number;
}

/** m: bodies with smaller gaps touch, and smaller overlaps are none. */
const leastGap = 0.05;

const mostBodies = 64;
const aisles = 20; // m: bodies that are farther apart have no aisle between them

export const bodiesAround = (index: SegmentIndex, place: Point, frame: number): Bounds[] =>
  index
    .bodiesNear(place, aisles, mostBodies)
    .map((corners) => boundsOf(corners.map((corner) => intoFrame(corner, frame))) as Bounds);

/** The other way round along an axis, so that what holds above holds below. */
function flipped({ lower, upper }: Bounds, axis: 0 | 1): Bounds {
  const put = (point: Point, value: number): Point => (axis === 0 ? [value, point[1]] : [point[0], value]);
  return { lower: put(lower, -upper[axis]), upper: put(upper, -lower[axis]) };
}

/** Where both run on the other axis; null: nowhere together. */
function common(a: Bounds, b: Bounds, other: 0 | 1): [number, number] | null {
  const [low, high] = [Math.max(a.lower[other], b.lower[other]), Math.min(a.upper[other], b.upper[other])];
  return high - low > leastGap ? [low, high] : null;
}

/** The nearest body above a rectangle. */
function next(bodies: readonly Bounds[], of: Bounds, axis: 0 | 1): Bounds | null {
  const other = axis === 0 ? 1 : 0;
  return bodies
    .filter((body) => body.lower[axis] >= of.upper[axis] - leastGap && common(body, of, other))
    .reduce<Bounds | null>((best, body) => (!best || body.lower[axis] < best.lower[axis] ? body : best), null);
}

function gapAbove(bodies: readonly Bounds[], box: Bounds, axis: 0 | 1): Gap | null {
  const other = axis === 0 ? 1 : 0;
  const neighbour = next(bodies, box, axis);
  const beyond = neighbour && next(bodies, neighbour, axis);
  const level = neighbour && common(neighbour, box, other);
  if (!neighbour || !beyond || !level) return null;
  const gap = beyond.lower[axis] - neighbour.upper[axis];
  if (gap < leastGap) return null;
  return {
    shift: neighbour.lower[axis] - gap - box.upper[axis],
    spans: [
      [neighbour.lower[axis] - gap, neighbour.lower[axis]],
      [neighbour.upper[axis], beyond.lower[axis]],
    ],
    level: 0.5 * (level[0] + level[1]),
  };
}

function gapBelow(bodies: readonly Bounds[], box: Bounds, axis: 0 | 1): Gap | null {
  const turned = bodies.map((body) => flipped(body, axis));
  const gap = gapAbove(turned, flipped(box, axis), axis);
  return gap && { ...gap, shift: 0 - gap.shift, spans: gap.spans.map(([low, high]) => [-high, -low]) };
}

function gapBetween(bodies: readonly Bounds[], box: Bounds, axis: 0 | 1): Gap | null {
  const other = axis === 0 ? 1 : 0;
  const above = next(bodies, box, axis);
  const under = next(
    bodies.map((body) => flipped(body, axis)),
    flipped(box, axis),
    axis,
  );
  const below = under && flipped(under, axis);
  const level = above && common(above, box, other);
  if (!above || !below || !level) return null;
  const middle = 0.5 * (above.lower[axis] + below.upper[axis]);
  const half = 0.5 * (box.upper[axis] - box.lower[axis]);
  if (above.lower[axis] - middle - half < leastGap) return null;
  return {
    shift: middle - middleOf(box)[axis],
    spans: [
      [below.upper[axis], middle - half],
      [middle + half, above.lower[axis]],
    ],
    level: 0.5 * (level[0] + level[1]),
  };
}

/** The equal gaps of a rectangle that moves as a whole, or of one side of it. All are in the frame. */
export function gapsOf(bodies: readonly Bounds[], box: Bounds, axis: 0 | 1, side?: "lower" | "upper"): Gap[] {
  const found = [
    side === "lower" ? null : gapAbove(bodies, box, axis),
    side === "upper" ? null : gapBelow(bodies, box, axis),
    side === undefined ? gapBetween(bodies, box, axis) : null,
  ];
  return found.filter((gap) => gap !== null);
}

export function gapGuides({ spans, level }: Gap, axis: 0 | 1, frame: number): Guide[] {
  const at = (along: number) => outOfFrame(axis === 0 ? [along, level] : [level, along], frame);
  return spans.map(([low, high]) => ({ from: at(low), to: at(high), kind: "gap", distance: high - low }));
}

/** Lines for the corner of a rectangle that make its gap equal to the next one. */
export function gapPulls(index: SegmentIndex, from: Point, to: Point, frame: number, reach: number): Pull[] {
  const [a, b] = [intoFrame(from, frame), intoFrame(to, frame)];
  const box = boundsOf([a, b]) as Bounds;
  const bodies = bodiesAround(index, to, frame);
  return ([0, 1] as const).flatMap((axis) =>
    gapsOf(bodies, box, axis, b[axis] < a[axis] ? "lower" : "upper").map((gap): Pull => {
      const at: Point = axis === 0 ? [b[0] + gap.shift, b[1]] : [b[0], b[1] + gap.shift];
      return {
        line: lineAlong(outOfFrame(at, frame), unitAt(frame + (axis === 0 ? 90 : 0))),
        kind: "gap",
        reach,
        guides: () => gapGuides(gap, axis, frame),
      };
    }),
  );
}

/** The aisles on both long sides of a fixture, to its neighbours there. `direction`: of the fixture, degrees. */
export function aisleGuides(index: SegmentIndex, outline: readonly Point[], direction: number): Guide[] {
  const box = boundsOf(outline.map((corner) => intoFrame(corner, direction))) as Bounds;
  const bodies = bodiesAround(index, outOfFrame(middleOf(box), direction), direction);
  const side = (all: readonly Bounds[], of: Bounds) => {
    const neighbour = next(all, of, 1);
    const level = neighbour && common(neighbour, of, 0);
    return neighbour && level ? { to: neighbour.lower[1], at: 0.5 * (level[0] + level[1]) } : null;
  };
  const turned = bodies.map((body) => flipped(body, 1));
  const [above, below] = [side(bodies, box), side(turned, flipped(box, 1))];
  const guide = (at: number, from: number, to: number): Guide[] => {
    const [a, b] = [from, to].map((level) => outOfFrame([at, level], direction));
    return Math.abs(to - from) < leastGap ? [] : [{ from: a, to: b, kind: "gap", distance: Math.abs(to - from) }];
  };
  return [
    ...(above ? guide(above.at, box.upper[1], above.to) : []),
    ...(below ? guide(below.at, box.lower[1], -below.to) : []),
  ];
}
