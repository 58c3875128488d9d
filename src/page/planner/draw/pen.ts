// How the pointer and the keys draw: one scope from the first corner to the last.

import type { Point } from "../document/messages";
import type { Keys } from "../gesture/drags";
import type { Scope } from "../gesture/scope";
import { boundsOfParts, middleOf } from "../geometry/bounds";
import { parseLength, parseNumber } from "../geometry/lengths";
import { stepped } from "../geometry/units";
import { distance, dot, minus, plus, times, unitAt } from "../geometry/vector";
import type { Planner } from "../planner";
import { faintReach, type Snapped } from "../snap/choice";
import { text } from "../text";
import { rowSteps } from "../make/run";
import { finish, type Freedom } from "./finish";
import { addPoint, back, begin, dragged, end, lastOf, type Step } from "./stroke";
import { templateOf } from "./template";
import { formOf, type DrawTool } from "./tools";

export type Drawing = Extract<Scope, { kind: "drawing" }>;

const slack = 4; // pixels between a click and a drag
const longest = 1000; // m

/** Rows begin at the middle of the fixture that is selected, or of the first of its copies. */
function startOf(planner: Planner, tool: DrawTool): readonly Point[] {
  const [row] = planner.selected;
  const bounds = tool === "rows" && row ? boundsOfParts(planner.document.parts.of(row.path).slice(0, 1)) : null;
  return bounds ? [middleOf(bounds)] : [];
}

export const undrawn = (planner: Planner, tool: DrawTool): Drawing => ({
  kind: "drawing",
  stroke: begin(tool, startOf(planner, tool)),
  end: null,
  pressed: null,
  typed: { length: "", angle: "" },
  byKeys: false,
  isFree: false,
  isShift: false,
});

/** Whether there is something to cancel. */
export const hasBegun = (planner: Planner, { stroke, pressed }: Drawing): boolean =>
  pressed !== null || stroke.points.length > startOf(planner, stroke.tool).length;

/** What the fields at the pointer fix: a length in m and an angle in degrees. */
function fixed(planner: Planner, { typed }: Drawing): { length?: number; angle?: number } {
  const { factor } = planner.document.unit;
  const length = typed.length === "" ? null : parseLength(typed.length, factor);
  const angle = typed.angle === "" ? null : parseNumber(typed.angle);
  return { length: length === null ? undefined : length * factor, angle: angle ?? undefined };
}

/** The end of the edge for a place of the pointer. Places that nothing attracts are at whole steps. */
function aim(planner: Planner, before: Drawing, pointer: Point, { shift, alt }: Keys, isBox = false): Drawing {
  const { tool } = before.stroke;
  // The fixture of rows may have arrived or moved in the meantime.
  const scope = tool === "rows" ? { ...before, stroke: begin(tool, startOf(planner, tool)) } : before;
  const { stroke } = scope;
  const isFree = alt;
  const end = planner.snapping.at(pointer, {
    drawn: stroke.points,
    closes: formOf[stroke.tool] === "outline",
    isBox,
    isFree: isFree || tool === "faces",
    isOrtho: shift,
    ...fixed(planner, scope),
    held: scope.end ?? undefined,
  });
  const next = { ...scope, isFree, isShift: shift };
  if (stroke.tool === "rows" && !isFree) return { ...next, end: rowEnd(planner, scope, end) };
  const isTyped = scope.typed.length !== "";
  return { ...next, end: end.kind === null && !isTyped ? { ...end, at: atSteps(planner, end.at) } : end };
}

/**
 * Rows are beside or behind each other, as far as other rows if the pointer is near, and otherwise at whole steps or the
 * typed distance.
 */
function rowEnd(planner: Planner, { stroke, typed }: Drawing, end: Snapped): Snapped {
  const from = lastOf(stroke);
  const [footing] = planner.selected.flatMap(({ path }) => planner.document.parts.of(path)[0]?.footing ?? []);
  if (!from || !footing || typed.angle !== "") return end;
  const way = minus(end.at, from);
  const [along, across] = [0, 90].map((turn) => unitAt(footing.rotation + turn));
  const [x, y] = [dot(way, along), dot(way, across)];
  const [axis, length] = Math.abs(x) > Math.abs(y) ? [along, x] : [across, y];
  const { document, snapping } = planner;
  const { unit } = document;
  const known = rowSteps(document.json).map((step) => step * unit.factor);
  const same = known.find((step) => Math.abs(step - Math.abs(length)) <= faintReach(snapping.reach));
  const whole = same ?? stepped(Math.abs(length) / unit.factor, unit) * unit.factor;
  const size = Math.sign(length) * (typed.length === "" ? whole : Math.hypot(...way));
  const at = plus(from, times(axis, size));
  return { at, kind: same === undefined || typed.length !== "" ? null : "gap", guides: [] };
}

function atSteps({ document: { unit } }: Planner, [x, y]: Point): Point {
  const round = (metres: number) => stepped(metres / unit.factor, unit) * unit.factor;
  return [round(x), round(y)];
}

export function penDown(planner: Planner, scope: Drawing, screen: Point, world: Point, keys: Keys): Drawing {
  const aimed = aim(planner, scope, world, keys);
  if (!aimed.end) return aimed;
  if (scope.stroke.tool === "run" && !templateOf(planner)) {
    planner.say(text.draw.no_preset, true);
    return aimed;
  }
  // The first corner may begin a drag, so the release decides.
  return { ...aimed, pressed: { screen, at: aimed.end.at } };
}

export function penMove(planner: Planner, scope: Drawing, world: Point, keys: Keys): Drawing {
  const { pressed, stroke } = scope;
  const isDrag = pressed !== null && stroke.points.length === 0 && formOf[stroke.tool] !== "point";
  if (!isDrag) return aim(planner, scope, world, keys);
  // A drag snaps as the end of a line, or as the opposite corner of a rectangle.
  const begun = { ...scope, stroke: { ...stroke, points: [pressed.at] } };
  const aimed = aim(planner, begun, world, keys, formOf[stroke.tool] === "outline");
  return { ...aimed, stroke };
}

/** The outline or line that a drag draws so far. */
export function draggedSoFar(planner: Planner, { pressed, stroke, end }: Drawing): readonly Point[] | null {
  const isDrag = pressed && stroke.points.length === 0 && end;
  return isDrag ? dragged(stroke, pressed.at, end.at, planner.snapping.frame) : null;
}

export function penUp(planner: Planner, scope: Drawing, screen: Point, world: Point, keys: Keys): Drawing {
  const { pressed, stroke } = scope;
  if (!pressed) return scope;
  if (formOf[stroke.tool] === "point") {
    const { end: aimed } = aim(planner, scope, world, keys);
    const isThere = aimed !== null && isOnPlan(planner, screen);
    const released = { ...scope, pressed: null };
    return isThere ? proceed(planner, { ...released, isShift: keys.shift }, addPoint(stroke, aimed.at)) : released;
  }
  const isDrag = stroke.points.length === 0 && distance(screen, pressed.screen) > slack;
  if (!isDrag) return proceed(planner, { ...scope, pressed: null }, addPoint(stroke, pressed.at));
  const points = draggedSoFar(planner, penMove(planner, scope, world, keys));
  // A drag that leaves the plan draws nothing.
  if (!points || !isOnPlan(planner, screen)) return undrawn(planner, stroke.tool);
  return proceed(planner, { ...scope, pressed: null }, { done: points });
}

const isOnPlan = ({ viewport }: Planner, [x, y]: Point): boolean =>
  x >= 0 && y >= 0 && x <= viewport.width && y <= viewport.height;

const none: Keys = { shift: false, alt: false };

const aimAtPointer = (planner: Planner, scope: Drawing): Drawing =>
  aim(planner, scope, planner.pointer ?? planner.viewport.centre, none);

/** Enter: sets a corner at typed values or where arrow keys have moved the cross, and ends the stroke otherwise. */
export function setCorner(planner: Planner, scope: Drawing): Drawing {
  const isMeant = scope.byKeys || isTyped(scope) || scope.stroke.points.length === 0;
  if (!isMeant) return endStroke(planner, scope);
  if (!isReadable(planner, scope)) {
    planner.say(text.draw.not_length, true);
    return scope;
  }
  const aimed = scope.end ? scope : aimAtPointer(planner, scope);
  return aimed.end ? proceed(planner, aimed, addPoint(aimed.stroke, aimed.end.at)) : aimed;
}

/** Whether the typed length is one. */
function isReadable(planner: Planner, scope: Drawing): boolean {
  const { length } = fixed(planner, scope);
  return scope.typed.length === "" || (length !== undefined && length > 0 && length <= longest);
}

const isTyped = ({ typed }: Drawing): boolean => typed.length !== "" || typed.angle !== "";

export const withTyped = (planner: Planner, scope: Drawing, typed: Drawing["typed"]): Drawing =>
  aimAtPointer(planner, { ...scope, typed });

/** Moves the cross by pixels of the screen, to the right and upwards. */
export function moveCrossOf(planner: Planner, scope: Drawing, [x, y]: Point): Drawing {
  const { viewport } = planner;
  const from = scope.end?.at ?? planner.pointer ?? viewport.centre;
  const { step, factor } = planner.document.unit;
  // At least one step, which is many pixels from near.
  const way = [x, y].map((pixels) => Math.sign(pixels) * Math.max(Math.abs(pixels) / viewport.scale, step * factor));
  planner.pointer = plus(from, way as Point);
  return { ...aim(planner, scope, planner.pointer, { shift: false, alt: true }), byKeys: true, isFree: false };
}

export function endStroke(planner: Planner, scope: Drawing): Drawing {
  const { points, tool } = scope.stroke;
  if (formOf[tool] === "outline" && points.length > 0 && points.length < 3) {
    planner.say(text.draw.too_few, true);
    return scope;
  }
  return proceed(planner, scope, end(scope.stroke));
}

/** Leaves a tool: the walls so far stay. */
export function leave(planner: Planner, { stroke }: Drawing): void {
  if (formOf[stroke.tool] !== "chain" || stroke.points.length < 2) return;
  void finish(planner, stroke.tool, stroke.points, { isExact: false, isFree: false });
}

/** Null: there is no corner to take back. */
export function takeBack(planner: Planner, scope: Drawing): Drawing | null {
  const { stroke } = scope;
  if (stroke.points.length === 0 || stroke.tool === "rows") return null;
  const before = { ...undrawn(planner, stroke.tool), stroke: back(stroke) };
  return before.stroke.points.length > 0 ? aimAtPointer(planner, before) : before;
}

/** What modules and walls do not change. */
export const freedomOf = ({ isFree, isShift, typed }: Drawing): Freedom => ({
  isExact: typed.length !== "",
  isFree,
  isShift,
});

/** Typed values are for one edge. */
function proceed(planner: Planner, scope: Drawing, step: Step): Drawing {
  const { tool } = scope.stroke;
  if ("done" in step) {
    void finish(planner, tool, step.done, freedomOf(scope));
    return undrawn(planner, tool);
  }
  if (step.stroke.crossings.length > 0) planner.say(text.draw.crossing, true);
  const next = { ...undrawn(planner, tool), stroke: step.stroke };
  return step.stroke.points.length > 0 ? aimAtPointer(planner, next) : next;
}
