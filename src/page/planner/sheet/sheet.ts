// A drawing of lines: what a page of a PDF file and a DXF file have in common. Places are pixels of the picture, x to the
// right and y downwards: points of a PDF page, units of a DXF drawing.

import type { Point } from "../document/messages";

/** A part of the picture, pixels. */
export interface Region {
  left: number;
  upper: number;
  width: number;
  height: number;
}

/** What can be snapped to. */
export interface Lines {
  /** x0, y0, x1, y1 of each. */
  ends: Float32Array;
  /** The first line of each closed outline and the one after its last. */
  outlines: Uint32Array;
}

export interface Sheet {
  size: Point;
  /** `scale`: pixels of the result per pixel of the picture. */
  render(region: Region, scale: number): Promise<ImageBitmap>;
  lines(): Promise<Lines>;
  close(): void;
}

export const wholeOf = ([width, height]: Point): Region => ({ left: 0, upper: 0, width, height });
