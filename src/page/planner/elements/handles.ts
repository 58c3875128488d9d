// The handles by which an element changes its size: edges and corners of rectangles, corners and edges of outlines.

import { isObject, pointerTo, valueAt, type Json, type JsonObject } from "../document/json";
import type { Part, Point } from "../document/messages";
import { rectangle } from "../geometry/bounds";
import { outlineOf } from "../geometry/rigid";
import type { LengthUnit } from "../geometry/units";
import { between, directionOf, minus, times } from "../geometry/vector";
import type { StoreElement } from "./kinds";

export interface Handle {
  /** Sides of a rectangle: x0, x1, y0, y1 or two of them; or vertex:/pointer, or edge:/pointer/k. */
  id: string;
  at: Point;
  /** The direction in which it moves, degrees; null: any. */
  way: number | null;
  isCorner: boolean;
  /** The angle at which it is drawn, degrees. */
  turn: number;
}

/** The rectangle of an element, in m; null if its size is not that of a rectangle. */
export interface Frame {
  at: Point;
  rotation: number;
  length: number;
  depth: number;
  /** The sides that can move. */
  sides: string[];
}

const allSides = ["x0", "x1", "y0", "y1"];

function boxFrame(min: Json, max: Json, { factor }: LengthUnit): Frame {
  const [a, b] = [min, max] as number[][];
  return {
    at: [a[0] * factor, a[1] * factor],
    rotation: 0,
    length: (b[0] - a[0]) * factor,
    depth: (b[1] - a[1]) * factor,
    sides: allSides,
  };
}

export function frameOf({ kind, value }: StoreElement, part: Part | undefined, unit: LengthUnit): Frame | null {
  if (kind === "room")
    return Array.isArray(value.size) ? { ...boxFrame([0, 0], value.size, unit), sides: ["x1", "y1"] } : null;
  if (kind !== "fixture")
    return Array.isArray(value.min) && Array.isArray(value.max) ? boxFrame(value.min, value.max, unit) : null;
  if (Array.isArray(value.min) && Array.isArray(value.max)) return boxFrame(value.min, value.max, unit);
  if (part?.type === "cylinder" && Array.isArray(value.at) && typeof value.radius === "number") {
    const [x, y] = value.at as number[];
    const r = value.radius;
    return boxFrame([x - r, y - r], [x + r, y + r], unit);
  }
  if (!part?.footing || part.type === "mesh") return null;
  return { ...part.footing, sides: isObject(value.against) ? ["x0", "x1", "y0"] : allSides };
}

/** The lists of corners of an element, and whether they are closed. */
export function cornerLists(value: JsonObject): { pointer: string; isOpen: boolean; count: number }[] {
  const keys: [string, boolean][] = [
    ["polygon", false],
    ["outline", false],
    ["area", false],
    ["points", true],
    ["corners", true],
  ];
  const found = keys.flatMap(([key, isOpen]) => {
    const list = value[key];
    return Array.isArray(list) ? [{ pointer: pointerTo("", key), isOpen, count: list.length }] : [];
  });
  const holes = Array.isArray(value.holes) ? value.holes : [];
  return [
    ...found,
    ...holes.map((hole, k) => ({ pointer: `/holes/${k}`, isOpen: false, count: (hole as Json[]).length })),
  ];
}

function frameHandles(frame: Frame): Handle[] {
  const corners = outlineOf(frame);
  const [a, b, c, d] = corners;
  const edges: [string, Point, number][] = [
    ["x0", between(a, d), frame.rotation],
    ["x1", between(b, c), frame.rotation],
    ["y0", between(a, b), frame.rotation + 90],
    ["y1", between(c, d), frame.rotation + 90],
  ];
  const pairs: [string, string, Point, number][] = [
    ["x0", "y0", a, 45],
    ["x1", "y0", b, 135],
    ["x1", "y1", c, 45],
    ["x0", "y1", d, 135],
  ];
  const can = (side: string) => frame.sides.includes(side);
  return [
    ...edges
      .filter(([side]) => can(side))
      .map(([id, at, way]) => ({ id, at, way, isCorner: false, turn: frame.rotation })),
    ...pairs
      .filter(([x, y]) => can(x) && can(y))
      .map(([x, y, at, way]) => ({
        id: `${x} ${y}`,
        at,
        way: frame.rotation + way,
        isCorner: true,
        turn: frame.rotation,
      })),
  ];
}

function cornerHandles(value: JsonObject, { factor }: LengthUnit): Handle[] {
  const point = (pointer: string) => times((valueAt(value, pointer) as number[]).slice(0, 2) as Point, factor);
  const vertex = (pointer: string): Handle => ({
    id: `vertex:${pointer}`,
    at: point(pointer),
    way: null,
    isCorner: true,
    turn: 45,
  });
  const ends = ["from", "to"].filter((key) => Array.isArray(value[key])).map((key) => vertex(pointerTo("", key)));
  return [
    ...ends,
    ...cornerLists(value).flatMap(({ pointer, isOpen, count }) => {
      const corners = Array.from({ length: count }, (_, k) => pointerTo(pointer, k));
      const edges = isOpen
        ? []
        : corners.map((corner, k): Handle => {
            const [a, b] = [point(corner), point(corners[(k + 1) % count])];
            const turn = directionOf(minus(b, a));
            return { id: `edge:${corner}`, at: between(a, b), way: turn + 90, isCorner: false, turn };
          });
      return [...corners.map(vertex), ...edges];
    }),
  ];
}

/** The outline of a frame, for a drawing that follows the pointer. */
export const frameOutline = (frame: Frame): Point[] =>
  frame.rotation === 0
    ? rectangle({ lower: frame.at, upper: [frame.at[0] + frame.length, frame.at[1] + frame.depth] })
    : outlineOf(frame);

export function handlesOf(element: StoreElement, part: Part | undefined, unit: LengthUnit): Handle[] {
  const frame = frameOf(element, part, unit);
  if (frame) return frameHandles(frame);
  if (element.kind === "fixture" && part?.type === "mesh") return [];
  return cornerHandles(element.value, unit);
}
