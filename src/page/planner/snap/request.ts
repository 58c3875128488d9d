// What is known about the pointer and about the drawing in progress.

import type { Point } from "../document/messages";
import { directionOf, minus, unitAt } from "../geometry/vector";
import type { Snapped } from "./choice";
import { lineAlong, type Line } from "./lines";

export interface SnapRequest {
  pointer: Point;
  /** m on the plan of the pixels from which places attract. */
  reach: number;
  /** The corners so far. The last one is the beginning of the edge that ends at the pointer. */
  drawn?: readonly Point[];
  /** Whether the drawing can end at its first corner. */
  closes?: boolean;
  /** Whether the last corner and the pointer are opposite corners of a rectangle in the frame. */
  isBox?: boolean;
  /** The main direction of the room, degrees. */
  frame?: number;
  /** Nothing attracts. */
  isFree?: boolean;
  /** Only multiples of 15 degrees to the previous edge, or to the frame. */
  isOrtho?: boolean;
  /** Typed: m. */
  length?: number;
  /** Typed: degrees, counter-clockwise from x. */
  angle?: number;
  /** The result for the place of the pointer before. */
  held?: Snapped;
}

const step = 15; // degrees

export const fromOf = ({ drawn = [] }: SnapRequest): Point | undefined => drawn.at(-1);

/** The half-line on which a typed angle or Shift keeps the pointer. */
export function rayOf(request: SnapRequest): Line | null {
  const { pointer, drawn = [], angle, isOrtho, frame = 0 } = request;
  const from = fromOf(request);
  if (!from || (angle === undefined && !isOrtho)) return null;
  const previous = drawn.at(-2);
  const base = previous ? directionOf(minus(from, previous)) : frame;
  const turned = Math.round((directionOf(minus(pointer, from)) - base) / step) * step;
  return lineAlong(from, unitAt(angle ?? base + turned), 0);
}
