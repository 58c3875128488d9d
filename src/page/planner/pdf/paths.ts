// The visible lines of a PDF page, from the operations that draw it. Curves become chords. Lines do not end beneath images
// and patterns, nor at clips by text; the edge that a clip gives a fill is no line.

import type { Point } from "../document/messages";
import { combined, type Matrix } from "../dxf/shape/matrix";
import { indexOfLines } from "../sheet/line_index";
import type { Lines } from "../sheet/sheet";
import { boundsOfAll, clipped, common, Region, whole, without, type Loop, type Parts } from "./region";

/** The numbers of the operations that matter, as the reader of the file numbers them. */
export type Operations = Record<
  | "save"
  | "restore"
  | "transform"
  | "setGState"
  | "setFillRGBColor"
  | "setStrokeRGBColor"
  | "setFillColorN"
  | "setStrokeColorN"
  | "setFillTransparent"
  | "setStrokeTransparent"
  | "shadingFill"
  | "paintImageXObject"
  | "paintInlineImageXObject"
  | "constructPath"
  | "stroke"
  | "closeStroke"
  | "fill"
  | "eoFill"
  | "fillStroke"
  | "eoFillStroke"
  | "closeFillStroke"
  | "closeEOFillStroke"
  | "clip"
  | "eoClip"
  | "paintFormXObjectBegin"
  | "paintFormXObjectEnd"
  | "beginGroup"
  | "endGroup"
  | "beginMarkedContent"
  | "beginMarkedContentProps"
  | "endMarkedContent",
  number
>;

export interface OperatorList {
  fnArray: readonly number[];
  argsArray: readonly unknown[];
}

/** More lines are of a hatch or a text that nobody snaps to. */
export const mostLines = 2_000_000;
/** Tests of lines against edges, some seconds of work: after these, clips and fills are no longer heeded. */
const mostTests = 1e8;
/** Points of the page: smaller fills are of letters and hatches, and cover nothing that matters. */
const leastFill = 1;
const chords = 24;
const [moveTo, lineTo, curveTo, quadraticTo] = [0, 1, 2, 3];

/** The subpaths of a path: numbers of operations, each with its coordinates. Fills close what they begin. */
function loopsOf(path: ArrayLike<number>, [a, b, c, d, e, f]: Matrix, isFilled: boolean): Loop[] {
  const loops: Loop[] = [];
  let loop: number[] = [];
  let [x, y] = [0, 0];
  const add = (u: number, v: number) => {
    [x, y] = [u, v];
    const [px, py] = [a * u + c * v + e, b * u + d * v + f];
    if (loop.length === 0 || loop[loop.length - 2] !== px || loop[loop.length - 1] !== py) loop.push(px, py);
  };
  const finish = (isClosed: boolean) => {
    const [u, v] = loop;
    if (isClosed && loop.length > 2 && (loop[loop.length - 2] !== u || loop[loop.length - 1] !== v)) loop.push(u, v);
    if (loop.length > 2) loops.push(loop);
    loop = [];
  };
  /** `controls`: of the curve after the present point. */
  const curve = (controls: readonly [number, number][]) => {
    const points: [number, number][] = [[x, y], ...controls];
    for (let k = 1; k <= chords; ++k) {
      let level = points;
      while (level.length > 1)
        level = level.slice(1).map(([u, v], n): [number, number] => {
          const [p, q] = level[n];
          return [p + (k / chords) * (u - p), q + (k / chords) * (v - q)];
        });
      add(...level[0]);
    }
    [x, y] = controls[controls.length - 1];
  };
  let start: Point = [0, 0];
  for (let k = 0; k < path.length; ) {
    const pair = (n: number): Point => [path[k + 2 * n], path[k + 2 * n + 1]];
    switch (path[k++]) {
      case moveTo:
        finish(isFilled);
        start = pair(0);
        add(...start);
        k += 2;
        break;
      case lineTo:
        add(...pair(0));
        k += 2;
        break;
      case curveTo:
        curve([pair(0), pair(1), pair(2)]);
        k += 6;
        break;
      case quadraticTo:
        curve([pair(0), pair(1)]);
        k += 4;
        break;
      default:
        finish(true);
        add(...start);
    }
  }
  finish(isFilled);
  return loops;
}

/** Whether a colour is as that of the paper, or nearly so: lines of it are seen on other colours only. */
const isPaper = (colour: unknown): boolean => typeof colour === "string" && /^#(f[a-f]){3}$/i.test(colour);

/** What a save keeps. */
interface State {
  matrix: Matrix;
  clips: readonly Region[];
  /** Null: a pattern, or nothing. */
  fill: string | null;
  stroke: string | null;
  alpha: unknown;
  blend: unknown;
  mask: unknown;
  /** In a group that others shine through. */
  isVeiled: boolean;
}

interface Paint {
  isOpaque: boolean;
  isPaper: boolean;
}

/** An image or a pattern may be transparent. */
const unknownPaint: Paint = { isOpaque: false, isPaper: false };

const paintOf = ({ fill, alpha, blend, mask, isVeiled }: State): Paint => ({
  isOpaque: fill !== null && alpha === 1 && blend === "source-over" && mask === false && !isVeiled,
  isPaper: isPaper(fill),
});

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

class Collector {
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

/** A rectangle of a form, or the unit square of an image. */
const placed = ([x, y, u, v]: ArrayLike<number> & Iterable<number>, matrix: Matrix): Region =>
  new Region(loopsOf([moveTo, x, y, lineTo, u, y, lineTo, u, v, lineTo, x, v], matrix, true), false);

/**
 * `page`: the place of the page's coordinates in the picture, which has a `size`. `isVisible`: whether a layer of the file
 * is shown, by what the operation says of it.
 */
export function linesOf(
  { fnArray, argsArray }: OperatorList,
  ops: Operations,
  { page, size }: { page: Matrix; size: Point },
  isVisible: (layer: unknown) => boolean,
): Lines {
  const into = new Collector();
  let now: State = {
    matrix: page,
    clips: [new Region([[0, 0, size[0], 0, size[0], size[1], 0, size[1]]], false)],
    fill: "#000000",
    stroke: "#000000",
    alpha: 1,
    blend: "source-over",
    mask: false,
    isVeiled: false,
  };
  const saved: State[] = [];
  const marked: boolean[] = [];
  let hidden = 0;
  let clipRule = 0; // of the path to come
  const enter = (matrix: unknown, bounds: unknown) => {
    if (matrix) now = { ...now, matrix: combined(now.matrix, matrix as Matrix) };
    if (bounds) now = { ...now, clips: clipped(now.clips, placed(bounds as number[], now.matrix)) };
  };
  const strokes = [
    ops.stroke,
    ops.closeStroke,
    ops.fillStroke,
    ops.eoFillStroke,
    ops.closeFillStroke,
    ops.closeEOFillStroke,
  ];
  const evenOdd = [ops.eoFill, ops.eoFillStroke, ops.closeEOFillStroke];
  const fills = [ops.fill, ops.fillStroke, ops.closeFillStroke, ...evenOdd];
  const construct = (paint: number, path: ArrayLike<number> | null) => {
    const [isStroked, isFilled] = [strokes.includes(paint), fills.includes(paint)];
    const loops = loopsOf(path ?? [], now.matrix, isFilled);
    if (hidden === 0 && (isStroked || isFilled)) {
      const before = into.drawn;
      into.draw(loops, now.clips, (!isStroked || isPaper(now.stroke)) && (!isFilled || isPaper(now.fill)));
      if (isFilled) into.fill([new Region(loops, evenOdd.includes(paint)), ...now.clips], paintOf(now), before);
    }
    if (clipRule !== 0) now = { ...now, clips: clipped(now.clips, new Region(loops, clipRule === ops.eoClip)) };
    clipRule = 0;
  };
  fnArray.forEach((operation, k) => {
    if (into.isFull) return;
    const args = argsArray[k] as unknown[];
    switch (operation) {
      case ops.save:
        saved.push(now);
        break;
      case ops.restore:
      case ops.paintFormXObjectEnd:
        now = saved.pop() ?? now;
        break;
      case ops.transform:
        now = { ...now, matrix: combined(now.matrix, args as unknown as Matrix) };
        break;
      case ops.setGState:
        for (const [key, value] of args[0] as [string, unknown][])
          if (key === "ca") now = { ...now, alpha: value };
          else if (key === "BM") now = { ...now, blend: value };
          else if (key === "SMask") now = { ...now, mask: value };
        break;
      case ops.setFillRGBColor:
        now = { ...now, fill: String(args[0]) };
        break;
      case ops.setStrokeRGBColor:
        now = { ...now, stroke: String(args[0]) };
        break;
      case ops.setFillColorN:
      case ops.setFillTransparent:
        now = { ...now, fill: null };
        break;
      case ops.setStrokeColorN:
      case ops.setStrokeTransparent:
        now = { ...now, stroke: null };
        break;
      case ops.paintImageXObject:
      case ops.paintInlineImageXObject:
      case ops.shadingFill: {
        const all = operation === ops.shadingFill ? now.clips : [placed([0, 0, 1, 1], now.matrix), ...now.clips];
        if (hidden === 0) into.fill(all, unknownPaint, into.drawn);
        break;
      }
      case ops.paintFormXObjectBegin:
        saved.push(now);
        enter(args[0], args[1]);
        break;
      case ops.beginGroup: {
        saved.push(now);
        const { bbox, matrix, smask } = args[0] as { bbox?: unknown; matrix?: unknown; smask?: unknown };
        const before = now.matrix;
        enter(matrix, bbox);
        const isVeiled = !paintOf({ ...now, fill: "" }).isOpaque;
        now = { ...now, matrix: before, alpha: 1, blend: "source-over", mask: false, isVeiled };
        if (smask) ++hidden; // not drawn itself
        break;
      }
      case ops.endGroup:
        now = saved.pop() ?? now;
        if ((args[0] as { smask?: unknown }).smask) --hidden;
        break;
      case ops.beginMarkedContent:
      case ops.beginMarkedContentProps: {
        const isShown = args[0] !== "OC" || isVisible(args[1]);
        marked.push(isShown);
        if (!isShown) ++hidden;
        break;
      }
      case ops.endMarkedContent:
        if (marked.pop() === false) --hidden;
        break;
      case ops.clip:
      case ops.eoClip:
        clipRule = operation;
        break;
      case ops.constructPath: {
        const [paint, [path]] = args as [number, [ArrayLike<number> | null]];
        construct(paint, path);
      }
    }
  });
  return into.finished();
}
