// A line or outline that is being drawn, without anything of the page.

import type { Point } from "../document/messages";
import { edgesOf } from "../geometry/polygon";
import { distance } from "../geometry/vector";
import { selfCrossings } from "../snap/crossings";
import { formOf, type DrawTool } from "./tools";

/** Points closer than this are one. */
const samePlace = 1e-3; // m

export interface Stroke {
  tool: DrawTool;
  /** Set corners, m. */
  points: readonly Point[];
  /** The edges that a refused corner would make cross. */
  crossings: readonly (readonly [Point, Point])[];
}

/** A stroke that continues, or the corners of a finished one. */
export type Step = { stroke: Stroke } | { done: readonly Point[] };

export const begin = (tool: DrawTool, points: readonly Point[] = []): Stroke => ({ tool, points, crossings: [] });

export const lastOf = ({ points }: Stroke): Point | undefined => points[points.length - 1];

function crossingEdges(points: readonly Point[], isClosed: boolean): [Point, Point][] {
  const edges = edgesOf(points, !isClosed);
  const found = new Set(selfCrossings(points, isClosed).flat());
  return edges.filter((_, k) => found.has(k));
}

/** Sets a corner. A corner on the last one ends the stroke, one on the first closes an outline. */
export function addPoint(stroke: Stroke, at: Point): Step {
  const { points, tool } = stroke;
  const form = formOf[tool];
  if (form === "point") return { done: [at] };
  const last = lastOf(stroke);
  if (last && distance(last, at) < samePlace) return points.length > 1 ? end(stroke) : { stroke };
  if (form === "outline" && points.length > 2 && distance(points[0], at) < samePlace) return end(stroke);
  const next = [...points, at];
  if (form === "outline") {
    const crossings = crossingEdges(next, false);
    if (crossings.length > 0) return { stroke: { ...stroke, crossings } };
  }
  if (form === "segment" && next.length === 2) return { done: next };
  return { stroke: { ...stroke, points: next, crossings: [] } };
}

/** Ends a stroke: closes an outline, unless its edges would cross. Too few corners are none. */
export function end(stroke: Stroke): Step {
  const { points, tool } = stroke;
  const isOutline = formOf[tool] === "outline";
  if (points.length < (isOutline ? 3 : 2)) return { stroke: begin(tool) };
  const crossings = isOutline ? crossingEdges(points, true) : [];
  return crossings.length > 0 ? { stroke: { ...stroke, crossings } } : { done: points };
}

/** Takes the last corner back. */
export const back = (stroke: Stroke): Stroke => ({ ...stroke, points: stroke.points.slice(0, -1), crossings: [] });

/** The corners of a rectangle from one corner to the opposite one, in a frame at an angle to the plan, degrees. */
export function rectangleBetween(a: Point, b: Point, frame = 0): Point[] {
  const angle = (frame * Math.PI) / 180;
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const [x, y] = [b[0] - a[0], b[1] - a[1]];
  const [u, v] = [c * x + s * y, c * y - s * x];
  return [a, [a[0] + c * u, a[1] + s * u], b, [a[0] - s * v, a[1] + c * v]];
}

/** What a drag from one point to another draws: a rectangle or a single line. */
export function dragged({ tool }: Stroke, from: Point, to: Point, frame = 0): readonly Point[] | null {
  if (formOf[tool] !== "outline") return distance(from, to) < samePlace ? null : [from, to];
  const corners = rectangleBetween(from, to, frame);
  const isFlat = distance(corners[0], corners[1]) < samePlace || distance(corners[1], corners[2]) < samePlace;
  return isFlat ? null : corners;
}
