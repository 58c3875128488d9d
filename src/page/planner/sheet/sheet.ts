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

/** What can be snapped to, and taken. */
export interface Lines {
  /** x0, y0, x1, y1 of each line. */
  ends: Float32Array;
  /** x, y of the corners of the closed outlines, one outline after the other. */
  corners: Float32Array;
  /** The first corner of each outline, and the number of all corners. */
  firsts: Uint32Array;
  /** The layers of lines and outlines; null: there are no layers. */
  layers: { ofLine: Uint16Array; ofOutline: Uint16Array } | null;
  /** The lines by place, if that is known: the data of a Flatbush. */
  index: ArrayBuffer | null;
}

export interface SheetLayer {
  name: string;
  /** "#rrggbb", readable on white. */
  colour: string;
  /** Whether the file shows it. */
  isOn: boolean;
  lines: number;
  texts: number;
  outlines: number;
}

export interface Sheet {
  size: Point;
  layers: readonly SheetLayer[];
  /** Without these layers, from the next picture on. */
  hide(layers: ReadonlySet<number>): void;
  /** `scale`: pixels of the result per pixel of the picture. */
  render(region: Region, scale: number): Promise<ImageBitmap>;
  lines(): Promise<Lines>;
  close(): void;
}

/** A drawing that a browser needs longer for is no floor plan, or it was made to stop the reader, ms. */
const patience = 60_000;

/** The result of a step of a reader, or what `late` makes of one that takes too long. */
export async function inTime<Value>(work: Promise<Value>, late: () => Error): Promise<Value> {
  let timer: ReturnType<typeof setTimeout> | undefined;
  const tooLate = new Promise<never>((_, fail) => {
    timer = setTimeout(() => fail(late()), patience);
  });
  return Promise.race([work, tooLate]).finally(() => clearTimeout(timer));
}

export const wholeOf = ([width, height]: Point): Region => ({ left: 0, upper: 0, width, height });
