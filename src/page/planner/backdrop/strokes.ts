// What the pointer does with the picture of the floor plan: lines of known length, a crop, and a shift.

import type { Point } from "../document/messages";
import type { Scope } from "../gesture/scope";
import { contains } from "../geometry/polygon";
import { stepped } from "../geometry/units";
import { distance, minus, plus, times, unitAt } from "../geometry/vector";
import type { Planner } from "../planner";
import { say, text } from "../text";
import { editDrawing } from "./edits";
import {
  angleBetween,
  cropBetween,
  leastAngle,
  placementOf,
  roundPixel,
  screenPixel,
  shifted,
  shownCorners,
  toPixel,
  toWorld,
} from "./transform";

export type Scaling = Extract<Scope, { kind: "scaling" }>;
type Cropping = Extract<Scope, { kind: "cropping" }>;
type Shifting = Extract<Scope, { kind: "shifting" }>;

export const unscaled: Scaling = { kind: "scaling", from: null, at: null, to: null };

/** The pixel at a place in the plan. */
export function pixelAt({ drawing, document }: Planner, world: Point): Point {
  return drawing ? roundPixel(toPixel(placementOf(drawing, document.unit), world), drawing) : [0, 0];
}

/** The place in the plan of a pixel. */
export function worldAt({ drawing, document }: Planner, pixel: Point): Point {
  return drawing ? toWorld(placementOf(drawing, document.unit), pixel) : [0, 0];
}

/** Whether a drag from a place moves the picture. */
export function isOnFreePicture({ drawing, look, document }: Planner, world: Point): boolean {
  if (!drawing || look.now.isLocked || !look.now.isShown || document.locked) return false;
  const placement = placementOf(drawing, document.unit);
  return contains(
    shownCorners(drawing).map((corner) => toWorld(placement, corner)),
    world,
  );
}

/** A step of the cross: a pixel of the picture, or of the screen in a drawing of lines; in pixels of the picture. */
function crossStep({ drawing, picture, viewport, document }: Planner): number {
  return drawing && picture.detail ? screenPixel(placementOf(drawing, document.unit), viewport) : 1;
}

/** Shorter lines are none, in pixels of the picture. */
const leastStroke = (planner: Planner): number => (planner.picture.detail ? 2 : 1) * crossStep(planner);

/** The cross follows the pointer. The lines of a drawing attract it, unless it is free. */
export function aimLine(planner: Planner, scope: Scaling, pointer: Point, isFree: boolean): Scaling {
  if (scope.to) return scope;
  const mark = planner.snapping.ofPicture(pointer, isFree, scope.mark);
  return { ...scope, at: pixelAt(planner, mark.at), mark };
}

/**
 * Moves the cross to the right and upwards on the screen: by pixels of the picture, or by those of the screen in a drawing
 * of lines.
 */
export function movedCross(planner: Planner, scope: Scaling, way: Point): Scaling {
  const { drawing, viewport } = planner;
  if (scope.to || !drawing) return scope;
  const [x, y] = times(way, crossStep(planner));
  const [c, s] = unitAt(drawing.rotation_deg ?? 0);
  const at = scope.at ?? pixelAt(planner, viewport.centre);
  return { ...scope, at: roundPixel(plus(at, [c * x + s * y, s * x - c * y]), drawing), mark: undefined };
}

/** Sets an end of the line at the cross. */
export function withEnd(planner: Planner, scope: Scaling): Scaling {
  const { from } = scope;
  const at = scope.at ?? pixelAt(planner, planner.viewport.centre);
  if (scope.to || !from) return { ...scope, from: at, at, to: null };
  if (distance(from, at) < leastStroke(planner)) return scope;
  const { scale } = planner.drawing ?? {};
  if (planner.tool === "check" && scale && angleBetween(scale, { from, to: at }) < leastAngle) {
    planner.say(say(text.picture.same_direction, leastAngle), true);
    return scope;
  }
  return { ...scope, at, to: at };
}

/** Sets an end of the line where the pointer is. */
export function pressLine(planner: Planner, scope: Scaling, pointer: Point, isFree: boolean): Scaling {
  const { at, mark } = aimLine(planner, { ...scope, to: null }, pointer, isFree);
  return withEnd(planner, { ...scope, at, mark });
}

export const dragCrop = (planner: Planner, scope: Cropping, world: Point): Cropping => ({
  ...scope,
  to: pixelAt(planner, world),
});

export function dropCrop(planner: Planner, { from, to }: Cropping): void {
  const { drawing } = planner;
  if (!drawing || distance(from, to) < leastStroke(planner)) return;
  void editDrawing(planner, text.edits.crop, { ...drawing, crop: cropBetween(drawing, from, to) });
  planner.setTool("select");
}

/** The picture where the pointer has it; it is at whole steps from where it was. */
export function dragPicture(planner: Planner, scope: Shifting, world: Point): Shifting {
  const { unit } = planner.document;
  const [x, y] = minus(world, scope.from).map((way) => stepped(way / unit.factor, unit) * unit.factor);
  planner.hold(null);
  if (planner.drawing) planner.hold(shifted(planner.drawing, unit, [x, y]));
  return { ...scope, to: plus(scope.from, [x, y]) };
}

export function dropPicture(planner: Planner, { from, to }: Shifting): void {
  planner.hold(null);
  const { drawing, document } = planner;
  if (drawing) void editDrawing(planner, text.edits.move_picture, shifted(drawing, document.unit, minus(to, from)));
}
