// Rails below the ceiling that are drawn as lines.

import type { EditBuilder } from "../document/edit";
import { isObject, valueAt, type Json } from "../document/json";
import type { Point } from "../document/messages";
import { contains } from "../geometry/polygon";
import { between, distance, times } from "../geometry/vector";
import { inFile, pointInFile, type Site } from "./site";

const step = 0.25; // m between places where the ceiling is looked at

/** A height is a number, or three points of a slope; in the unit of the file, as is the place. */
function heightAt(height: Json | undefined, [x, y]: Point): number | null {
  if (typeof height === "number") return height;
  if (!Array.isArray(height) || height.length !== 3) return null;
  const [a, b, c] = height as number[][];
  const [ux, uy, uz, vx, vy, vz] = [b, c].flatMap((corner) => corner.map((value, axis) => value - a[axis]));
  const square = ux * vy - uy * vx;
  if (square === 0) return null;
  const s = ((x - a[0]) * vy - (y - a[1]) * vx) / square;
  const t = (ux * (y - a[1]) - uy * (x - a[0])) / square;
  return a[2] + s * uz + t * vz;
}

/** The height of the ceiling over a place, m; null without a room. */
export function ceilingAt({ json, unit }: Pick<Site, "json" | "unit">, place: Point): number | null {
  const point = times(place, 1 / unit.factor);
  const zones = (valueAt(json, "/room/zones") ?? []) as Json[];
  const zone = zones.find((one) => isObject(one) && contains((one.polygon ?? []) as Point[], point));
  const height = zone ? valueAt(zone, "/height") : (valueAt(json, "/room/size/2") ?? valueAt(json, "/room/height"));
  const found = heightAt(height, point);
  return found === null ? null : found * unit.factor;
}

/** Points along a line, not far from each other. */
const along = (line: readonly Point[]): Point[] =>
  line.slice(1).flatMap((to, k) => {
    const pieces = Math.max(Math.ceil(distance(line[k], to) / step), 1);
    return Array.from({ length: pieces + 1 }, (_, n) => between(line[k], to, n / pieces));
  });

export interface RailForm {
  id: string;
  type: string;
  /** m */
  below: number;
  spacing: number;
}

/** A horizontal rail, below the lowest ceiling that it passes; null without a room. */
export function addRail(
  builder: EditBuilder,
  site: Site,
  line: readonly Point[],
  { id, type, below, spacing }: RailForm,
): string | null {
  const heights = along(line).flatMap((place) => ceilingAt(site, place) ?? []);
  if (heights.length === 0) return null;
  const z = inFile(site, Math.min(...heights) - below);
  return builder.append("/transceivers/rails", {
    type,
    id,
    points: line.map((point) => [...(pointInFile(site, point) as number[]), z]),
    spacing: inFile(site, spacing),
  });
}
