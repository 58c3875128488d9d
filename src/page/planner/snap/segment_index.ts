// Finds segments, and bodies with aisles between them, near a place.

import Flatbush from "flatbush";

import type { Point } from "../document/messages";
import { boundsOf, type Bounds } from "../geometry/bounds";
import { nearestOn } from "../geometry/polygon";
import { distance } from "../geometry/vector";
import type { Segment } from "./segments";

function indexOf(all: readonly Bounds[]): Flatbush | null {
  if (all.length === 0) return null;
  const index = new Flatbush(all.length);
  for (const { lower, upper } of all) index.add(...lower, ...upper);
  index.finish();
  return index;
}

const around = (points: readonly Point[]): Bounds => boundsOf(points) as Bounds;

/** Lines from elsewhere that attract, too. */
export interface LineSource {
  near(point: Point, reach: number, most: number): Segment[];
  within(bounds: Bounds, most: number): Segment[];
}

export class SegmentIndex {
  /** The number of segments and bodies that were looked at since it was set. */
  examined = 0;

  private readonly index: Flatbush | null;
  private readonly bodies: Point[][];
  private readonly bodyIndex: Flatbush | null;

  constructor(
    private readonly segments: readonly Segment[],
    private readonly beneath: LineSource | null = null,
  ) {
    this.index = indexOf(segments.map(({ from, to }) => around([from, to])));
    const corners = new Map<string, Point[]>();
    for (const { body, from, to } of segments) {
      if (body === undefined) continue;
      const known = corners.get(body);
      if (known) known.push(from, to);
      else corners.set(body, [from, to]);
    }
    this.bodies = [...corners.values()];
    this.bodyIndex = indexOf(this.bodies.map(around));
  }

  /** The nearest segments within a distance, at most `most`, and as many from elsewhere. */
  near(point: Point, reach: number, most: number): Segment[] {
    const own = this.take(this.index?.neighbors(...point, most, reach)).filter(
      ({ from, to }) => distance(nearestOn(from, to, point), point) <= reach,
    );
    return [...own, ...(this.beneath?.near(point, reach, most) ?? [])];
  }

  /** Segments whose bounds touch a rectangle, at most `most`. */
  within(bounds: Bounds, most: number): Segment[] {
    const { lower, upper } = bounds;
    let found = 0;
    const own = this.take(this.index?.search(...lower, ...upper, () => ++found <= most));
    return [...own, ...(this.beneath?.within(bounds, most) ?? [])];
  }

  /** The corners of each of the bodies that are nearest to a point. */
  bodiesNear(point: Point, reach: number, most: number): Point[][] {
    const found = this.bodyIndex?.neighbors(...point, most, reach) ?? [];
    this.examined += found.length;
    return found.map((index) => this.bodies[index]);
  }

  private take(found: readonly number[] = []): Segment[] {
    this.examined += found.length;
    return found.map((index) => this.segments[index]);
  }
}
