// The lines of a PDF page, from the operations that draw it. Curves become chords.

import { combined, type Matrix } from "../dxf/shape/matrix";
import type { Lines } from "../sheet/sheet";

/** The numbers of the operations that matter, as the reader of the file numbers them. */
export interface Operations {
  save: number;
  restore: number;
  transform: number;
  constructPath: number;
  endPath: number;
  stroke: number;
  closeStroke: number;
  clip: number;
  eoClip: number;
  paintFormXObjectBegin: number;
  paintFormXObjectEnd: number;
  beginMarkedContent: number;
  beginMarkedContentProps: number;
  endMarkedContent: number;
}

export interface OperatorList {
  fnArray: readonly number[];
  argsArray: readonly unknown[];
}

/** More lines are of a hatch or a text that nobody snaps to. */
export const mostLines = 2_000_000;
const chords = 24;
const [moveTo, lineTo, curveTo, quadraticTo] = [0, 1, 2, 3];

class Collector {
  private ends = new Float32Array(1 << 12);
  private count = 0;
  private readonly corners: number[] = [];
  private readonly firsts = [0];
  private first = 0; // line of the present outline
  private start: [number, number] = [0, 0];
  private at: [number, number] = [0, 0];

  get isFull(): boolean {
    return this.count >= mostLines;
  }

  move(x: number, y: number): void {
    this.finish();
    this.start = [x, y];
    this.at = [x, y];
  }

  line(x: number, y: number): void {
    const [u, v] = this.at;
    this.at = [x, y];
    if ((u === x && v === y) || this.isFull) return;
    if (4 * this.count + 4 > this.ends.length) {
      const larger = new Float32Array(2 * this.ends.length);
      larger.set(this.ends);
      this.ends = larger;
    }
    this.ends.set([u, v, x, y], 4 * this.count);
    ++this.count;
  }

  close(): void {
    this.line(...this.start);
    this.finish();
  }

  /** A path that ends where it began is closed, too. */
  finish(): void {
    const isClosed = this.at[0] === this.start[0] && this.at[1] === this.start[1];
    if (isClosed && this.count - this.first >= 3) {
      for (let k = 4 * this.first; k < 4 * this.count; k += 4) this.corners.push(this.ends[k], this.ends[k + 1]);
      this.firsts.push(this.corners.length / 2);
    }
    this.first = this.count;
  }

  get lines(): Lines {
    return {
      ends: this.ends.slice(0, 4 * this.count),
      corners: Float32Array.from(this.corners),
      firsts: Uint32Array.from(this.firsts),
      layers: null,
      index: null,
    };
  }
}

/** Draws one path: numbers of operations, each with its coordinates. */
function draw(into: Collector, path: ArrayLike<number>, [a, b, c, d, e, f]: Matrix, isFilled: boolean): void {
  let [x, y] = [0, 0];
  let hasBegun = false; // fills close what they begin
  const place = (u: number, v: number): [number, number] => [a * u + c * v + e, b * u + d * v + f];
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
      into.line(...place(...level[0]));
    }
    [x, y] = controls[controls.length - 1];
  };
  for (let k = 0; k < path.length; ) {
    const pair = (n: number): [number, number] => [path[k + 2 * n], path[k + 2 * n + 1]];
    switch (path[k++]) {
      case moveTo:
        if (isFilled && hasBegun) into.close();
        hasBegun = true;
        [x, y] = pair(0);
        into.move(...place(x, y));
        k += 2;
        break;
      case lineTo:
        [x, y] = pair(0);
        into.line(...place(x, y));
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
        into.close();
    }
  }
  if (isFilled && hasBegun) into.close();
  into.finish();
}

/**
 * `page`: the place of the page's coordinates in the picture. `isVisible`: whether a layer of the file is shown, by what
 * the operation says of it.
 */
export function linesOf(
  { fnArray, argsArray }: OperatorList,
  ops: Operations,
  page: Matrix,
  isVisible: (layer: unknown) => boolean,
): Lines {
  const into = new Collector();
  let now = page;
  const saved: Matrix[] = [];
  const marked: boolean[] = [];
  let hidden = 0;
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
        now = combined(now, args as unknown as Matrix);
        break;
      case ops.paintFormXObjectBegin:
        saved.push(now);
        if (args[0]) now = combined(now, args[0] as Matrix);
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
      case ops.constructPath: {
        const [paint, [path]] = args as [number, [ArrayLike<number> | null]];
        const isPaint = paint !== ops.endPath && paint !== ops.clip && paint !== ops.eoClip;
        if (path && isPaint && hidden === 0) draw(into, path, now, paint !== ops.stroke && paint !== ops.closeStroke);
      }
    }
  });
  return into.lines;
}
