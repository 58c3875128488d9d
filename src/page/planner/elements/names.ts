// What people call elements: their ids, or their kind with a number.

import { counted } from "../../data/format";
import { isObject, type JsonObject } from "../document/json";
import { say, text } from "../text";
import type { StoreElement } from "./kinds";
import { numbered, rowOf } from "./row_ids";

export function nameOf({ kind, value, index }: StoreElement): string {
  if (typeof value.id === "string") return isObject(value.repeat) ? rowName(value.id, value) : value.id;
  return kind === "room" ? text.kinds.room : say(text.numbered[kind], index + 1);
}

/** "G1–G4" for the row of "G{n}". */
function rowName(id: string, value: JsonObject): string {
  const { first, count } = rowOf(value);
  return id.includes("{n}") ? `${numbered(id, first)}–${numbered(id, first + count - 1)}` : id;
}

/** "A1", "3 fixtures" or "5 objects". */
export function namesOf(elements: readonly StoreElement[]): string {
  if (elements.length === 1) return nameOf(elements[0]);
  const kinds = new Set(elements.map(({ kind }) => kind));
  const [kind] = kinds;
  return counted(kinds.size === 1 ? text.counted[kind] : text.counted.objects, elements.length);
}
