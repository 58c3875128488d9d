// The lines of a drawing, by place. Places are pixels of the picture.

import Flatbush from "flatbush";

import type { Point } from "../document/messages";
import { middleOf, type Bounds } from "../geometry/bounds";
import { area, contains, nearestOn } from "../geometry/polygon";
import { distance } from "../geometry/vector";
import type { Lines } from "./sheet";

export type PixelLine = [Point, Point];

/** The index of lines; null without any. `ends`: x0, y0, x1, y1 of each. */
export function indexOfLines(ends: Float32Array): Flatbush | null {
  if (ends.length === 0) return null;
  const index = new Flatbush(ends.length / 4, 16, Float32Array);
  for (let k = 0; k < ends.length; k += 4)
    index.add(
      Math.min(ends[k], ends[k + 2]),
      Math.min(ends[k + 1], ends[k + 3]),
      Math.max(ends[k], ends[k + 2]),
      Math.max(ends[k + 1], ends[k + 3]),
    );
  index.finish();
  return index;
}

/** Whether the bounds of a line and a rectangle have something in common. */
const overlap = ([[x, y], [u, v]]: PixelLine, { lower, upper }: Bounds): boolean =>
  Math.max(x, u) >= lower[0] && Math.min(x, u) <= upper[0] && Math.max(y, v) >= lower[1] && Math.min(y, v) <= upper[1];

export class LineIndex {
  private readonly index: Flatbush | null;
  /** Layers whose lines and outlines are not found. */
  hidden: ReadonlySet<number> = new Set();
  /** Shorter lines, which are of letters and hatches, are not found. */
  least = 0;
  /** The part that is shown: lines that do not reach into it, and outlines that leave it, are not found. */
  shown: Bounds | null = null;

  constructor(private readonly lines: Lines) {
    const { ends, index } = lines;
    this.index = index && ends.length > 0 ? Flatbush.from(index) : indexOfLines(ends);
  }

  get count(): number {
    return this.lines.ends.length / 4;
  }

  /** The nearest lines within a distance, at most `most`. */
  near(point: Point, reach: number, most: number): PixelLine[] {
    const found = this.index?.neighbors(...point, most, reach, (k) => this.isShown(k)) ?? [];
    return found
      .map((line) => this.line(line))
      .filter(([from, to]) => distance(nearestOn(from, to, point), point) <= reach);
  }

  /** Lines whose bounds touch a rectangle, at most `most`. */
  within({ lower, upper }: Bounds, most: number): PixelLine[] {
    const [x, y] = middleOf({ lower, upper });
    const reach = 0.5 * Math.hypot(upper[0] - lower[0], upper[1] - lower[1]);
    // The nearest to the middle: of many lines, the first ones of the index may all be at one side.
    const chosen = this.index?.neighbors(x, y, most, reach, (k) => this.isShown(k)) ?? [];
    return chosen.map((line) => this.line(line)).filter(([from, to]) => overlap([from, to], { lower, upper }));
  }

  /** The smallest closed outline around a place. */
  outlineAt(point: Point): Point[] | null {
    let best: Point[] | null = null;
    let least = Infinity;
    for (let k = 0; k + 1 < this.lines.firsts.length; ++k) {
      if (!this.isOutlineShown(k) || !this.surrounds(k, point)) continue;
      const corners = this.outline(k);
      const size = area(corners);
      if (size >= least || !contains(corners, point)) continue;
      least = size;
      best = corners;
    }
    return best;
  }

  outlinesOf(layer: number): Point[][] {
    const { firsts, layers } = this.lines;
    const all = Array.from({ length: Math.max(firsts.length - 1, 0) }, (_, k) => k);
    return all.filter((k) => layers?.ofOutline[k] === layer && this.isOutlineShown(k)).map((k) => this.outline(k));
  }

  private isShown(line: number): boolean {
    const { layers, ends } = this.lines;
    if (layers && this.hidden.has(layers.ofLine[line])) return false;
    const k = 4 * line;
    if (Math.hypot(ends[k + 2] - ends[k], ends[k + 3] - ends[k + 1]) < this.least) return false;
    return this.shown === null || overlap(this.line(line), this.shown);
  }

  private isOutlineShown(outline: number): boolean {
    const { layers, corners, firsts } = this.lines;
    if (layers && this.hidden.has(layers.ofOutline[outline])) return false;
    if (!this.shown) return true;
    const { lower, upper } = this.shown;
    for (let k = 2 * firsts[outline]; k < 2 * firsts[outline + 1]; k += 2)
      if (corners[k] < lower[0] || corners[k] > upper[0] || corners[k + 1] < lower[1] || corners[k + 1] > upper[1])
        return false;
    return true;
  }

  /** Whether the bounds of an outline contain a place. */
  private surrounds(outline: number, [x, y]: Point): boolean {
    const { corners, firsts } = this.lines;
    let [left, right, upper, lower] = [Infinity, -Infinity, Infinity, -Infinity];
    for (let k = 2 * firsts[outline]; k < 2 * firsts[outline + 1]; k += 2) {
      left = Math.min(left, corners[k]);
      right = Math.max(right, corners[k]);
      upper = Math.min(upper, corners[k + 1]);
      lower = Math.max(lower, corners[k + 1]);
    }
    return x >= left && x <= right && y >= upper && y <= lower;
  }

  private outline(k: number): Point[] {
    const { corners, firsts } = this.lines;
    const first = firsts[k];
    return Array.from({ length: firsts[k + 1] - first }, (_, n) => [
      corners[2 * (first + n)],
      corners[2 * (first + n) + 1],
    ]);
  }

  private line(k: number): PixelLine {
    const [x, y, u, v] = this.lines.ends.subarray(4 * k, 4 * k + 4);
    return [
      [x, y],
      [u, v],
    ];
  }
}
