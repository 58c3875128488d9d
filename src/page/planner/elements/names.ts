// What people call elements: their ids, or their kind with a number.

import { counted } from "../../data/format";
import { isObject, type Json, type JsonObject } from "../document/json";
import { say, text } from "../text";
import type { StoreElement } from "./kinds";

export function nameOf({ kind, value, index }: StoreElement): string {
  if (typeof value.id === "string") return isObject(value.repeat) ? rowName(value.id, value.repeat) : value.id;
  return kind === "room" ? text.kinds.room : say(text.numbered[kind], index + 1);
}

/** "G1–G4" for the row of "G{n}". */
function rowName(id: string, { first, count, count2 }: JsonObject): string {
  const number = (value: Json | undefined) => (typeof value === "number" ? value : 1);
  const name = (k: number) => id.replace("{n}", String(k));
  const last = number(first) + number(count) * number(count2) - 1;
  return id.includes("{n}") ? `${name(number(first))}–${name(last)}` : id;
}

/** "A1", "3 fixtures" or "5 objects". */
export function namesOf(elements: readonly StoreElement[]): string {
  if (elements.length === 1) return nameOf(elements[0]);
  const kinds = new Set(elements.map(({ kind }) => kind));
  const [kind] = kinds;
  return counted(kinds.size === 1 ? text.counted[kind] : text.counted.objects, elements.length);
}
