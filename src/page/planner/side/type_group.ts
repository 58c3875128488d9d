// The fields of a type of the project.

import { presetsFor } from "../actions/assign";
import { isObject, pointerTo, valueAt, type Json, type JsonObject } from "../document/json";
import type { TypeList } from "../elements/types";
import type { Group } from "../form/field";
import { groupOfType } from "../form/schema";
import type { Planner } from "../planner";

/** The type of a preset, perhaps that of the preset that it begins with. */
function fixtureTypeOf(json: Json, value: JsonObject): string {
  let found: Json | undefined = value;
  for (let depth = 0; isObject(found) && depth < 20; ++depth) {
    if (typeof found.type === "string") return found.type;
    found = typeof found.preset === "string" ? valueAt(json, pointerTo("/presets", found.preset)) : undefined;
  }
  return "gondola";
}

/** The presets with which a preset can begin: those of its type that do not begin with it. */
export function basesFor(planner: Planner, name: string, value: JsonObject): string[] {
  const { json } = planner.document;
  const isBasedOn = (other: Json | undefined, depth = 0): boolean =>
    other === name ||
    (typeof other === "string" &&
      depth < 20 &&
      isBasedOn(valueAt(json, pointerTo("/presets", other, "preset")), depth + 1));
  return presetsFor(planner, [{ value }]).filter((other) => !isBasedOn(other));
}

/** Null: the schema knows no such fields. */
export function typeGroup(json: Json, kind: TypeList, value: JsonObject): Group | null {
  const group = groupOfType(kind, fixtureTypeOf(json, value)) ?? null;
  if (!group || kind !== "presets") return group;
  // A preset may leave out any key.
  return {
    ...group,
    variants: group.variants.map((variant) => ({
      ...variant,
      fields: variant.fields.filter(({ key }) => key !== "id").map((field) => ({ ...field, isRequired: false })),
      alternatives: [],
    })),
  };
}
