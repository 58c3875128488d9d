// Moves elements: writes their positions, directions and angles after a movement of the plan.

import type { EditBuilder } from "../document/edit";
import { equal, isObject, pointerTo, tokensOf, valueAt, type Json, type JsonObject } from "../document/json";
import type { Part, Point } from "../document/messages";
import { boundsOf, middleOf } from "../geometry/bounds";
import { moved, movedPart, movedVector, shiftBy, toMiddle, type Motion } from "../geometry/rigid";
import { tidy, type LengthUnit } from "../geometry/units";
import { dot, minus, plus, times, wholeTurn } from "../geometry/vector";
import { movedAxis, movedRoll } from "./axis";
import type { Context } from "./context";
import type { StoreElement } from "./kinds";
import { shapeOf, type Shape } from "./shape";

/** Why an element stays where it is. */
export type Immovable = "room" | "follows" | "against" | "grid";

const isQuarter = (degrees: number) => Number.isInteger(degrees / 90);

/** The movement that an element makes if it is to make another one. */
export function motionOf(
  { kind, value }: StoreElement,
  part: Part | undefined,
  wanted: Motion,
): Motion | { immovable: Immovable } {
  const { fixed } = shapeOf(kind, value);
  if (fixed) return { immovable: fixed };
  const turns = wanted.turn !== 0 || wanted.mirrors;
  if (isObject(value.against) || part?.against) {
    if (turns) return { immovable: "against" };
    return part?.against ? shiftBy(times(part.against.along, dot(wanted.shift, part.against.along))) : wanted;
  }
  if (kind === "grid" && !isQuarter(wanted.turn)) return { immovable: "grid" };
  return wanted;
}

export const isImmovable = (motion: object): motion is { immovable: Immovable } => "immovable" in motion;

export const previewOf = (parts: readonly Part[], motion: Motion): Part[] =>
  parts.map((part) => movedPart(part, motion));

/** Writes values of an element; each list of numbers as a whole. */
class Writer {
  private readonly lists = new Map<string, Json>();

  constructor(
    private readonly builder: EditBuilder,
    private readonly path: string,
    readonly effective: JsonObject,
  ) {}

  /** Values that are there already, perhaps from a preset, are not written. */
  set(pointer: string, value: Json): void {
    const tokens = tokensOf(pointer);
    const listAt = tokens.findIndex((_, k) =>
      Array.isArray(valueAt(this.effective, pointerTo("", ...tokens.slice(0, k)))),
    );
    if (listAt < 0) {
      this.write(pointer, value);
      return;
    }
    const list = pointerTo("", ...tokens.slice(0, listAt));
    const whole = this.lists.get(list) ?? structuredClone(valueAt(this.effective, list) as Json);
    let inner = whole as Json[];
    for (const token of tokens.slice(listAt, -1)) inner = inner[Number(token)] as Json[];
    inner[Number(tokens[tokens.length - 1])] = value;
    this.lists.set(list, whole);
  }

  finish(): void {
    for (const [list, value] of this.lists) this.write(list, value);
  }

  private write(pointer: string, value: Json): void {
    if (!equal(valueAt(this.effective, pointer), value)) this.builder.set(this.path + pointer, value);
  }
}

/** A movement in the unit of the file. */
const inUnit = (motion: Motion, { factor }: LengthUnit): Motion => ({
  ...motion,
  shift: times(motion.shift, 1 / factor),
});

const flat = (value: Json | undefined): Point => (value as Point).slice(0, 2) as Point;

function withPlace(value: Json, [x, y]: Point, unit: LengthUnit): Json {
  return [tidy(x, unit), tidy(y, unit), ...(value as number[]).slice(2)];
}

const sixDigits = (value: number) => Number(value.toFixed(6)) + 0;

/** The middle of the first copy, in the unit of the file. */
function middleOfFirst({ parts: [part], unit, effective }: Context): Point {
  const middle = part?.footing
    ? plus(part.footing.at, toMiddle(part.footing))
    : part && boundsOf(part.outline) && middleOf(boundsOf(part.outline) as { lower: Point; upper: Point });
  return middle ? times(middle, 1 / unit.factor) : flat(effective.at);
}

/** `at` and angle of a fixture after a mirror image. */
function mirrored(context: Context, motion: Motion, writer: Writer): void {
  const { effective, unit } = context;
  const before = Number(effective.rotation_deg ?? 0);
  const after = wholeTurn(motion.turn - before + 180);
  const middle = middleOfFirst(context);
  const arm = movedVector(minus(flat(effective.at), middle), { turn: after - before, mirrors: false, shift: [0, 0] });
  writer.set("/at", withPlace(effective.at, plus(moved(middle, motion), arm), unit));
  if (after !== before) writer.set("/rotation_deg", sixDigits(after));
}

function moveRectangle({ kind, effective, unit }: Context, motion: Motion, writer: Writer, remove: () => void): void {
  const [min, max] = [effective.min, effective.max] as [number[], number[]];
  const corners: Point[] = [flat(min), [max[0], min[1]], flat(max), [min[0], max[1]]];
  const after = corners.map((corner) => moved(corner, motion));
  if (isQuarter(motion.turn)) {
    const bounds = boundsOf(after);
    if (!bounds) return;
    writer.set("/min", withPlace(min, bounds.lower, unit));
    writer.set("/max", withPlace(max, bounds.upper, unit));
    return;
  }
  remove();
  if (kind === "keep_out") {
    writer.set(
      "/polygon",
      after.map((corner) => withPlace([], corner, unit)),
    );
    return;
  }
  writer.set("/at", [...(withPlace([], after[motion.mirrors ? 3 : 0], unit) as number[]), min[2]]);
  writer.set(
    "/size",
    min.map((low, axis) => tidy(max[axis] - low, unit)),
  );
  writer.set("/rotation_deg", sixDigits(wholeTurn(motion.turn)));
}

function moveAxes(
  { axes, roll }: NonNullable<Shape["axes"]>,
  { effective }: Context,
  motion: Motion,
  writer: Writer,
): void {
  if (motion.turn === 0 && !motion.mirrors) return;
  for (const pointer of axes)
    writer.set(pointer, movedAxis(valueAt(effective, pointer) as number[], motion).map(sixDigits));
  // With several axes, one angle applies to all; it is exact for the first.
  const first = axes.length > 0 ? (valueAt(effective, axes[0]) as number[]) : [0, 0, -1];
  const before = Number(valueAt(effective, roll) ?? 0);
  const after = sixDigits(movedRoll(first, before, motion));
  if (after !== before) writer.set(roll, after);
}

/** False if it stays, because the movement is not along what the fixture stands against. */
function slide({ path, effective, parts: [part], unit }: Context, motion: Motion, builder: EditBuilder): boolean {
  const against = effective.against as JsonObject;
  const along = part?.against?.along;
  if (!along) return false;
  const way = dot(motion.shift, along) / unit.factor;
  const key = against.wall !== undefined ? "from" : "shift";
  const place = tidy(Number(against[key] ?? 0) + way, unit);
  if (place === Number(against[key] ?? 0)) return false;
  builder.set(pointerTo(path, "against", key), key === "from" ? Math.max(place, 0) : place);
  return true;
}

/** The direction that the receivers of a plane face without `normal`: the first axis x the second. */
function facingOf({ axes }: JsonObject): number[] {
  const [a, b] = axes as number[][];
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

/** `wanted` is in m. The result is why the element stays, or null. */
export function moveElement(builder: EditBuilder, context: Context, wanted: Motion): Immovable | null {
  const { kind, path, effective, unit, parts } = context;
  const own = motionOf({ ...context, value: effective }, parts[0], wanted);
  if (isImmovable(own)) return own.immovable;
  if (isObject(effective.against)) return slide(context, own, builder) ? null : "against";
  const motion = inUnit(own, unit);
  const shape = shapeOf(kind, effective);
  const writer = new Writer(builder, path, effective);
  if (shape.rectangle)
    moveRectangle(context, motion, writer, () => {
      for (const key of ["min", "max"]) builder.set(pointerTo(path, key), undefined);
    });
  if (motion.mirrors && shape.turn) mirrored(context, motion, writer);
  else {
    for (const pointer of shape.points) {
      const value = valueAt(effective, pointer) as Json;
      writer.set(pointer, withPlace(value, moved(flat(value), motion), unit));
    }
    if (shape.turn && motion.turn !== 0)
      writer.set(shape.turn, sixDigits(wholeTurn(Number(effective.rotation_deg ?? 0) + motion.turn)));
  }
  if (motion.turn !== 0 || motion.mirrors) {
    const turned = (value: number[]) => [...movedVector(flat(value), motion).map(sixDigits), ...value.slice(2)];
    for (const pointer of shape.vectors) writer.set(pointer, turned(valueAt(effective, pointer) as number[]));
    // The mirrored axes alone would turn the receivers to the other side.
    if (kind === "plane" && motion.mirrors && effective.normal === undefined && shape.vectors.length === 2)
      writer.set("/normal", turned(facingOf(effective)).map(sixDigits));
    if (motion.mirrors) for (const pointer of shape.steps) writer.set(pointer, -Number(valueAt(effective, pointer)));
    if (shape.axes) moveAxes(shape.axes, context, motion, writer);
  }
  writer.finish();
  return null;
}
