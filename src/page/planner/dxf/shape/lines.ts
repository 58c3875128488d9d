// The lines of a file as they are read, block after block.

import { DxfError } from "../error";
import { identity, type Matrix } from "./matrix";

function longer<T extends Float64Array | Uint16Array>(array: T, size: number): T {
  const copy = new (array.constructor as new (length: number) => T)(size);
  copy.set(array);
  return copy;
}

/** Of the arc from point to point with a bulge. */
export function centreOf(x0: number, y0: number, x1: number, y1: number, bulge: number): [number, number] {
  const ratio = (1 - bulge * bulge) / (4 * bulge);
  return [0.5 * (x0 + x1) - (y1 - y0) * ratio, 0.5 * (y0 + y1) + (x1 - x0) * ratio];
}

export class Lines {
  /** x0, y0, x1, y1 of each line. */
  positions = new Float64Array(4096);
  layers = new Uint16Array(1024);
  count = 0;
  /** How many of them are pieces of curves. */
  curved = 0;
  /** The first line of each outline, and the line after its last. */
  readonly outlines: number[] = [];
  /** Of the block that is read. */
  block = "";

  private layer = 0;
  private at = identity;
  private x = 0;
  private y = 0;

  /** `share`: of the size of a curve, the largest distance between the curve and its lines is 1 / share. */
  constructor(
    private readonly limit: number,
    private readonly share: number,
  ) {}

  /** Lines that follow are on a layer, and their points are mapped. */
  begin(layer: number, at: Matrix): void {
    this.layer = layer;
    this.at = at;
  }

  move(x: number, y: number): void {
    const { at } = this;
    this.x = at === identity ? x : at[0] * x + at[2] * y + at[4];
    this.y = at === identity ? y : at[1] * x + at[3] * y + at[5];
  }

  /** Draws a line, unless it has no length. */
  line(x: number, y: number): void {
    const { x: x0, y: y0 } = this;
    this.move(x, y);
    if (x0 === this.x && y0 === this.y) return;
    this.expect(1);
    let at = 4 * this.count;
    if (at === this.positions.length) {
      this.positions = longer(this.positions, 2 * at);
      this.layers = longer(this.layers, at / 2);
    }
    this.layers[this.count++] = this.layer;
    const { positions } = this;
    positions[at++] = x0;
    positions[at++] = y0;
    positions[at++] = this.x;
    positions[at] = this.y;
  }

  /** So many lines follow. */
  expect(more: number): void {
    if (this.count + more > this.limit) throw new DxfError("too_many", { block: this.block, limit: this.limit });
  }

  /**
   * A piece of an ellipse about a centre with two conjugate radii, from an angle on. `end`: its end, where it is known
   * better.
   */
  arc(
    centre: readonly number[],
    u: readonly number[],
    v: readonly number[],
    from: number,
    sweep: number,
    end?: readonly [number, number],
  ): void {
    const pieces = this.pieces(Math.abs(sweep));
    const before = this.count;
    for (let k = 0; k <= pieces; ++k) {
      const angle = from + (sweep * k) / pieces;
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      const [x, y] = k === pieces && end ? end : [centre[0] + c * u[0] + s * v[0], centre[1] + c * u[1] + s * v[1]];
      if (k === 0) this.move(x, y);
      else this.line(x, y);
    }
    this.curved += this.count - before;
  }

  circle(centre: readonly number[], radius: number, from = 0, sweep = 2 * Math.PI): void {
    this.arc(centre, [radius, 0], [0, radius], from, sweep);
  }

  /** An edge from point to point; the tangent of a quarter of its angle is its bulge, above 0 counter-clockwise. */
  bulge(x0: number, y0: number, x1: number, y1: number, bulge: number): void {
    this.move(x0, y0);
    if (Math.abs(bulge) > 1e-6 && (x0 !== x1 || y0 !== y1)) {
      const centre = centreOf(x0, y0, x1, y1, bulge);
      const [dx, dy] = [x0 - centre[0], y0 - centre[1]];
      this.arc(centre, [dx, dy], [-dy, dx], 0, 4 * Math.atan(bulge), [x1, y1]);
    } else this.line(x1, y1);
  }

  /** Of an arc. The distance of a piece from the arc is about its radius times the square of its angle by 8. */
  pieces(sweep: number): number {
    const needed = sweep * Math.sqrt(this.share / (8 * Math.min(1, sweep)));
    return Math.max(1, Math.min(256, Math.ceil(Math.max(needed, (8 * sweep) / Math.PI))));
  }

  /** The largest distance of lines from a curve of some size. */
  tolerance(size: number): number {
    return size / this.share;
  }

  /** The lines from the given one on surround an area. */
  outline(first: number): void {
    if (this.count >= first + 3) this.outlines.push(first, this.count);
  }
}
