// Polylines of straight lines and arcs, drawn corner by corner.

import type { Lines } from "./lines";
import { drawWide, type WideEdge } from "./wide";

export class Polyline {
  private readonly firstLine: number;
  private corners = 0;
  private start: readonly [number, number] = [0, 0];
  private x = 0;
  private y = 0;
  private bulge = 0;
  private widths: [number, number];
  private edges = 0;
  private readonly wide: WideEdge[] = [];

  /** `usual`: the widths at the beginning and at the end of an edge that has no others. */
  constructor(
    private readonly lines: Lines,
    private readonly usual: readonly [number, number] = [0, 0],
  ) {
    this.firstLine = lines.count;
    this.widths = [...usual];
  }

  add(x: number, y: number): void {
    if (this.corners++ === 0) this.start = [x, y];
    else this.edgeTo(x, y);
    this.x = x;
    this.y = y;
    this.bulge = 0;
    this.widths = [...this.usual];
  }

  private edgeTo(x: number, y: number): void {
    const { lines, wide, widths, bulge } = this;
    if (x === this.x && y === this.y) return;
    const index = this.edges++;
    if (Math.max(...widths) > 0) {
      wide.push({ from: [this.x, this.y], to: [x, y], bulge, widths, index });
      lines.expect(2 * wide.length);
    } else lines.bulge(this.x, this.y, x, y, bulge);
  }

  /** Of the edge that leaves the last corner. */
  bend(bulge: number): void {
    this.bulge = bulge;
  }

  /** The width at the beginning (0) or at the end (1) of that edge. */
  widen(end: 0 | 1, width: number): void {
    this.widths[end] = width;
  }

  finish(isClosed: boolean): void {
    if (isClosed && this.corners > 1) this.edgeTo(...this.start);
    const isRing = isClosed || this.isBack();
    if (this.wide.length > 0) drawWide(this.lines, this.wide, this.edges, isRing);
  }

  private isBack(): boolean {
    return this.x === this.start[0] && this.y === this.start[1];
  }

  /** The same, and it surrounds an area if it ends where it began. */
  finishOutline(isClosed: boolean): void {
    this.finish(isClosed);
    if (this.wide.length === 0 && (isClosed || this.isBack())) this.lines.outline(this.firstLine);
  }
}

export function drawPolyline(lines: Lines, points: Iterable<readonly [number, number]>, isClosed = false): void {
  const polyline = new Polyline(lines);
  for (const [x, y] of points) polyline.add(x, y);
  polyline.finish(isClosed);
}
