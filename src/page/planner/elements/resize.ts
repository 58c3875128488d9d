// Changes the size of an element: the dragged side or corner moves, the opposite one stays.

import type { EditBuilder } from "../document/edit";
import { isObject, pointerTo, splitPointer, valueAt, type JsonObject } from "../document/json";
import type { Part, Point } from "../document/messages";
import { stepped, tidy, type LengthUnit } from "../geometry/units";
import { dot, minus, plus, times, unitAt } from "../geometry/vector";
import type { Context } from "./context";
import { frameOf, frameOutline, type Frame } from "./handles";

const least = 0.05; // m

/** A side moves so that the length between it and the opposite side is a multiple of the unit's step. */
function movedSide(low: boolean, size: number, to: number, unit: LengthUnit): number {
  const wanted = low ? size - to : to;
  return Math.max(stepped(wanted / unit.factor, unit) * unit.factor, least);
}

export function resizedFrame(frame: Frame, id: string, to: Point, unit: LengthUnit): Frame {
  const [u, v] = [unitAt(frame.rotation), unitAt(frame.rotation + 90)];
  const arm = minus(to, frame.at);
  const sides = id.split(" ");
  let { at, length, depth } = frame;
  for (const side of sides) {
    const isLow = side.endsWith("0");
    if (side.startsWith("x")) {
      const size = movedSide(isLow, length, dot(arm, u), unit);
      if (isLow) at = plus(at, times(u, length - size));
      length = size;
    } else {
      const size = movedSide(isLow, depth, dot(arm, v), unit);
      if (isLow) at = plus(at, times(v, depth - size));
      depth = size;
    }
  }
  return { ...frame, at, length, depth };
}

/** How the frame of an element changes `from` or `shift` of a fixture against something. */
function slid(before: Frame, after: Frame, part: Part, against: JsonObject, unit: LengthUnit): [string, number] | null {
  const along = part.against?.along;
  if (!along) return null;
  const u = unitAt(before.rotation);
  const low = dot(minus(after.at, before.at), u);
  const high = low + after.length - before.length;
  const sign = dot(u, along) > 0 ? 1 : -1;
  const isWall = against.wall !== undefined;
  const key = isWall ? "from" : "shift";
  const way = isWall ? (sign > 0 ? low : -high) : 0.5 * sign * (low + high);
  return [key, tidy(Number(against[key] ?? 0) + way / unit.factor, unit)];
}

function writeFrame(
  builder: EditBuilder,
  { kind, path, effective, parts: [part], unit }: Context,
  before: Frame,
  after: Frame,
): void {
  const inFile = (metres: number) => tidy(metres / unit.factor, unit);
  const set = (key: string, number: number) => builder.set(pointerTo(path, key), number);
  /** Changes the first numbers of a list, which may be that of a preset. */
  const put = (key: string, ...metres: number[]) =>
    builder.set(pointerTo(path, key), [...metres.map(inFile), ...(effective[key] as number[]).slice(metres.length)]);
  if (kind === "room") put("size", after.length, after.depth);
  else if (Array.isArray(effective.min)) {
    put("min", ...after.at);
    put("max", ...plus(after.at, [after.length, after.depth]));
  } else if (part?.type === "cylinder") {
    set("radius", inFile(0.5 * after.length));
    put("at", ...plus(after.at, [0.5 * after.length, 0.5 * after.depth]));
  } else {
    if (effective.size) put("size", after.length, after.depth);
    else {
      if (after.length !== before.length) set("length", inFile(after.length));
      if (after.depth !== before.depth) set("depth", inFile(after.depth));
    }
    const place = isObject(effective.against) && part ? slid(before, after, part, effective.against, unit) : null;
    if (place) builder.set(pointerTo(path, "against", place[0]), place[1]);
    else if (Array.isArray(effective.at)) put("at", ...after.at);
  }
}

/** Cylinders stay round: the other side follows the one that moves. */
function round(before: Frame, after: Frame): Frame {
  const size = after.length !== before.length ? after.length : after.depth;
  const [grownX, grownY] = [size - after.length, size - after.depth];
  return { ...after, at: minus(after.at, [0.5 * grownX, 0.5 * grownY]), length: size, depth: size };
}

function dragCorner(builder: EditBuilder, { path, effective, unit }: Context, id: string, to: Point): void {
  const [what, pointer] = id.split(":");
  const [list, index] = splitPointer(pointer);
  if (list !== "" && builder.get(path + list) === undefined) builder.set(path + list, valueAt(effective, list));
  const point = (at: string) => (valueAt(effective, at) as number[]).slice(0, 2) as Point;
  const set = (at: string, place: Point) =>
    place.forEach((coordinate, axis) => {
      builder.set(`${path}${at}/${axis}`, tidy(coordinate, unit));
    });
  const target = times(to, 1 / unit.factor);
  if (what === "vertex") {
    set(pointer, target.map((coordinate) => stepped(coordinate, unit)) as Point);
    return;
  }
  const count = (valueAt(effective, list) as unknown[]).length;
  const next = pointerTo(list, (Number(index) + 1) % count);
  const [a, b] = [point(pointer), point(next)];
  const way = minus(b, a);
  const size = Math.hypot(...way) || 1;
  const normal: Point = [-way[1] / size, way[0] / size];
  const shift = times(normal, stepped(dot(minus(target, a), normal), unit));
  set(pointer, plus(a, shift));
  set(next, plus(b, shift));
}

/** The frame before and after the change; null if corners change instead. */
export interface Resized {
  before: Frame;
  after: Frame;
}

/** Writes the change of a handle that is dragged to a place, in m. */
export function resize(builder: EditBuilder, context: Context, id: string, to: Point): Resized | null {
  const [part] = context.parts;
  const before = frameOf({ ...context, value: context.effective }, part, context.unit);
  if (!before) {
    dragCorner(builder, context, id, to);
    return null;
  }
  const sized = resizedFrame(before, id, to, context.unit);
  const after = part?.type === "cylinder" ? round(before, sized) : sized;
  writeFrame(builder, context, before, after);
  return { before, after };
}

/** The outlines of an element's copies after a change of the first one's frame. */
export function resizedParts(parts: readonly Part[], { before, after }: Resized): Part[] {
  const toLocal = (frame: Frame) => {
    const [u, v] = [unitAt(frame.rotation), unitAt(frame.rotation + 90)];
    const arm = minus(after.at, before.at);
    return [dot(arm, u), dot(arm, v)];
  };
  const [x, y] = toLocal(before);
  return parts.map((part) => {
    if (!part.footing) return { ...part, outline: frameOutline(after) };
    const [u, v] = [unitAt(part.footing.rotation), unitAt(part.footing.rotation + 90)];
    const footing = {
      ...part.footing,
      at: plus(part.footing.at, plus(times(u, x), times(v, y))),
      length: after.length,
      depth: after.depth,
    };
    return { ...part, footing, outline: frameOutline({ ...footing, sides: [] }) };
  });
}
