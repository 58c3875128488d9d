// Snapping: the place that the pointer means.

import type { Point } from "../document/messages";
import { directionOf, distance, minus, plus, times, unitAt } from "../geometry/vector";
import { candidatesAlong, candidatesOf } from "./candidates";
import { choose, type Snapped } from "./choice";
import { nearestOf, tolerance, type Line } from "./lines";
import { surroundingsOf } from "./pulls";
import { fromOf, rayOf, type SnapRequest } from "./request";
import { SegmentIndex, type LineSource } from "./segment_index";
import type { Segment } from "./segments";

export class Snapper {
  readonly index: SegmentIndex;

  constructor(segments: readonly Segment[], beneath: LineSource | null = null) {
    this.index = new SegmentIndex(segments, beneath);
  }

  /** What is typed comes before Shift, and both before what attracts. */
  snap(request: SnapRequest): Snapped {
    this.index.examined = 0;
    const { pointer, length, isFree } = request;
    const ray = rayOf(request);
    const from = fromOf(request);
    if (length !== undefined && from) {
      const way =
        ray?.way ??
        (isFree
          ? wayTo(from, pointer, request)
          : straightened(wayTo(from, this.attracted(request).at, request), request));
      return free(plus(from, times(way, length)));
    }
    if (ray) return this.along(ray, request);
    return isFree ? free(pointer) : this.attracted(request);
  }

  private attracted(request: SnapRequest): Snapped {
    const { pointer, reach, held } = request;
    const candidates = candidatesOf(surroundingsOf(this.index, request, pointer), request);
    return snapped(choose(candidates, pointer, reach, held), pointer);
  }

  private along(ray: Line, request: SnapRequest): Snapped {
    const { pointer, reach, held, isFree } = request;
    const place = nearestOf(ray, pointer);
    const around = isFree ? nothing : surroundingsOf(this.index, request, place);
    return snapped(choose(candidatesAlong(ray, place, around, request), place, reach, held), place);
  }
}

const nothing = { near: [], lines: [], inferred: [] };

const free = (at: Point): Snapped => ({ at, kind: null, guides: [] });

const snapped = (found: Snapped | null, pointer: Point): Snapped =>
  found ? { at: found.at, kind: found.kind, guides: found.guides } : free(pointer);

const nearlyStraight = 4; // degrees

/** A typed length goes along the frame or the last edge, or at right angles to them, if the pointer is almost there. */
function straightened(way: Point, { frame = 0, drawn = [] }: SnapRequest): Point {
  const [a, b] = drawn.slice(-2);
  const direction = directionOf(way);
  for (const base of [...(b ? [directionOf(minus(b, a))] : []), frame]) {
    const off = ((((direction - base) % 90) + 135) % 90) - 45;
    if (Math.abs(off) <= nearlyStraight) return unitAt(direction - off);
  }
  return way;
}

/** Of length 1; along the frame if both are at one place. */
function wayTo(from: Point, to: Point, { frame = 0 }: SnapRequest): Point {
  const length = distance(from, to);
  return length > tolerance ? times(minus(to, from), 1 / length) : unitAt(frame);
}
