// Ids by a pattern, in the order in which people read a plan: from left to right, and from top to bottom.

import type { EditBuilder } from "../document/edit";
import { isObject, type JsonObject } from "../document/json";
import type { Point } from "../document/messages";
import { firstFree, followIds, namesOf, numbered, rowOf } from "./row_ids";

/** Elements whose middles are less apart in y stand in one line, m. */
const oneLine = 0.8;

export interface Numbered {
  path: string;
  /** With the keys of its presets. */
  value: JsonObject;
  /** m */
  middle: Point;
}

export function inReadingOrder(elements: readonly Numbered[]): Numbered[] {
  const lines: Numbered[][] = [];
  for (const element of [...elements].sort((a, b) => b.middle[1] - a.middle[1])) {
    const line = lines[lines.length - 1];
    if (line && line[0].middle[1] - element.middle[1] < oneLine) line.push(element);
    else lines.push([element]);
  }
  return lines.flatMap((line) => line.sort((a, b) => a.middle[0] - b.middle[0]));
}

/** "A{n}" for "A" and for "A{n}". */
export const patternOf = (typed: string): string => (typed.includes("{n}") ? typed : `${typed}{n}`);

export interface Naming {
  path: string;
  value: JsonObject;
  /** The number of the first, and how many follow each other. */
  first: number;
  count: number;
}

/** Numbers that no other element has; a row has as many as it has copies, one after the other. */
export function namingOf(elements: readonly Numbered[], pattern: string, others: ReadonlySet<string>): Naming[] {
  let next = 1;
  return inReadingOrder(elements).map(({ path, value }) => {
    const { count } = rowOf(value);
    const first = firstFree(others, pattern, count, next);
    next = first + count;
    return { path, value, first, count };
  });
}

/** Gives the ids, also where other elements name these fixtures. */
export function giveIds(builder: EditBuilder, naming: readonly Naming[], pattern: string): void {
  const renamed = new Map<string, string>();
  for (const { path, value, first, count } of naming) {
    const isRow = isObject(value.repeat);
    const { first: before } = rowOf(value);
    const names = namesOf(pattern, first, count);
    namesOf(String(value.id ?? ""), before, count).forEach((old, k) => renamed.set(old, names[k]));
    builder.set(`${path}/id`, isRow ? pattern : names[0]);
    if (isRow && first !== before) builder.set(`${path}/repeat/first`, first);
  }
  followIds(builder, renamed);
}

/** "A1, A2, A3, …". */
export function namesIn(naming: readonly Naming[], pattern: string, most = 4): string {
  const all = naming.flatMap(({ first, count }) =>
    count === 1 ? [numbered(pattern, first)] : [`${numbered(pattern, first)}–${numbered(pattern, first + count - 1)}`],
  );
  return all.slice(0, most).join(", ") + (all.length > most ? ", …" : "");
}
