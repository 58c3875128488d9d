// Copies of elements with ids that no other element has.

import type { EditBuilder } from "../document/edit";
import { isObject, type Json, type JsonObject } from "../document/json";
import type { Part, Point } from "../document/messages";
import { elementsOf, kinds, listOf, type ElementKind } from "./kinds";
import { firstFree, namesOf, rowOf } from "./row_ids";
import type { Types } from "./types";

export interface Copied {
  kind: ElementKind;
  value: JsonObject;
  /** The element with the keys of its presets. */
  effective: JsonObject;
  /** Its first outline, m. */
  part: Part | null;
  /** Where it is, m. */
  middle: Point;
}

/** What the clipboard holds. */
export interface Clip {
  copied: readonly Copied[];
  /** Of the lengths. */
  unit: string;
  /** The types that the copies name. */
  types: Types;
}

export const toText = ({ copied, ...rest }: Clip): string => JSON.stringify({ shelfbeam: copied, ...rest });

/** Null if the text is not one of ours. */
export function fromText(text: string): Clip | null {
  try {
    const { shelfbeam, unit, types } = JSON.parse(text) as JsonObject;
    if (!Array.isArray(shelfbeam)) return null;
    const copied = shelfbeam.filter(
      (item) =>
        isObject(item) &&
        kinds.includes(item.kind as ElementKind) &&
        isObject(item.value) &&
        Array.isArray(item.middle),
    ) as unknown as Copied[];
    return copied.length === 0 ? null : { copied, unit: String(unit), types: (isObject(types) ? types : {}) as Types };
  } catch {
    return null;
  }
}

export function idsOf(json: Json, others: Iterable<string>): Set<string> {
  const own = elementsOf(json).map(({ value }) => value.id);
  return new Set([...own, ...others].filter((id): id is string => typeof id === "string"));
}

/** The id with the next free number at its end: A2 after A1. Ids of copies in a row keep their {n}. */
export function nextId(id: string, taken: ReadonlySet<string>): string {
  const [, stem, digits] = /^(.*?)(\d*)$/s.exec(id) as unknown as [string, string, string];
  const separator = digits === "" ? (id.includes("{n}") ? "-" : " ") : "";
  for (let number = digits === "" ? 2 : Number(digits) + 1; ; ++number) {
    const next = `${stem}${separator}${String(number).padStart(digits.length, "0")}`;
    if (!taken.has(next)) return next;
  }
}

/** Adds copies to the ends of their lists, and returns their paths. Ids that are free stay. */
export function addCopies(builder: EditBuilder, copied: readonly Copied[], taken: Set<string>): string[] {
  const renamed = new Map<string, string>();
  const values = copied.map(({ kind, value, effective }) => {
    if (typeof value.id !== "string") return { kind, value };
    const row = rowAfter(value, effective, taken);
    if (row) return { kind, value: row };
    const id = taken.has(value.id) ? nextId(value.id, taken) : value.id;
    taken.add(id);
    renamed.set(value.id, id);
    return { kind, value: { ...value, id } };
  });
  return values.map(({ kind, value }) => builder.append(listOf(kind), withNewNeighbour(value, renamed)));
}

/** A row of "A{n}" with the next free numbers; null: it is no row. Neighbours of its members keep to the first row. */
function rowAfter(value: JsonObject, effective: JsonObject, taken: Set<string>): JsonObject | null {
  const pattern = String(value.id);
  if (!pattern.includes("{n}") || !isObject(effective.repeat)) return null;
  const { first: before, count } = rowOf(effective);
  const first = firstFree(taken, pattern, count, before);
  for (const id of namesOf(pattern, first, count)) taken.add(id);
  return { ...value, repeat: { ...(isObject(value.repeat) ? value.repeat : {}), first } };
}

/** A fixture against another one that is copied, too, stands against its copy. */
function withNewNeighbour(value: JsonObject, renamed: ReadonlyMap<string, string>): JsonObject {
  const { against } = value;
  if (!isObject(against) || typeof against.fixture !== "string") return value;
  return { ...value, against: { ...against, fixture: renamed.get(against.fixture) ?? against.fixture } };
}
