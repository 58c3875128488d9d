// Snapping of an outline that moves: its corners and sides hold on to its neighbours.

import type { Point } from "../document/messages";
import { boundsOf, middleOf, rectangle, type Bounds } from "../geometry/bounds";
import { nearestOn } from "../geometry/polygon";
import { distance, minus, plus } from "../geometry/vector";
import { faintReach, joining, type Guide, type SnapKind } from "./choice";
import { bodiesAround, gapGuides, gapsOf, intoFrame, outOfFrame } from "./gaps";
import { tolerance } from "./lines";
import type { Segment } from "./segments";
import type { Snapper } from "./snap";

export interface MoveRequest {
  /** m on the plan of the pixels from which places attract. */
  reach: number;
  /** The main direction of the room, degrees. */
  frame?: number;
  isFree?: boolean;
  /** The only axis of the frame along which it moves. */
  axis?: 0 | 1;
}

export interface Moved {
  shift: Point;
  guides: Guide[];
}

const most = { near: 256, wide: 128, corners: 32 };
const wide = 10; // times the reach
const leastOverlap = 0.01; // m of sides that lie on each other

/** A movement along one axis of the frame. `guides`: of the bounds after it. */
interface Step {
  kind: SnapKind;
  way: number;
  guides: (after: Bounds) => Guide[];
}

/** The least movement within a reach; null: none. */
function least<Value>(all: readonly Value[], size: (value: Value) => number, reach: number): Value | null {
  let [found, smallest] = [null as Value | null, reach];
  for (const value of all)
    if (size(value) <= smallest && (found === null || size(value) < smallest)) [found, smallest] = [value, size(value)];
  return found;
}

interface Neighbours {
  near: Segment[];
  wide: Segment[];
  bodies: Bounds[];
  /** Those of them that are near enough to be in line with. */
  beside: Bounds[];
}

const turned = ({ from, to }: Segment, frame: number): Segment => ({
  from: intoFrame(from, frame),
  to: intoFrame(to, frame),
});

const isBeside = (a: Bounds, b: Bounds, margin: number): boolean =>
  [0, 1].every((k) => a.lower[k] <= b.upper[k] + margin && a.upper[k] >= b.lower[k] - margin);

function neighboursOf({ index }: Snapper, box: Bounds, { reach, frame = 0 }: MoveRequest): Neighbours {
  const out = (point: Point) => outOfFrame(point, frame);
  const { lower, upper } = boundsOf(rectangle(box).map(out)) as Bounds;
  const margin = Math.max(reach, joining);
  const area = { lower: minus(lower, [margin, margin]), upper: plus(upper, [margin, margin]) };
  const middle = out(middleOf(box));
  const around = 0.5 * distance(box.lower, box.upper) + wide * reach;
  const inFrame = (segments: Segment[]) => segments.map((one) => turned(one, frame));
  const bodies = bodiesAround(index, middle, frame);
  return {
    near: inFrame(index.within(area, most.near)),
    wide: inFrame(index.near(middle, around, most.wide)),
    bodies,
    beside: bodies.filter((body) => isBeside(body, box, wide * reach)),
  };
}

/** Whether a segment is at right angles to an axis. */
const isAcross = ({ from, to }: Segment, axis: number): boolean => Math.abs(to[axis] - from[axis]) <= tolerance;

/** A corner on an end. */
function joins(corners: readonly Point[], { near }: Neighbours, reach: number): Point | null {
  const ways = corners.flatMap((corner) => near.flatMap(({ from, to }) => [minus(from, corner), minus(to, corner)]));
  return least(ways, (way) => Math.hypot(...way), Math.max(reach, joining));
}

/** A corner on a slanted line. */
function leans(corners: readonly Point[], { near }: Neighbours, reach: number): Point | null {
  const slanted = near.filter((one) => !isAcross(one, 0) && !isAcross(one, 1));
  const ways = corners.flatMap((corner) => slanted.map(({ from, to }) => minus(nearestOn(from, to, corner), corner)));
  return least(ways, (way) => Math.hypot(...way), reach);
}

/** A side on a line. */
function contacts({ near }: Neighbours, box: Bounds, axis: 0 | 1): Step[] {
  const other = 1 - axis;
  return near
    .filter((one) => isAcross(one, axis))
    .flatMap(({ from, to }): Step[] => {
      const low = Math.max(Math.min(from[other], to[other]), box.lower[other]);
      const high = Math.min(Math.max(from[other], to[other]), box.upper[other]);
      if (high - low < leastOverlap) return [];
      const guides = (after: Bounds): Guide[] => {
        const ends = [from, to].map((end) => Math.min(Math.max(end[other], after.lower[other]), after.upper[other]));
        const [a, b] = ends.map((value): Point => (axis === 0 ? [from[0], value] : [value, from[1]]));
        return [{ from: a, to: b, kind: "line" }];
      };
      return [box.lower[axis], box.upper[axis]].map((side) => ({ kind: "line", way: from[axis] - side, guides }));
    });
}

/** A side or the middle in line with that of a neighbour. */
function alignments({ wide: segments, beside }: Neighbours, box: Bounds, axis: 0 | 1): Step[] {
  const other = 1 - axis;
  const guides = (at: Point) => (after: Bounds) => {
    const to: Point = [...at];
    to[other] = at[other] < after.lower[other] ? after.lower[other] : Math.min(at[other], after.upper[other]);
    const away = distance(at, to);
    return away > tolerance ? [{ from: at, to, kind: "align" as const, distance: away }] : [];
  };
  const step = (at: Point, side: number): Step => ({ kind: "align", way: at[axis] - side, guides: guides(at) });
  return [
    ...segments
      .flatMap(({ from, to }) => [from, to])
      .flatMap((end) => [step(end, box.lower[axis]), step(end, box.upper[axis])]),
    ...beside.map((body) => step(middleOf(body), middleOf(box)[axis])),
  ];
}

function stepAlong(neighbours: Neighbours, box: Bounds, axis: 0 | 1, reach: number): Step | null {
  const size = ({ way }: Step) => Math.abs(way);
  const gaps = gapsOf(neighbours.bodies, box, axis).map(
    (gap): Step => ({ kind: "gap", way: gap.shift, guides: () => gapGuides(gap, axis, 0) }),
  );
  return (
    least(contacts(neighbours, box, axis), size, reach) ??
    least(gaps, size, reach) ??
    least(alignments(neighbours, box, axis), size, faintReach(reach))
  );
}

const shifted = ({ lower, upper }: Bounds, way: Point): Bounds => ({
  lower: plus(lower, way),
  upper: plus(upper, way),
});

const placed = (guide: Guide, frame: number): Guide => ({
  ...guide,
  from: outOfFrame(guide.from, frame),
  to: outOfFrame(guide.to, frame),
});

/** The movement that is meant by `shift` of an outline. */
export function snapMove(snapper: Snapper, outline: readonly Point[], shift: Point, request: MoveRequest): Moved {
  const { reach, frame = 0, isFree, axis } = request;
  snapper.index.examined = 0;
  const corners = outline.map((corner) => intoFrame(plus(corner, shift), frame));
  const box = boundsOf(corners);
  if (isFree || !box) return { shift, guides: [] };
  const neighbours = neighboursOf(snapper, box, request);
  const few = corners.length > most.corners ? rectangle(box) : corners;
  const by = (way: Point) => plus(shift, outOfFrame(way, frame));

  const join = axis === undefined ? joins(few, neighbours, reach) : null;
  if (join) {
    const ends = few
      .map((corner) => plus(corner, join))
      .filter((corner) => neighbours.near.some((one) => isEnd(one, corner)));
    return { shift: by(join), guides: ends.map((end) => placed({ from: end, to: end, kind: "end" }, frame)) };
  }
  const steps = ([0, 1] as const).map((k) =>
    axis === undefined || axis === k ? stepAlong(neighbours, box, k, reach) : null,
  );
  const lean =
    axis === undefined && !steps.some((step) => step?.kind === "line") ? leans(few, neighbours, reach) : null;
  if (lean) return { shift: by(lean), guides: [] };
  const way: Point = [steps[0]?.way ?? 0, steps[1]?.way ?? 0];
  const after = shifted(box, way);
  return {
    shift: by(way),
    guides: steps.flatMap((step) => step?.guides(after) ?? []).map((one) => placed(one, frame)),
  };
}

const isEnd = ({ from, to }: Segment, corner: Point): boolean =>
  distance(from, corner) <= tolerance || distance(to, corner) <= tolerance;
