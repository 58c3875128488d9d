// The picture of the floor plan, as the store names it under `drawing`. Places in the picture are pixels, x to the right
// and y downwards, points of a PDF page or units of a DXF drawing; lengths are in the unit of the store.

import { isObject, valueAt, type Json } from "../document/json";
import type { Point } from "../document/messages";
import { distance } from "../geometry/vector";

/** A line of the picture whose length is known. */
export interface Line {
  from: Point;
  to: Point;
  length: number;
}

export interface Drawing {
  /** Beneath the folder of the project. */
  file: string;
  /** Of a PDF file, from 1. */
  page?: number;
  /** The unit of length of a DXF drawing; a scale comes before it. */
  unit?: string;
  /** The lower left corner of the picture in the coordinates of a DXF file. */
  origin?: Point;
  /** The pixels that all places refer to. */
  size: Point;
  /** The lower left corner of the picture in the plan. */
  at: Point;
  scale?: Line;
  /** A second length, in another direction. */
  check?: Line;
  /** Counter-clockwise, about the lower left corner. */
  rotation_deg?: number;
  /** Left, upper, right and lower side of the part that is shown. */
  crop?: [number, number, number, number];
}

/** Whether a file has lines instead of pixels. */
export const hasLines = (file: string): boolean => /\.(pdf|dxf)$/i.test(file);

export const drawingPath = "/drawing";

const numbersOf = (value: Json | undefined, count: number): number[] | null =>
  Array.isArray(value) && value.length === count && value.every((number) => Number.isFinite(number))
    ? (value as number[])
    : null;

function lineOf(value: Json | undefined): Line | undefined {
  if (!isObject(value)) return undefined;
  const [from, to] = [value.from, value.to].map((point) => numbersOf(point, 2) as Point | null);
  const { length } = value;
  if (!from || !to || typeof length !== "number" || length <= 0 || distance(from, to) === 0) return undefined;
  return { from, to, length };
}

/** Null without a picture. Values that the store reader refuses count as missing. */
export function drawingOf(json: Json): Drawing | null {
  const value = valueAt(json, drawingPath);
  if (!isObject(value)) return null;
  const size = numbersOf(value.size, 2);
  if (typeof value.file !== "string" || !size || Math.min(...size) <= 0) return null;
  const [left, upper, right, lower] = numbersOf(value.crop, 4) ?? [0, 0, 0, 0];
  return {
    file: value.file,
    page: typeof value.page === "number" ? value.page : undefined,
    unit: typeof value.unit === "string" ? value.unit : undefined,
    origin: (numbersOf(value.origin, 2) as Point | null) ?? undefined,
    size: size as Point,
    at: (numbersOf(value.at, 2) ?? [0, 0]) as Point,
    scale: lineOf(value.scale),
    check: lineOf(value.check),
    rotation_deg: typeof value.rotation_deg === "number" ? value.rotation_deg : undefined,
    crop: left < right && upper < lower ? [left, upper, right, lower] : undefined,
  };
}
