// Fixtures along a line: rows of shelving, wall shelving, freezers, tables and check-outs.

import type { EditBuilder } from "../document/edit";
import { valueAt, type Json, type JsonObject } from "../document/json";
import type { Point } from "../document/messages";
import { directionOf, distance, dot, minus, plus, times, unitAt, wholeTurn } from "../geometry/vector";
import { along, type WallLine } from "./walls";
import { firstFree, followIds, namesOf } from "../elements/row_ids";
import { inFile, type Site } from "./site";
import type { LengthUnit } from "../geometry/units";

/** What a fixture is made of. */
export interface Template {
  /** The name of its preset; null: it has none. */
  preset: string | null;
  /** Its keys beside those of the preset and those of its place. */
  own: JsonObject;
  /** All its keys, in the unit of the store. */
  effective: JsonObject;
  /** Ids begin with it; null: with a letter for the type. */
  prefix: string | null;
  /** m; null: the fixture is as long as the line. */
  module: number | null;
  /** Of the preset alone. */
  base: Size | null;
}

/** m */
export interface Size {
  length: number;
  depth: number;
  height: number;
}

const clinging = 1; // m from a wall
const parallel = 8; // degrees

/** m; null for fixtures that are not rectangles. */
export function sizeOf(effective: JsonObject, { factor }: LengthUnit): Size | null {
  const metres = (pointer: string) => Number(valueAt(effective, pointer)) * factor;
  const size =
    effective.size === undefined
      ? { length: metres("/length"), depth: metres("/depth"), height: metres("/height") }
      : { length: metres("/size/0"), depth: metres("/size/1"), height: metres("/size/2") };
  return Object.values(size).every((value) => value > 0) ? size : null;
}

/** Whether goods and labels are on one side alone, so that the other one stands against a wall. */
export function isOneSided({ type, faces }: JsonObject): boolean {
  return type === "gondola" && Array.isArray(faces) && faces.length === 1 && faces[0] === "front";
}

export interface Run {
  /** The corner with minimum x and y before rotation, m. */
  at: Point;
  /** Degrees. */
  rotation: number;
  length: number;
  depth: number;
  /** Of fixtures with labels at fixed places, which cannot be longer. */
  count: number;
  /** The outer wall that it stands against, and how far along it, m. */
  against: { wall: number; from: number } | null;
}

/** The outer wall along which a line runs at a distance that means "at the wall". */
function wallAlong(walls: readonly WallLine[], from: Point, to: Point): WallLine | null {
  const way = minus(to, from);
  const near = walls.filter((wall) => {
    const turn = Math.abs(((directionOf(minus(wall.to, wall.from)) - directionOf(way) + 270) % 180) - 90);
    const middle = times(plus(from, to), 0.5);
    const reached = along(wall, middle);
    const length = distance(wall.from, wall.to);
    const foot = plus(wall.from, times(minus(wall.to, wall.from), reached / (length || 1)));
    return turn < parallel && reached > 0 && reached < length && distance(foot, middle) <= clinging;
  });
  const away = (wall: WallLine) => Math.abs(offLine(wall, from)) + Math.abs(offLine(wall, to));
  const [nearest] = near.sort((a, b) => away(a) - away(b));
  return nearest?.number == null ? null : nearest; // behind an inner wall, the outer one is not meant
}

function offLine({ from, to }: WallLine, point: Point): number {
  const way = minus(to, from);
  const [x, y] = times(way, 1 / (Math.hypot(...way) || 1));
  return dot(minus(point, from), [-y, x]);
}

/**
 * The modules along a line: the middle line of a fixture with two sides, and the back of one with a front alone, which
 * faces the right of the line or away from the wall near it. `isExact`: it is as long as the line. `isFree`: it clings to
 * no wall.
 */
export function runAlong(
  { unit }: Pick<Site, "unit">,
  { effective, module }: Template,
  walls: readonly WallLine[],
  [from, to]: readonly [Point, Point],
  { isExact = false, isFree = false } = {},
): Run | null {
  const size = sizeOf(effective, unit);
  const drawn = distance(from, to);
  if (!size || drawn === 0) return null;
  const isFixed = module !== null && Array.isArray(effective.labels);
  const modules = module === null ? 1 : Math.max(1, Math.round(drawn / module));
  const length = module === null || (isExact && !isFixed) ? drawn : modules * module;
  const count = isFixed ? modules : 1;
  const { depth } = size;
  const isSingle = isOneSided(effective);
  const wall = isSingle && !isFree ? wallAlong(walls, from, to) : null;
  if (wall?.number != null) return runAgainst(wall, [from, to], { length, depth, count });
  const rotation = wholeTurn(directionOf(minus(to, from)));
  const across = unitAt(rotation + 90);
  const at = minus(from, times(across, isSingle ? depth : 0.5 * depth));
  return { at, rotation, length, depth, count, against: null };
}

function runAgainst(
  wall: WallLine,
  [from, to]: readonly [Point, Point],
  { length, depth, count }: Pick<Run, "length" | "depth" | "count">,
): Run {
  const whole = distance(wall.from, wall.to);
  // The end where the line begins stays there.
  const [begin, end] = [along(wall, from), along(wall, to)];
  const first = begin <= end ? begin : begin - length;
  const start = Math.min(Math.max(first, 0), Math.max(whole - length, 0));
  const direction = directionOf(minus(wall.to, wall.from));
  const way = unitAt(direction);
  // The room is to the left of its walls, or to the right if its outline runs clockwise.
  return {
    at: plus(wall.from, times(way, wall.isClockwise ? start + length : start)),
    rotation: wholeTurn(wall.isClockwise ? direction + 180 : direction),
    length,
    depth,
    count,
    against: { wall: wall.number ?? 0, from: start },
  };
}

const prefixes: Record<string, string> = { gondola: "G", freezer: "F", box: "B", mesh: "M" };

export function addRun(builder: EditBuilder, site: Site, template: Template, run: Run): string {
  const { effective, preset, own, prefix, base } = template;
  const stem = prefix ?? prefixes[String(effective.type)] ?? "E";
  const { count } = run;
  const first = firstFree(site.taken, `${stem}{n}`, count);
  const id = count > 1 ? `${stem}{n}` : `${stem}${first}`;
  const length = inFile(site, run.length / count);
  const [x, y] = run.at.map((value) => inFile(site, value));
  const size = effective.size as number[] | undefined;
  const lengthened: Json = size ? [length, size[1], size[2]] : null;
  const isUsual =
    base !== null &&
    inFile(site, base.length) === length &&
    (!size || (inFile(site, base.depth) === size[1] && inFile(site, base.height) === size[2]));
  const lengths: JsonObject = size ? { size: lengthened } : { length };
  const place: JsonObject = run.against
    ? { against: { wall: run.against.wall, from: inFile(site, run.against.from) } }
    : { at: size ? [x, y, 0] : [x, y], ...turned(run.rotation) };
  return builder.append("/fixtures", {
    ...(preset === null ? {} : { preset }),
    ...own,
    id,
    ...place,
    ...(isUsual ? {} : lengths),
    ...(count > 1 ? { repeat: { count, step: length, ...(first === 1 ? {} : { first }) } } : {}),
  });
}

function turned(rotation: number): JsonObject {
  const degrees: Json = Number(rotation.toFixed(3));
  return degrees === 0 || degrees === 360 ? {} : { rotation_deg: degrees };
}

/** "6 rows every 2.4 m": copies of a fixture, which stay one element. `step`: m. What names the fixture follows. */
export function setRows(builder: EditBuilder, site: Site, path: string, count: number, step: Point): void {
  const id = builder.get(`${path}/id`);
  if (typeof id === "string") {
    const [, stem, digits] = /^(.*?)(\d*)$/s.exec(id) as unknown as [string, string, string];
    const isRow = id.includes("{n}");
    const pattern = isRow ? id : `${stem}{n}`;
    const before = (builder.get(`${path}/repeat/first`) as number | undefined) ?? 1;
    const own = isRow ? namesOf(pattern, before, Number(builder.get(`${path}/repeat/count`) ?? 1)) : [id];
    const others = new Set([...site.taken].filter((name) => !own.includes(name)));
    const first = firstFree(others, pattern, count, isRow ? before : Math.max(Number(digits), 1));
    builder.set(`${path}/id`, pattern);
    if (first !== before) builder.set(`${path}/repeat`, { ...(builder.get(`${path}/repeat`) as JsonObject), first });
    followIds(builder, new Map(own.map((name, k) => [name, pattern.replace("{n}", String(first + k))])));
  }
  builder.set(`${path}/repeat/count`, count);
  builder.set(
    `${path}/repeat/step`,
    step.map((value) => inFile(site, value)),
  );
}

/** The distances of all rows, in the unit of the store. */
export function rowSteps(json: Json): number[] {
  const fixtures = (valueAt(json, "/fixtures") ?? []) as JsonObject[];
  const steps = fixtures.map((fixture) => valueAt(fixture, "/repeat/step"));
  return steps.flatMap((step) =>
    Array.isArray(step) ? [Math.hypot(...(step as number[]))] : typeof step === "number" ? [Math.abs(step)] : [],
  );
}
