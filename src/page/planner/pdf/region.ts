// Areas of a PDF page: what a clip path shows, and what a fill covers.

import type { Point } from "../document/messages";

/** Points of the corners of a path: x, y, one after the other. */
export type Loop = readonly number[];

/** Parts of a line, as shares of its length in increasing order. */
export type Parts = readonly (readonly [from: number, to: number])[];

/** Points of the page. Places this near to an edge are on it. */
const slack = 0.02;

export const whole: Parts = [[0, 1]];
const none: Parts = [];

export const common = (a: Parts, b: Parts): Parts =>
  a
    .flatMap(([from, to]) => b.map(([p, q]): [number, number] => [Math.max(from, p), Math.min(to, q)]))
    .filter(([from, to]) => from < to);

/** `a` without `b`. */
export function without(a: Parts, b: Parts): Parts {
  const ends = [0, ...b.flat(), 1];
  const gaps = Array.from({ length: ends.length / 2 }, (_, k): [number, number] => [ends[2 * k], ends[2 * k + 1]]);
  return common(a, gaps);
}

export class Region {
  /** x0, y0, x1, y1 of each edge. */
  private readonly edges: number[] = [];
  readonly lower: Point = [Infinity, Infinity];
  readonly upper: Point = [-Infinity, -Infinity];
  readonly isRectangle: boolean;

  /** Loops are closed. */
  constructor(
    loops: readonly Loop[],
    private readonly isEvenOdd: boolean,
  ) {
    let isUpright = true;
    for (const loop of loops)
      for (let k = 0; k < loop.length; k += 2) {
        const [x, y, next] = [loop[k], loop[k + 1], (k + 2) % loop.length];
        for (const [axis, value] of [x, y].entries()) {
          this.lower[axis] = Math.min(this.lower[axis], value);
          this.upper[axis] = Math.max(this.upper[axis], value);
        }
        const [u, v] = [loop[next], loop[next + 1]];
        if (x === u && y === v) continue;
        isUpright &&= Math.min(Math.abs(x - u), Math.abs(y - v)) < slack;
        this.edges.push(x, y, u, v);
      }
    this.isRectangle = loops.length === 1 && this.size === 4 && isUpright;
  }

  /** The number of edges. */
  get size(): number {
    return this.edges.length / 4;
  }

  /** Parts of a line in the area; those along an edge belong to it unless `isStrict`. */
  inside(x: number, y: number, u: number, v: number, isStrict: boolean): Parts {
    const { edges, lower, upper } = this;
    const [left, right] = x < u ? [x, u] : [u, x];
    const [least, most] = y < v ? [y, v] : [v, y];
    if (right < lower[0] - slack || left > upper[0] + slack) return none;
    if (most < lower[1] - slack || least > upper[1] + slack) return none;
    if (this.isRectangle && left >= lower[0] && right <= upper[0] && least >= lower[1] && most <= upper[1])
      if (!isStrict) return whole;
    const dx = u - x;
    const dy = v - y;
    const length = Math.hypot(dx, dy);
    const near = slack * length;
    const cuts = [0, 1];
    for (let k = 0; k < edges.length; k += 4) {
      const ax = edges[k] - x;
      const ay = edges[k + 1] - y;
      const bx = edges[k + 2] - x;
      const by = edges[k + 3] - y;
      // Distances of the ends of the edge from the line, times the length of the line.
      const p = dx * ay - dy * ax;
      const q = dx * by - dy * bx;
      if ((p > near && q > near) || (p < -near && q < -near)) continue;
      const isAlong = Math.abs(p - q) <= near;
      const first = isAlong ? (ax * dx + ay * dy) / (length * length) : (ax * by - ay * bx) / (q - p);
      if (first > 0 && first < 1) cuts.push(first);
      const second = isAlong ? (bx * dx + by * dy) / (length * length) : 0;
      if (second > 0 && second < 1) cuts.push(second);
    }
    if (cuts.length > 2) cuts.sort((a, b) => a - b);
    const parts: [number, number][] = [];
    let from = 0;
    for (let k = 1; k < cuts.length; ++k) {
      const to = cuts[k];
      const isLast = k === cuts.length - 1;
      if (!isLast && (to - from) * length <= slack) continue;
      const middle = 0.5 * (from + to);
      const side = this.sideOf(x + middle * dx, y + middle * dy);
      const last = parts.at(-1);
      if (side > 0 || (side === 0 && !isStrict)) {
        if (last?.[1] === from) last[1] = to;
        else parts.push([from, to]);
      }
      from = to;
    }
    return parts;
  }

  /** 1: in the area, 0: on an edge, -1: outside. */
  sideOf(x: number, y: number): number {
    const { edges } = this;
    let winding = 0;
    for (let k = 0; k < edges.length; k += 4) {
      const ax = edges[k] - x;
      const ay = edges[k + 1] - y;
      const dx = edges[k + 2] - x - ax;
      const dy = edges[k + 3] - y - ay;
      const far = dx * ay - dy * ax; // the distance from the line of the edge, times its length
      const square = dx * dx + dy * dy;
      if (far * far <= slack * slack * square) {
        const along = -(ax * dx + ay * dy);
        const near = slack * Math.sqrt(square);
        if (along >= -near && along <= square + near) return 0;
      }
      if (ay > 0 !== ay + dy > 0 && ax - (ay / dy) * dx > 0) winding += dy > 0 ? 1 : -1;
    }
    const isInside = this.isEvenOdd ? winding % 2 !== 0 : winding !== 0;
    return isInside ? 1 : -1;
  }
}

const rectangleOf = ([x, y]: Point, [u, v]: Point): Region =>
  new Region(x < u && y < v ? [[x, y, u, y, u, v, x, v]] : [], false);

/** Clip paths together with another: nested rectangles become one. */
export function clipped(clips: readonly Region[], by: Region): readonly Region[] {
  const other = by.isRectangle ? clips.find(({ isRectangle }) => isRectangle) : undefined;
  if (!other) return [...clips, by];
  const [lower, upper] = boundsOfAll([other, by]);
  return [...clips.filter((clip) => clip !== other), rectangleOf(lower, upper)];
}

/** What lies in the bounds of all of them. */
export const boundsOfAll = (regions: readonly Region[]): [lower: Point, upper: Point] => [
  [Math.max(...regions.map(({ lower }) => lower[0])), Math.max(...regions.map(({ lower }) => lower[1]))],
  [Math.min(...regions.map(({ upper }) => upper[0])), Math.min(...regions.map(({ upper }) => upper[1]))],
];
