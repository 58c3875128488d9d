// Ids of rows: "A{n}" stands for A1, A2, ...

import type { EditBuilder } from "../document/edit";
import { isObject, pointerTo, valueAt, type Json, type JsonObject } from "../document/json";

/** The number of the first copy of a fixture, and how many copies it has; a single fixture is its own first. */
export function rowOf({ repeat }: JsonObject): { first: number; count: number } {
  const number = (key: string) => {
    const value = isObject(repeat) ? repeat[key] : undefined;
    return typeof value === "number" ? value : 1;
  };
  return { first: number("first"), count: number("count") * number("count2") };
}

export const numbered = (pattern: string, number: number): string => pattern.replace("{n}", String(number));

export const namesOf = (pattern: string, first: number, count: number): string[] =>
  Array.from({ length: count }, (_, k) => numbered(pattern, first + k));

/** The first of so many numbers, one after the other, whose ids are free. */
export function firstFree(taken: ReadonlySet<string>, pattern: string, count: number, from = 1): number {
  for (let first = from; ; ++first) if (namesOf(pattern, first, count).every((id) => !taken.has(id))) return first;
}

/** Elements that name fixtures name them by their new ids. */
export function followIds(builder: EditBuilder, renamed: ReadonlyMap<string, string>): void {
  const follow = (list: string, key: string) => {
    const members = valueAt(builder.json, list);
    if (!Array.isArray(members)) return;
    members.forEach((_: Json, index) => {
      const pointer = `${pointerTo(list, index)}${key}`;
      const id = renamed.get(String(builder.get(pointer)));
      if (id !== undefined) builder.set(pointer, id);
    });
  };
  follow("/fixtures", "/against/fixture");
  follow("/transceivers/on", "/fixture");
}
