// Traced outlines of rooms, holes and zones.

import type { EditBuilder } from "../document/edit";
import { isObject, valueAt, type Json, type JsonObject } from "../document/json";
import type { Point } from "../document/messages";
import { boundsOf, rectangle } from "../geometry/bounds";
import { elementsOf } from "../elements/kinds";
import { minus } from "../geometry/vector";
import { freeId, inFile, pointInFile, type Site } from "./site";

const usualHeight = 3; // m
const square = 1e-4; // m

/** Whether nothing has a place but the room and what refers to it. */
export const isBare = (json: Json): boolean =>
  valueAt(json, "/room/holes") === undefined &&
  elementsOf(json).every(({ kind, value }) => kind === "room" || (kind === "area" && !Array.isArray(value.area)));

/** The rectangle parallel to the axes that the corners are; null: they are none. */
function upright(corners: readonly Point[]): { lower: Point; upper: Point } | null {
  const bounds = boundsOf(corners);
  if (corners.length !== 4 || !bounds) return null;
  const near = (a: Point, b: Point) => Math.hypot(...minus(a, b)) < square;
  return rectangle(bounds).every((corner) => corners.some((other) => near(corner, other))) ? bounds : null;
}

function materialsOf(room: JsonObject): JsonObject {
  const { floor, ceiling, walls } = room;
  return { floor, ceiling, walls: isObject(walls) ? walls.x0 : walls };
}

function heightOf(site: Site, room: JsonObject): Json {
  if (Array.isArray(room.size)) return room.size[2];
  return room.height ?? inFile(site, usualHeight);
}

/**
 * Gives the room another outline, and returns the place that becomes the origin: the lower left corner of the first room
 * that is traced, so that the coordinates of the shop begin at 0, and later the origin itself. Doors and windows of the
 * old walls, and their materials, go with them.
 */
export function setRoom(builder: EditBuilder, site: Site, corners: readonly Point[]): Point {
  const old = valueAt(builder.json, "/room");
  const room = isObject(old) ? old : {};
  const bounds = boundsOf(corners);
  const origin: Point = bounds && isBare(builder.json) ? bounds.lower : [0, 0];
  const placed = corners.map((corner) => minus(corner, origin));
  const box = upright(placed);
  const height = heightOf(site, room);
  const isBox =
    room.holes === undefined && box !== null && Math.hypot(...box.lower) < square && typeof height === "number";
  const shape: JsonObject = isBox
    ? { size: [...(pointInFile(site, box.upper) as number[]), height] }
    : { outline: placed.map((corner) => pointInFile(site, corner)), height };
  const { zones, inner_walls, holes } = room;
  const kept = Object.fromEntries(
    Object.entries({ holes, zones, inner_walls }).filter(([, list]) => list !== undefined),
  );
  builder.set("/room", { ...shape, ...materialsOf(room), ...kept } as JsonObject);
  return origin;
}

/** Whether another outline loses something of the old walls. */
export const losesWalls = (json: Json): boolean =>
  ["openings", "wall_materials"].some((key) => valueAt(json, `/room/${key}`) !== undefined);

/** A shaft or courtyard. A box becomes an outline first, because only outlines have holes. */
export function addHole(builder: EditBuilder, site: Site, corners: readonly Point[]): void {
  const size = builder.get("/room/size");
  if (Array.isArray(size)) {
    const [x, y, z] = size as number[];
    const { size: _, ...others } = builder.get("/room") as JsonObject;
    const walls = isObject(others.walls) ? others.walls.x0 : others.walls;
    const outline = rectangle({ lower: [0, 0], upper: [x, y] });
    builder.set("/room", { outline, height: z, ...others, walls });
  }
  builder.append(
    "/room/holes",
    corners.map((corner) => pointInFile(site, corner)),
  );
}

/** A part of the room with a lower ceiling. The result is its path. */
export function addZone(builder: EditBuilder, site: Site, corners: readonly Point[], height: number): string {
  return builder.append("/room/zones", {
    id: freeId(site, "Z"),
    polygon: corners.map((corner) => pointInFile(site, corner)),
    height: inFile(site, height),
  });
}
