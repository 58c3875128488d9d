// The handles on the screen: those that change the size of the selected element, and the one that turns the selection.

import type { Point } from "../document/messages";
import { contextOf } from "../elements/context";
import { frameOf, handlesOf, type Frame, type Handle } from "../elements/handles";
import { isImmovable, motionOf } from "../elements/motion";
import { turnAbout } from "../geometry/rigid";
import { distance } from "../geometry/vector";
import type { Planner } from "../planner";

export interface Grip {
  handle: Handle | "turn";
  screen: Point;
}

const mostGrips = 120;
const turnDistance = 28; // pixels above the selection
const reach = 9; // pixels
const leastSide = 22; // pixels between neighbouring grips
// Pixels of a rectangle with grips at its corners, at its ends, and at its long sides.
const leastFrame = 40;
const leastLength = 30;
const leastDepth = 15;

/** Grips must not cover what they belong to: its sides need room between them, its corners more. */
function hasRoom({ id, isCorner }: Handle, { length, depth }: Frame, scale: number): boolean {
  if (isCorner) return Math.min(length, depth) * scale >= leastFrame;
  return id.startsWith("x") ? length * scale >= leastLength : depth * scale >= leastDepth;
}

function sizeGrips(planner: Planner): Grip[] {
  const { document, selection, viewport } = planner;
  const [item] = selection.items;
  if (selection.items.length !== 1 || item.kind !== "element") return [];
  const context = contextOf(document, item.path);
  if (!context) return [];
  const element = { ...context, value: context.effective };
  const frame = frameOf(element, context.parts[0], document.unit);
  const handles = handlesOf(element, context.parts[0], document.unit);
  const corners = handles.filter(({ isCorner }) => isCorner);
  const isNearCorner = (handle: Handle) =>
    corners.some(({ at }) => distance(at, handle.at) * viewport.scale < leastSide);
  return handles
    .filter((handle) => (frame ? hasRoom(handle, frame, viewport.scale) : handle.isCorner || !isNearCorner(handle)))
    .slice(0, mostGrips)
    .map((handle) => ({ handle, screen: viewport.toScreen(handle.at) }));
}

function turnGrip(planner: Planner): Grip[] {
  const bounds = planner.selectionBounds;
  const { document } = planner;
  const canTurn = planner.selected.some(
    (element) => !isImmovable(motionOf(element, document.parts.of(element.path)[0], turnAbout(15, [0, 0]))),
  );
  if (!bounds || !canTurn) return [];
  const [x, y] = planner.viewport.toScreen([0.5 * (bounds.lower[0] + bounds.upper[0]), bounds.upper[1]]);
  return [{ handle: "turn", screen: [x, y - turnDistance] }];
}

export function gripsOf(planner: Planner): Grip[] {
  if (planner.tool !== "select" || !planner.isPlan || planner.document.locked) return [];
  return [...turnGrip(planner), ...sizeGrips(planner)];
}

export function gripAt(grips: readonly Grip[], screen: Point): Grip | null {
  let [found, least] = [null as Grip | null, reach];
  for (const grip of grips) {
    const away = distance(grip.screen, screen);
    if (away <= least) [found, least] = [grip, away];
  }
  return found;
}
