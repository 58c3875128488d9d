// Lengths of presets in another unit than that of the store.

import type { Json, JsonObject } from "../document/json";
import { isObject } from "../document/json";
import { tidy, unitNamed, type LengthUnit } from "../geometry/units";
import type { FieldType } from "./field";
import { groupOfElement } from "./schema";
import { optionOf, variantOf } from "./variants";

function scaled(type: FieldType, value: Json, scale: (number: number) => number): Json {
  if (type.kind === "either") return scaled(optionOf(type.options, value), value, scale);
  if (type.kind === "group" && isObject(value)) {
    const { fields } = variantOf(type.group, value);
    return Object.fromEntries(
      Object.entries(value).map(([key, inner]) => {
        const field = fields.find((found) => found.key === key);
        return [key, field ? scaled(field.type, inner, scale) : inner];
      }),
    );
  }
  if (type.kind === "list" && Array.isArray(value))
    return value.map((inner) => scaled({ kind: "group", group: type.item }, inner, scale));
  return "measure" in type && type.measure === "length" ? scaledNumbers(value, scale) : value;
}

const scaledNumbers = (value: Json, scale: (number: number) => number): Json =>
  typeof value === "number"
    ? scale(value)
    : Array.isArray(value)
      ? value.map((inner) => scaledNumbers(inner, scale))
      : value;

/** A fixture with all lengths in the unit of the store; `units`: those of single keys. */
export function inUnit(effective: JsonObject, units: Record<string, string>, unit: LengthUnit): JsonObject {
  const group = groupOfElement("fixture", String(effective.type));
  if (!group) return effective;
  const { fields } = variantOf(group, effective);
  const result = { ...effective };
  for (const [key, name] of Object.entries(units)) {
    const field = fields.find((found) => found.key === key);
    const factor = unitNamed(name).factor / unit.factor;
    if (field) result[key] = scaled(field.type, effective[key], (number) => tidy(number * factor, unit));
  }
  return result;
}
