// Changes of the picture of the floor plan: each is one step of the history.

import { percent } from "../../data/format";
import { showAll } from "../actions/source";
import { EditBuilder } from "../document/edit";
import { isObject, type Json, type JsonObject } from "../document/json";
import { elementsOf } from "../elements/kinds";
import { lengthText } from "../geometry/units";
import type { Planner } from "../planner";
import { say, text } from "../text";
import { drawingPath, type Drawing, type Line } from "./drawing";
import { comparisonOf, turnedTo, withScale } from "./transform";

/** Writes what differs. Null removes the picture. */
export function editDrawing({ document }: Planner, label: string, next: Drawing | null): Promise<boolean> {
  const builder = new EditBuilder(document.json);
  const before = builder.get(drawingPath);
  const joined = { ...(isObject(before) ? before : {}), ...next };
  const given = Object.entries(joined).filter(([, value]) => value !== undefined);
  builder.set(drawingPath, next ? (Object.fromEntries(given) as unknown as JsonObject) : undefined);
  return document.edit({ label, ops: builder.ops });
}

/** Whether the shop has more than an empty rectangle, so that the drawing must stay above the picture. */
export const isTraced = (json: Json): boolean =>
  elementsOf(json).some(({ kind, value }) => (kind === "room" ? value.outline !== undefined : kind !== "area"));

/** What the second length says about the scale; empty without one. */
export function checkText({ document }: Planner, drawing: Drawing): string {
  const comparison = comparisonOf(drawing);
  if (!comparison || !drawing.check) return "";
  const { difference, agrees, byScale } = comparison;
  const lengths = [byScale, drawing.check.length].map((length) =>
    lengthText(length * document.unit.factor, document.unit),
  );
  const share = Math.abs(difference);
  // "Within" is rounded upwards.
  return agrees
    ? say(text.picture.agrees, percent(Math.max(Math.ceil(1000 * share), 1) / 1000))
    : say(text.picture.stretched, percent(share), ...lengths);
}

/** The scale from a line, and then perhaps its check. */
export function setScale(planner: Planner, line: Line, isStraight: boolean): void {
  const { drawing, document } = planner;
  if (!drawing) return;
  const keeps = isTraced(document.json) ? "line" : "corner";
  const next = { ...withScale(drawing, document.unit, { line, isStraight, keeps }), unit: undefined };
  void editDrawing(planner, text.edits.scale, next);
  if (keeps === "corner") showAll(planner);
  planner.setTool(comparisonOf(next)?.agrees ? "select" : "check");
}

/** By a right angle. */
export function turnPicture(planner: Planner, degrees: number): void {
  const { drawing, document } = planner;
  if (!drawing) return;
  const turn = (drawing.rotation_deg ?? 0) + degrees;
  void editDrawing(planner, text.edits.turn_picture, turnedTo(drawing, document.unit, turn));
}

export function setCheck(planner: Planner, check: Line): void {
  if (!planner.drawing) return;
  const next = { ...planner.drawing, check };
  void editDrawing(planner, text.edits.check_scale, next);
  planner.say(checkText(planner, next), comparisonOf(next)?.agrees === false);
  planner.setTool("select");
}
