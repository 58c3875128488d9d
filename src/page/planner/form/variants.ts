// Which form of an object an element has, and the fields that several elements have in common.

import { isObject, type Json, type JsonObject } from "../document/json";
import type { Field, FieldType, Group, Variant } from "./field";

/** The variant of an object: by its type, or the one with the most keys in common. */
export function variantOf({ variants, isTyped }: Group, value: JsonObject): Variant {
  if (isTyped) return variants.find(({ name }) => name === value.type) ?? variants[0];
  const score = ({ name, fields }: Variant) =>
    fields.filter(({ key }) => value[key] !== undefined).length + (name !== "" && value[name] !== undefined ? 100 : 0);
  return variants.reduce((best, variant) => (score(variant) > score(best) ? variant : best));
}

/** The keys of the alternative that an object has; the first if it has none. */
export function alternativeOf({ alternatives }: Variant, value: JsonObject): string[] {
  return alternatives.find((keys) => keys.every((key) => value[key] !== undefined)) ?? alternatives[0] ?? [];
}

/** The fields to show: without those of other alternatives. */
export function fieldsOf(variant: Variant, value: JsonObject): Field[] {
  const chosen = alternativeOf(variant, value);
  const others = variant.alternatives.flat().filter((key) => !chosen.includes(key));
  return variant.fields.filter(
    ({ key, type }) => !others.includes(key) && !(key === "type" && type.kind === "constant"),
  );
}

/** The fields that all lists have, with the same type. */
export function commonFields(all: readonly Field[][]): Field[] {
  const [first = [], ...rest] = all;
  return first.filter((field) =>
    rest.every((fields) =>
      fields.some(({ key, type }) => key === field.key && JSON.stringify(type) === JSON.stringify(field.type)),
    ),
  );
}

/** Whether a value has a type. */
export const fits = (type: FieldType, value: Json | undefined): boolean => {
  switch (type.kind) {
    case "number":
      return typeof value === "number";
    case "constant":
      return value === type.value;
    case "choice":
    case "name":
    case "text":
      return typeof value === "string";
    case "vector":
    case "numbers":
      return Array.isArray(value) && value.every((inner) => typeof inner === "number");
    case "points":
      return Array.isArray(value) && Array.isArray(value[0]);
    case "map":
    case "group":
      return isObject(value);
    default:
      return value !== undefined;
  }
};

/** The option of several types that a value has. */
export const optionOf = (options: FieldType[], value: Json | undefined): FieldType =>
  options.find((type) => fits(type, value)) ?? options[0];
