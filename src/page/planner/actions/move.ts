// Moves, turns, mirrors, aligns and distributes the selected elements.

import { EditBuilder } from "../document/edit";
import type { Part, Point } from "../document/messages";
import { noPreview, type Preview } from "../document/preview";
import { aligned, distributed, type Alignment } from "../elements/arrange";
import { contextOf, knowDetails } from "../elements/context";
import { isImmovable, motionOf, moveElement, previewOf, type Immovable } from "../elements/motion";
import type { StoreElement } from "../elements/kinds";
import { namesOf } from "../elements/names";
import { middleOf } from "../geometry/bounds";
import { mirrorAt, shiftBy, turnAbout, type Motion } from "../geometry/rigid";
import type { Planner } from "../planner";
import { say, text } from "../text";

type MotionFor = (element: StoreElement, index: number) => Motion;

/** How the plan looks after movements of elements, from where they were before the gesture. */
export function motionPreview(planner: Planner, elements: readonly StoreElement[], motionFor: MotionFor): Preview {
  const parts = new Map<string, Part>();
  const devices = new Map<string, Motion>();
  planner.document.show(null); // movements count from the places before the gesture
  elements.forEach((element, index) => {
    const own = planner.document.parts.of(element.path);
    const motion = motionOf(element, own[0], motionFor(element, index));
    if (isImmovable(motion)) return;
    for (const part of previewOf(own, motion)) parts.set(part.key, part);
    devices.set(element.path, motion);
  });
  return { ...noPreview, parts, devices };
}

const isPureShift = ({ turn, mirrors }: Motion): boolean => turn === 0 && !mirrors;

export interface Wanted {
  label: string;
  /** Whether it continues the step before it. */
  join?: boolean;
  /** What else to change of each element. */
  finish?: (builder: EditBuilder, path: string) => void;
}

/** Writes a movement of elements. Those that cannot move stay, and the page says why. */
export async function moveElements(
  planner: Planner,
  elements: readonly StoreElement[],
  motionFor: MotionFor,
  { label, join, finish }: Wanted,
): Promise<boolean> {
  const { document } = planner;
  const preview = motionPreview(planner, elements, motionFor);
  document.show(preview);
  let paths: (string | null)[] = elements.map(({ path }) => path);
  const isShift = elements.every((element, index) => isPureShift(motionFor(element, index)));
  const release = planner.follow((place) => {
    paths = paths.map((path) => path && place(path));
  });
  await knowDetails(
    document,
    elements.map(({ path }) => path),
    isShift,
  );
  release();
  const builder = new EditBuilder(document.json);
  const immovable = new Set<Immovable>();
  paths.forEach((path, index) => {
    const context = path === null ? null : contextOf(document, path);
    if (!context) return;
    const why = moveElement(builder, context, motionFor(context, index));
    if (why) immovable.add(why);
    finish?.(builder, context.path);
  });
  for (const why of immovable) planner.say(text.immovable[why], true);
  if (immovable.size === 0 && builder.ops.length === 0) planner.say(text.notices.unchanged);
  return document.edit({ label, ops: builder.ops, join }, preview);
}

export function shiftElements(
  planner: Planner,
  elements: readonly StoreElement[],
  [x, y]: Point,
  join = false,
): Promise<boolean> {
  const label = say(text.edits.move, namesOf(elements));
  return moveElements(planner, elements, () => shiftBy([x, y]), { label, join });
}

function moveAbout(
  planner: Planner,
  elements: readonly StoreElement[],
  label: string,
  motionAt: (middle: Point) => Motion,
  finish?: Wanted["finish"],
): Promise<boolean> {
  const bounds = planner.boundsOfElements(elements);
  if (!bounds) {
    planner.say(text.why_not.unseen, true);
    return Promise.resolve(false);
  }
  return moveElements(planner, elements, () => motionAt(middleOf(bounds)), {
    label: say(label, namesOf(elements)),
    finish,
  });
}

/** About the middle of the elements. */
export function turnElements(planner: Planner, elements: readonly StoreElement[], degrees: number): Promise<boolean> {
  return moveAbout(planner, elements, text.edits.rotate, (middle) => turnAbout(degrees, middle));
}

/** Turns a fixture to an angle; undefined: to that of its preset, without one of its own. */
export async function turnTo(
  planner: Planner,
  elements: readonly StoreElement[],
  degrees: number | undefined,
): Promise<boolean> {
  const { document } = planner;
  await knowDetails(
    document,
    elements.map(({ path }) => path),
    false,
  );
  const [context] = elements.flatMap(({ path }) => contextOf(document, path) ?? []);
  if (!context) return false;
  const inherited = document.details.now(context.path)?.inherited.rotation_deg;
  const way = Number(degrees ?? inherited ?? 0) - Number(context.effective.rotation_deg ?? 0);
  const remove: Wanted["finish"] = (builder, path) => {
    builder.set(`${path}/rotation_deg`, undefined);
  };
  const motionAt = (middle: Point) => turnAbout(way, middle);
  return moveAbout(planner, [context], text.edits.rotate, motionAt, degrees === undefined ? remove : undefined);
}

export function mirrorSelection(planner: Planner, axis: 0 | 1): Promise<boolean> {
  return moveAbout(planner, planner.selected, text.edits.mirror, (middle) => mirrorAt(axis, middle));
}

function arrange(
  planner: Planner,
  label: string,
  shiftsOf: (all: NonNullable<Planner["selectionBounds"]>[]) => [number, number][],
) {
  const placed = planner.selected.flatMap((element) => {
    const bounds = planner.boundsOfItem({ kind: "element", path: element.path });
    return bounds ? [{ element, bounds }] : [];
  });
  const shifts = shiftsOf(placed.map(({ bounds }) => bounds));
  const elements = placed.map(({ element }) => element);
  return moveElements(planner, elements, (_, index) => shiftBy(shifts[index]), {
    label: say(label, namesOf(elements)),
  });
}

export function alignSelection(planner: Planner, how: Alignment): Promise<boolean> {
  return arrange(planner, text.edits.align, (all) => aligned(all, how));
}

export function distributeSelection(planner: Planner, axis: 0 | 1): Promise<boolean> {
  return arrange(planner, text.edits.distribute, (all) => distributed(all, axis));
}
