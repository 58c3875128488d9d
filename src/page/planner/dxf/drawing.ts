// What a DXF file shows in model space, as lines and texts of its layers.

import type { SheetLayer } from "../sheet/sheet";

/** A closed polyline, circle or ellipse, without its first corner at the end. */
export interface DxfOutline {
  layer: number;
  points: [number, number][];
}

export interface DxfText {
  layer: number;
  at: [number, number];
  /** The place of `at` in the box of the text, from its left and from its lower end, 0 to 1. */
  anchor: [number, number];
  height: number;
  /** Degrees, counter-clockwise. */
  turn: number;
  text: string;
}

export type DxfNoteCode =
  /** A code page without a decoder, read as Windows-1252. */
  | "code_page"
  /** Texts of a file that should be UTF-8 and are not, read by the code page. */
  | "not_utf8"
  /** A code page, in a file that is UTF-8 and is read so. */
  | "utf8"
  | "proxy"
  /** Objects of AutoCAD Architecture and its relatives. */
  | "aec"
  /** Solids, surfaces, regions and meshes. */
  | "solid"
  /** Dimensions without a block that shows them. */
  | "dimension"
  /** A block of another file, by the name of that file. */
  | "xref"
  /** By the type of the entity. */
  | "unsupported"
  /** A block that contains itself. */
  | "recursive_block"
  | "missing_block"
  | "invisible"
  | "paper_space"
  /** Entities that are neither parallel to the plan nor mirrored, projected on it. */
  | "tilted"
  /** Lines and texts more than a thousand times as far away as the rest is large, left out. */
  | "stray"
  /** Curves that are coarser than usual, with the number of lines of a circle. */
  | "coarse"
  /** More texts or outlines than a drawing may have. */
  | "texts_left_out"
  | "outlines_left_out";

export interface DxfNote {
  code: DxfNoteCode;
  name: string | null;
  count: number;
}

/** All lengths are in the unit of the file. Points of lines, outlines and texts are relative to `origin`. */
export interface DxfDrawing {
  /** Such as "AC1015". */
  version: string;
  /** Those with something in model space, by name. */
  layers: SheetLayer[];
  /** x0, y0, x1, y1 of each line. */
  segments: Float32Array;
  /** The layer of each line. */
  layerOf: Uint16Array;
  outlines: DxfOutline[];
  texts: DxfText[];
  /** The lower left corner of the extents. */
  origin: [number, number];
  /** Of the extents. */
  size: [number, number];
  /** By the header; null if it names none. */
  unit: string | null;
  measurement: "metric" | "imperial" | null;
  notes: DxfNote[];
}

export interface DxfLimits {
  bytes: number;
  /** Lines after the expansion of blocks. */
  lines: number;
  texts: number;
  outlines: number;
  /** Corners of all outlines together. */
  corners: number;
}

export const dxfLimits: DxfLimits = {
  bytes: 200e6,
  lines: 2e6,
  texts: 200_000,
  outlines: 100_000,
  corners: 1_000_000,
};
