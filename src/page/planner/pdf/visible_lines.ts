// Collects the lines and closed outlines of a PDF page, in the order in which they are drawn, and leaves out what is not
// visible.

import { indexOfLines } from "../sheet/line_index";
import type { Lines } from "../sheet/sheet";
import { boundsOfAll, common, whole, without, type Loop, type Parts, type Region } from "./region";
import type { Point } from "../document/messages";

/** More lines are of a hatch or a text that nobody snaps to. */
const mostLines = 2_000_000;
/** Tests of lines against edges, some seconds of work: after these, clips and fills are no longer heeded. */
const mostTests = 1e8;
/** Points of the page: smaller fills are of letters and hatches, and cover nothing that matters. */
const leastFill = 1;

export interface Paint {
  isOpaque: boolean;
  isPaper: boolean;
}

/** An image or a pattern may be transparent. */
export const unknownPaint: Paint = { isOpaque: false, isPaper: false };

/** A fill lies in all of its regions. */
interface Fill extends Paint {
  regions: readonly Region[];
  lower: Point;
  upper: Point;
  before: number;
}

/** A closed outline: its lines, and the length that they have when nothing covers them. */
interface Outline {
  first: number;
  end: number;
  length: number;
  corners: Loop;
}

export class VisibleLines {
  private ends = new Float32Array(1 << 12);
  private count = 0;
  private tests = 0;
  private readonly fills: Fill[] = [];
  private readonly outlines: Outline[] = [];

  get drawn(): number {
    return this.count;
  }

  get isFull(): boolean {
    return this.count >= mostLines;
  }

  private inside(
    regions: readonly Region[],
    [x, y, u, v]: readonly [number, number, number, number],
    isStrict: boolean,
  ): Parts {
    let parts = whole;
    for (const region of regions) {
      if (parts.length === 0) break;
      this.tests += region.size;
      if (this.tests > mostTests) return isStrict ? [] : whole;
      const found = region.inside(x, y, u, v, isStrict);
      parts = parts === whole ? found : common(parts, found);
    }
    return parts;
  }

  private add(x: number, y: number, u: number, v: number, parts: Parts): void {
    for (const [from, to] of parts) {
      if (this.isFull) return;
      const k = 4 * this.count++;
      if (k + 4 > this.ends.length) {
        const larger = new Float32Array(2 * this.ends.length);
        larger.set(this.ends);
        this.ends = larger;
      }
      this.ends[k] = x + from * (u - x);
      this.ends[k + 1] = y + from * (v - y);
      this.ends[k + 2] = to === 1 ? u : x + to * (u - x);
      this.ends[k + 3] = to === 1 ? v : y + to * (v - y);
    }
  }

  /** `needsGround`: the lines are seen only on what is not as white as the paper. */
  draw(loops: readonly Loop[], clips: readonly Region[], needsGround: boolean): void {
    for (const loop of loops) {
      const first = this.count;
      let isWhole = true;
      let length = 0;
      for (let k = 2; k < loop.length; k += 2) {
        const line = [loop[k - 2], loop[k - 1], loop[k], loop[k + 1]] as const;
        const [x, y, u, v] = line;
        length += Math.hypot(u - x, v - y);
        const parts = this.inside(clips, line, false);
        isWhole &&= parts.length === 1 && parts[0][0] === 0 && parts[0][1] === 1;
        if (!needsGround || this.hasGround(0.5 * (x + u), 0.5 * (y + v))) this.add(x, y, u, v, parts);
      }
      const isClosed = loop[0] === loop[loop.length - 2] && loop[1] === loop[loop.length - 1];
      if (isWhole && isClosed && loop.length >= 8)
        this.outlines.push({ first, end: this.count, length, corners: loop.slice(0, -2) });
    }
  }

  /** `before`: the number of lines beneath it. */
  fill(regions: readonly Region[], paint: Paint, before: number): void {
    const [lower, upper] = boundsOfAll(regions);
    if (Math.min(upper[0] - lower[0], upper[1] - lower[1]) < leastFill) return;
    this.fills.push({ regions, lower, upper, before, ...paint });
  }

  /** Whether the uppermost fill at a place has a colour. */
  private hasGround(x: number, y: number): boolean {
    for (let k = this.fills.length - 1; k >= 0 && ++this.tests <= mostTests; --k) {
      const { regions, lower, upper, isOpaque, isPaper } = this.fills[k];
      if (x < lower[0] || x > upper[0] || y < lower[1] || y > upper[1] || (isPaper && !isOpaque)) continue;
      for (const { size } of regions) this.tests += size;
      if (regions.every((region) => region.sideOf(x, y) >= 0)) return !isPaper;
    }
    return this.tests > mostTests;
  }

  /** What is left of lines that later fills cover, by their numbers. */
  private left(): ReadonlyMap<number, Parts> {
    const left = new Map<number, Parts>();
    const fills = this.fills.filter(({ isOpaque, before }) => isOpaque && before > 0);
    const index = fills.length > 0 ? indexOfLines(this.ends.subarray(0, 4 * this.count)) : null;
    for (const { regions, lower, upper, before } of fills)
      for (const line of index?.search(...lower, ...upper, (k) => k < before) ?? []) {
        const [x, y, u, v] = this.ends.subarray(4 * line, 4 * line + 4);
        const covered = this.inside(regions, [x, y, u, v], true);
        if (covered.length > 0) left.set(line, without(left.get(line) ?? whole, covered));
      }
    return left;
  }

  finished(): Lines {
    const left = this.left();
    const { ends, count } = this;
    const starts = new Uint32Array(count + 1);
    this.ends = new Float32Array(ends.length);
    this.count = 0;
    for (let k = 0; k < count; ++k) {
      this.add(ends[4 * k], ends[4 * k + 1], ends[4 * k + 2], ends[4 * k + 3], left.get(k) ?? whole);
      starts[k + 1] = this.count;
    }
    const seen = this.outlines.filter(
      ({ first, end, length }) => this.lengthOf(starts[first], starts[end]) >= 0.5 * length,
    );
    const firsts = [0];
    for (const { corners } of seen) firsts.push(firsts[firsts.length - 1] + corners.length / 2);
    return {
      ends: this.ends.slice(0, 4 * this.count),
      corners: Float32Array.from(seen.flatMap(({ corners }) => corners)),
      firsts: Uint32Array.from(firsts),
      layers: null,
      index: null,
    };
  }

  private lengthOf(first: number, end: number): number {
    let length = 0;
    for (let k = 4 * first; k < 4 * end; k += 4)
      length += Math.hypot(this.ends[k + 2] - this.ends[k], this.ends[k + 3] - this.ends[k + 1]);
    return length;
  }
}
