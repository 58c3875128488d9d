// The drags that change elements: how the plan follows the pointer, and what is written at the end.

import { dropCopies, ghostsOf, wholeSteps } from "../actions/copy";
import { motionPreview, moveElements } from "../actions/move";
import { dropCrop, dropPicture } from "../backdrop/strokes";
import { EditBuilder } from "../document/edit";
import type { Point } from "../document/messages";
import { noPreview, type Preview } from "../document/preview";
import { contextOf, type Context } from "../elements/context";
import { cornerLists } from "../elements/handles";
import { nameOf, namesOf } from "../elements/names";
import { resize, resizedParts } from "../elements/resize";
import { valueAt } from "../document/json";
import { shiftBy, turnAbout } from "../geometry/rigid";
import { lengthText } from "../geometry/units";
import { directionOf, distance, minus, plus, times, wholeTurn } from "../geometry/vector";
import type { Planner } from "../planner";
import { snapMove, type Moved } from "../snap/box";
import { say, text } from "../text";
import { turnUnits } from "../units/act";
import { chosenUnits } from "../units/chosen";
import type { Scope } from "./scope";

type Moving = Extract<Scope, { kind: "moving" }>;
type Rotating = Extract<Scope, { kind: "rotating" }>;
type Carrying = Extract<Scope, { kind: "carrying" }>;
type Resizing = Extract<Scope, { kind: "resizing" }>;

export interface Keys {
  shift: boolean;
  alt: boolean;
}

/** No key frees a movement from its neighbours, so they attract from nearer than places do. */
const shareOfReach = 0.6;

/** What attracts dragged elements: everything beside them, and the originals of copies. */
function attracted(planner: Planner, { elements, isCopying }: Moving, shift: Point, axis?: 0 | 1): Moved {
  const { snapping, document } = planner;
  const paths = elements.map(({ path }) => path);
  const parts = paths.flatMap((path) => document.parts.of(path));
  const isBound = elements.some(({ kind }) => kind === "room") || parts.some(({ against }) => against !== undefined);
  const { frame } = snapping;
  const reach = shareOfReach * snapping.reach;
  return snapMove(
    snapping.without(new Set(isCopying ? [] : paths)),
    parts.flatMap(({ outline }) => outline),
    shift,
    { reach, frame, axis, isFree: isBound || (axis !== undefined && frame !== 0) || Math.hypot(...shift) === 0 },
  );
}

/** Shift keeps the direction of the longer side. */
export function dragMove(planner: Planner, scope: Moving, to: Point, keys: Keys): Moving {
  const [x, y] = minus(to, scope.from);
  const axis = keys.shift ? (Math.abs(x) > Math.abs(y) ? 0 : 1) : undefined;
  const way: Point = axis === 0 ? [x, 0] : axis === 1 ? [0, y] : [x, y];
  planner.document.show(null); // outlines attract, and copies begin, at the places before the gesture
  const own = { ...scope, isCopying: keys.alt };
  const next = { ...own, ...attracted(planner, own, wholeSteps(planner, way), axis) };
  const { elements, shift, isCopying } = next;
  planner.document.show(
    isCopying
      ? { ...noPreview, added: ghostsOf(planner, elements, shift) }
      : motionPreview(planner, elements, () => shiftBy(shift)),
  );
  return next;
}

function dropMove(planner: Planner, { elements, shift, isCopying }: Moving): Promise<boolean> {
  if (shift[0] === 0 && shift[1] === 0) {
    planner.document.show(null);
    return Promise.resolve(false);
  }
  if (isCopying) return dropCopies(planner, elements, shift);
  return moveElements(planner, elements, () => shiftBy(shift), { label: say(text.edits.move, namesOf(elements)) });
}

export function moveReadout(planner: Planner, { shift: [x, y] }: Moving): string {
  const { unit } = planner.document;
  return say(text.readout.move, lengthText(x, unit), lengthText(y, unit));
}

const turnStep = 15; // degrees

/** Alt turns by whole degrees instead of steps. */
export function dragTurn(planner: Planner, scope: Rotating, to: Point, keys: Keys): Rotating {
  const step = keys.alt ? 1 : turnStep;
  const raw = wholeTurn(directionOf(minus(to, scope.middle)) - scope.from);
  const turn = wholeTurn(Math.round(raw / step) * step);
  planner.document.show(motionPreview(planner, scope.elements, () => turnAbout(turn, scope.middle)));
  return { ...scope, turn };
}

function dropTurn(planner: Planner, { elements, middle, turn }: Rotating): Promise<boolean> {
  if (turn === 0) {
    planner.document.show(null);
    return Promise.resolve(false);
  }
  const units = chosenUnits(planner);
  if (units.length === 1) {
    planner.document.show(null);
    return turnUnits(planner, units, turn);
  }
  const label = say(text.edits.rotate, namesOf(elements));
  return moveElements(planner, elements, () => turnAbout(turn, middle), { label });
}

export const turnReadout = ({ turn }: Rotating): string => say(text.readout.turn, turn > 180 ? turn - 360 : turn);

/** How the plan looks after a change of an element's size. */
function resizePreview(context: Context, builder: EditBuilder, handle: string, to: Point): Preview {
  const resized = resize(builder, context, handle, to);
  const { parts, path, unit } = context;
  if (resized) return { ...noPreview, parts: new Map(resizedParts(parts, resized).map((part) => [part.key, part])) };
  const [part] = parts;
  if (!part) return noPreview;
  const points = (pointer: string): Point[] =>
    ((valueAt(builder.json, path + pointer) ?? []) as number[][]).map(([x, y]) => times([x, y], unit.factor));
  const [first, ...others] = cornerLists(context.effective);
  if (first?.pointer === "/corners") {
    const [a, b, c] = points(first.pointer);
    return { ...noPreview, parts: new Map([[part.key, { ...part, outline: [a, b, c, plus(a, minus(c, b))] }]]) };
  }
  if (first)
    return {
      ...noPreview,
      parts: new Map([
        [part.key, { ...part, outline: points(first.pointer), holes: others.map(({ pointer }) => points(pointer)) }],
      ]),
    };
  const [from, until] = ["/from", "/to"].map((key) => valueAt(builder.json, path + key) as number[]);
  const thickness = Number(context.effective.thickness ?? 0.1 / unit.factor);
  const outline = stripe(
    times([from[0], from[1]], unit.factor),
    times([until[0], until[1]], unit.factor),
    thickness * unit.factor,
  );
  return { ...noPreview, parts: new Map([[part.key, { ...part, outline }]]) };
}

/** A wall between two points. */
function stripe(a: Point, b: Point, thickness: number): Point[] {
  const way = minus(b, a);
  const [x, y] = times(way, (0.5 * thickness) / (Math.hypot(...way) || 1));
  return [
    [a[0] + y, a[1] - x],
    [b[0] + y, b[1] - x],
    [b[0] - y, b[1] + x],
    [a[0] - y, a[1] + x],
  ];
}

export function dragSize(planner: Planner, scope: Resizing, to: Point): Resizing {
  const builder = new EditBuilder(planner.document.json);
  const preview = resizePreview(scope.context, builder, scope.handle, to);
  planner.document.show(preview);
  return { ...scope, ops: builder.ops, preview };
}

function dropSize(planner: Planner, { context, ops, preview }: Resizing): Promise<boolean> {
  if (ops.length > 0) return planner.document.edit({ label: say(text.edits.resize, nameOf(context)), ops }, preview);
  planner.document.show(null);
  return Promise.resolve(false);
}

/** The sizes of the element's first outline as the plan shows it. */
export function sizeReadout(planner: Planner, { context }: Resizing): string {
  const { document } = planner;
  const outline = contextOf(document, context.path)?.parts[0]?.outline ?? [];
  const size = (a: number, b: number) =>
    outline[a] && outline[b] ? lengthText(distance(outline[a], outline[b]), document.unit) : "";
  return outline.length === 4 ? say(text.readout.size, size(0, 1), size(1, 2)) : "";
}

/** Shift keeps the direction of the longer side. */
export function carry(planner: Planner, scope: Carrying, to: Point, { shift }: Keys): Carrying {
  const [x, y] = minus(to, scope.from);
  const way: Point = !shift ? [x, y] : Math.abs(x) > Math.abs(y) ? [x, 0] : [0, y];
  planner.mover.to(wholeSteps(planner, plus(scope.start, way)));
  return scope;
}

/** Ends a drag with its effect; false if it has none. */
export function drop(planner: Planner, scope: Scope): boolean {
  if (scope.kind === "moving") void dropMove(planner, scope);
  else if (scope.kind === "rotating") void dropTurn(planner, scope);
  else if (scope.kind === "carrying") void planner.mover.drop();
  else if (scope.kind === "cropping") dropCrop(planner, scope);
  else if (scope.kind === "shifting") dropPicture(planner, scope);
  else if (scope.kind === "resizing" && scope.ops.length > 0) void dropSize(planner, scope);
  else return false;
  return true;
}
