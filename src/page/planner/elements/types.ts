// The types of a store that elements name: presets, materials, and types of labels and transceivers.

import type { EditBuilder } from "../document/edit";
import { isObject, pointerTo, valueAt, type Json, type JsonObject } from "../document/json";
import type { SharedNames } from "../document/messages";

export type TypeList = "presets" | "materials" | "label_types" | "transceiver_types";

export type Types = Partial<Record<TypeList, JsonObject>>;

/** Keys of maps and lists whose values are names of the same kind. */
const outerKeys = new Set(["level_types", "hears"]);

function listsNamedBy(key: string): TypeList[] {
  if (key === "preset") return ["presets"];
  return key === "type" || outerKeys.has(key) ? ["label_types", "transceiver_types"] : ["materials"];
}

/** The store's own types that values name, also through other types. Those of catalogues are left out. */
export function typesNamedBy(values: readonly Json[], json: Json): Types {
  const found: Types = {};
  const visit = (value: Json, key: string): void => {
    if (typeof value === "string")
      for (const list of key === "id" ? [] : listsNamedBy(key)) {
        const type = valueAt(json, pointerTo("", list, value));
        if (type === undefined || found[list]?.[value] !== undefined) continue;
        found[list] = { ...found[list], [value]: type };
        visit(type, "");
      }
    else if (Array.isArray(value)) for (const inner of value) visit(inner, key);
    else if (isObject(value))
      for (const [own, inner] of Object.entries(value)) visit(inner, outerKeys.has(key) ? key : own);
  };
  for (const value of values) visit(value, "");
  return found;
}

/** Whether an element or another type of the store names a type. */
export function isNamed(json: Json, list: TypeList, name: string): boolean {
  if (!isObject(json)) return false;
  const lists: string[] = ["presets", "materials", "label_types", "transceiver_types"];
  const others = Object.entries(json).flatMap(([key, value]) =>
    key === "confirmed" || key === "assumed"
      ? []
      : lists.includes(key) && isObject(value)
        ? Object.values(value)
        : [value],
  );
  return typesNamedBy(others, json)[list]?.[name] !== undefined;
}

/** Adds the types that a store lacks. */
export function addTypes(builder: EditBuilder, types: Types, shared: SharedNames): void {
  for (const [list, named] of Object.entries(types) as [TypeList, JsonObject][])
    for (const [name, type] of Object.entries(named)) {
      const path = pointerTo("", list, name);
      if (builder.get(path) === undefined && !shared[list]?.includes(name)) builder.set(path, type);
    }
}
