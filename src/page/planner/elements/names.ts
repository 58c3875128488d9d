// What people call elements: their ids, or their kind with a number.

import { counted } from "../../data/format";
import { say, text } from "../text";
import type { StoreElement } from "./kinds";

export function nameOf({ kind, value, index }: StoreElement): string {
  if (typeof value.id === "string") return value.id;
  return kind === "room" ? text.kinds.room : say(text.numbered[kind], index + 1);
}

/** "A1", "3 fixtures" or "5 objects". */
export function namesOf(elements: readonly StoreElement[]): string {
  if (elements.length === 1) return nameOf(elements[0]);
  const kinds = new Set(elements.map(({ kind }) => kind));
  const [kind] = kinds;
  return counted(kinds.size === 1 ? text.counted[kind] : text.counted.objects, elements.length);
}
