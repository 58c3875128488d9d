// Values of a fixture that change more than one key: it turns about its middle, and its back stays where it stands.

import { EditBuilder } from "../document/edit";
import type { Json } from "../document/json";
import { contextOf, knowDetails, type Context } from "../elements/context";
import type { StoreElement } from "../elements/kinds";
import { nameOf } from "../elements/names";
import { tidy } from "../geometry/units";
import { times, unitAt } from "../geometry/vector";
import { isOneSided } from "../make/run";
import type { Planner } from "../planner";
import { say, text } from "../text";
import { givePreset } from "./assign";
import { turnTo } from "./move";

/** The result gets the value of a field, undefined for that of the preset; false: it is a value like any other. */
export function overrideOf(planner: Planner, fixtures: readonly StoreElement[], single: Context | null) {
  return (pointer: string, value: Json | undefined): boolean => {
    if (pointer === "/preset") {
      void givePreset(planner, fixtures, value === undefined ? undefined : String(value));
      return true;
    }
    return single !== null && overridesPlace(planner, single, pointer, value);
  };
}

function overridesPlace(planner: Planner, fixture: Context, pointer: string, value: Json | undefined): boolean {
  const { against, type } = fixture.effective;
  const number = value === undefined ? undefined : Number(value);
  if (against !== undefined) return false;
  if (pointer === "/rotation_deg") void turnTo(planner, [fixture], number);
  else if (pointer === "/depth" && (type === "gondola" || type === "freezer"))
    void deepen(planner, fixture.path, number);
  else return false;
  return true;
}

/** Another depth, in the unit of the store. Shelving with a front alone keeps its back, others keep their middle. */
async function deepen(planner: Planner, where: string, depth: number | undefined): Promise<void> {
  const { document } = planner;
  let path: string | null = where;
  const release = planner.follow((place) => {
    path = path && place(path);
  });
  await knowDetails(document, [where], false);
  release();
  const context = path === null ? null : contextOf(document, path);
  if (!context) return;
  const builder = new EditBuilder(document.json);
  builder.set(`${context.path}/depth`, depth);
  const { at, depth: before, rotation_deg } = context.effective;
  const change = Number(before) - (depth ?? Number(document.details.now(context.path)?.inherited.depth));
  if (Array.isArray(at) && Number.isFinite(change)) {
    const way = times(unitAt(Number(rotation_deg ?? 0) + 90), (isOneSided(context.effective) ? 1 : 0.5) * change);
    builder.set(
      `${context.path}/at`,
      at.map((value, k) => (k < 2 ? tidy(Number(value) + way[k], context.unit) : value)),
    );
  }
  await document.edit({ label: say(text.edits.change, text.fields.depth, nameOf(context)), ops: builder.ops });
}
