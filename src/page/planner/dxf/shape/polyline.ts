// Polylines of straight lines and arcs, drawn corner by corner.

import type { Lines } from "./lines";

export class Polyline {
  private readonly firstLine: number;
  private corners = 0;
  private start: readonly [number, number] = [0, 0];
  private x = 0;
  private y = 0;
  private bulge = 0;

  constructor(private readonly lines: Lines) {
    this.firstLine = lines.count;
  }

  add(x: number, y: number): void {
    if (this.corners++ === 0) this.start = [x, y];
    else this.lines.bulge(this.x, this.y, x, y, this.bulge);
    this.x = x;
    this.y = y;
    this.bulge = 0;
  }

  /** Of the edge that leaves the last corner. */
  bend(bulge: number): void {
    this.bulge = bulge;
  }

  finish(isClosed: boolean): void {
    if (isClosed && this.corners > 1) this.lines.bulge(this.x, this.y, ...this.start, this.bulge);
  }

  /** The same, and it surrounds an area if it ends where it began. */
  finishOutline(isClosed: boolean): void {
    this.finish(isClosed);
    if (isClosed || (this.x === this.start[0] && this.y === this.start[1])) this.lines.outline(this.firstLine);
  }
}

export function drawPolyline(lines: Lines, points: Iterable<readonly [number, number]>, isClosed = false): void {
  const polyline = new Polyline(lines);
  for (const [x, y] of points) polyline.add(x, y);
  polyline.finish(isClosed);
}
