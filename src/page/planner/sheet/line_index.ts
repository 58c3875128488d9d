// The lines of a drawing, by place. Places are pixels of the picture.

import Flatbush from "flatbush";

import type { Point } from "../document/messages";
import type { Bounds } from "../geometry/bounds";
import { contains, nearestOn } from "../geometry/polygon";
import { distance } from "../geometry/vector";
import type { Lines } from "./sheet";

export type PixelLine = [Point, Point];

export class LineIndex {
  private readonly index: Flatbush | null;

  constructor(private readonly lines: Lines) {
    const { ends } = lines;
    this.index = ends.length > 0 ? new Flatbush(ends.length / 4, 16, Float32Array) : null;
    for (let k = 0; k < ends.length; k += 4)
      this.index?.add(
        Math.min(ends[k], ends[k + 2]),
        Math.min(ends[k + 1], ends[k + 3]),
        Math.max(ends[k], ends[k + 2]),
        Math.max(ends[k + 1], ends[k + 3]),
      );
    this.index?.finish();
  }

  get count(): number {
    return this.lines.ends.length / 4;
  }

  /** The nearest lines within a distance, at most `most`. */
  near(point: Point, reach: number, most: number): PixelLine[] {
    const found = this.index?.neighbors(...point, most, reach) ?? [];
    return found
      .map((line) => this.line(line))
      .filter(([from, to]) => distance(nearestOn(from, to, point), point) <= reach);
  }

  /** Lines whose bounds touch a rectangle, at most `most`. */
  within({ lower, upper }: Bounds, most: number): PixelLine[] {
    let found = 0;
    return (this.index?.search(...lower, ...upper, () => ++found <= most) ?? []).map((line) => this.line(line));
  }

  /** The smallest closed outline around a place. */
  outlineAt(point: Point): Point[] | null {
    const { outlines } = this.lines;
    let best: Point[] | null = null;
    let least = Infinity;
    for (let k = 0; k < outlines.length; k += 2) {
      const corners = this.corners(outlines[k], outlines[k + 1], point);
      if (!corners || !contains(corners, point)) continue;
      const area = Math.abs(areaOf(corners));
      if (area >= least) continue;
      least = area;
      best = corners;
    }
    return best;
  }

  /** Null if the bounds of the lines from `first` to before `end` do not contain the place. */
  private corners(first: number, end: number, [x, y]: Point): Point[] | null {
    const { ends } = this.lines;
    let [left, right, upper, lower] = [Infinity, -Infinity, Infinity, -Infinity];
    for (let k = 4 * first; k < 4 * end; k += 4) {
      left = Math.min(left, ends[k]);
      right = Math.max(right, ends[k]);
      upper = Math.min(upper, ends[k + 1]);
      lower = Math.max(lower, ends[k + 1]);
    }
    if (x < left || x > right || y < upper || y > lower) return null;
    return Array.from({ length: end - first }, (_, k): Point => [ends[4 * (first + k)], ends[4 * (first + k) + 1]]);
  }

  private line(k: number): PixelLine {
    const [x, y, u, v] = this.lines.ends.subarray(4 * k, 4 * k + 4);
    return [
      [x, y],
      [u, v],
    ];
  }
}

function areaOf(corners: readonly Point[]): number {
  return corners.reduce((sum, [x, y], k) => {
    const [u, v] = corners[(k + 1) % corners.length];
    return sum + 0.5 * (x * v - u * y);
  }, 0);
}
