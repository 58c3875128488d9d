// Which form of an object an element has, and the fields that several elements have in common.

import type { JsonObject } from "../document/json";
import type { Field, Group, Variant } from "./field";

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
