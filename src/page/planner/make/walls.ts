// Walls that are drawn as lines, and the doors and windows in them.

import type { EditBuilder } from "../document/edit";
import { pointerTo, valueAt } from "../document/json";
import type { Point } from "../document/messages";
import { rectangle } from "../geometry/bounds";
import { nearestOn, signedArea } from "../geometry/polygon";
import { stepped } from "../geometry/units";
import { distance, dot, minus, times } from "../geometry/vector";
import { freeId, inFile, pointInFile, type Site } from "./site";

export function addWalls(builder: EditBuilder, site: Site, line: readonly Point[], thickness: number): string[] {
  const taken = new Set(site.taken);
  return line.slice(1).map((to, k) => {
    const id = freeId({ ...site, taken }, "W");
    taken.add(id);
    return builder.append("/room/inner_walls", {
      id,
      from: pointInFile(site, line[k]),
      to: pointInFile(site, to),
      thickness: inFile(site, thickness),
    });
  });
}

/** A wall as a line, with the list of its openings. */
export interface WallLine {
  from: Point;
  to: Point;
  list: string;
  /** The number of an outer wall; null: an inner wall. */
  number: number | null;
  /** The room is to its right. */
  isClockwise?: boolean;
}

/** All walls, outer ones in the order of their numbers. */
export function wallLines({ json, unit }: Pick<Site, "json" | "unit">): WallLine[] {
  const inMetres = (value: unknown): Point => {
    const [x, y] = value as number[];
    return [x * unit.factor, y * unit.factor];
  };
  const size = valueAt(json, "/room/size") as number[] | undefined;
  const outline = size
    ? rectangle({ lower: [0, 0], upper: inMetres(size) })
    : ((valueAt(json, "/room/outline") ?? []) as number[][]).map(inMetres);
  const outer = outline.map((from, number) => ({
    from,
    to: outline[(number + 1) % outline.length],
    list: "/room/openings",
    number,
    isClockwise: signedArea(outline) < 0,
  }));
  const walls = (valueAt(json, "/room/inner_walls") ?? []) as Record<string, unknown>[];
  const inner = walls.map(({ from, to }, k) => ({
    from: inMetres(from),
    to: inMetres(to),
    list: pointerTo("/room/inner_walls", k, "openings"),
    number: null,
  }));
  return [...outer, ...inner];
}

/** The wall that both ends of a line are nearest to, within a reach; null: there is none. */
export function wallNear(walls: readonly WallLine[], [a, b]: readonly [Point, Point], reach: number): WallLine | null {
  let [found, least] = [null as WallLine | null, Infinity];
  const awayOf = ({ from, to }: WallLine, point: Point) => distance(nearestOn(from, to, point), point);
  for (const wall of walls) {
    const away = awayOf(wall, a) + awayOf(wall, b);
    if (awayOf(wall, a) <= reach && away < least) [found, least] = [wall, away];
  }
  return found;
}

/** How far along a wall a point is, m. */
export function along({ from, to }: WallLine, point: Point): number {
  const way = minus(to, from);
  const length = Math.hypot(...way);
  return Math.min(Math.max(dot(minus(point, from), times(way, 1 / (length || 1))), 0), length);
}

export interface OpeningForm {
  bottom: number;
  top: number;
  /** Of the pane or the door leaf. */
  material?: string;
}

/** A door or window between two points near a wall, at whole steps unless its width was typed. */
export function addOpening(
  builder: EditBuilder,
  site: Site,
  wall: WallLine,
  [a, b]: readonly [Point, Point],
  { bottom, top, material }: OpeningForm,
  isExact = false,
): string {
  const { unit } = site;
  const round = (metres: number) => (isExact ? metres : stepped(metres / unit.factor, unit) * unit.factor);
  const [from, until] = [along(wall, a), along(wall, b)].map(round).sort((one, other) => one - other);
  const isOuter = wall.number !== null;
  return builder.append(wall.list, {
    ...(isOuter ? { wall: wall.number } : {}),
    at: inFile(site, from),
    width: inFile(site, until - from),
    ...(bottom > 0 ? { bottom: inFile(site, bottom) } : {}),
    top: inFile(site, top),
    ...(material === undefined ? {} : { [isOuter ? "material" : "pane"]: material }),
  });
}
