// Copies of elements with ids that no other element has.

import type { EditBuilder } from "../document/edit";
import { isObject, type Json, type JsonObject } from "../document/json";
import type { Part, Point } from "../document/messages";
import { elementsOf, kinds, listOf, type ElementKind } from "./kinds";

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

/** A text for the clipboard, and back. `unit`: of the lengths. */
export const toText = (copied: readonly Copied[], unit: string): string =>
  JSON.stringify({ shelfbeam: copied, unit } as unknown as Json);

export function fromText(text: string, unit: string): Copied[] {
  try {
    const found = JSON.parse(text) as Json;
    if (!isObject(found) || found.unit !== unit || !Array.isArray(found.shelfbeam)) return [];
    return found.shelfbeam.filter(
      (item) =>
        isObject(item) &&
        kinds.includes(item.kind as ElementKind) &&
        isObject(item.value) &&
        Array.isArray(item.middle),
    ) as unknown as Copied[];
  } catch {
    return [];
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
  const values = copied.map(({ kind, value }) => {
    if (typeof value.id !== "string") return { kind, value };
    const id = taken.has(value.id) ? nextId(value.id, taken) : value.id;
    taken.add(id);
    renamed.set(value.id, id);
    return { kind, value: { ...value, id } };
  });
  return values.map(({ kind, value }) => builder.append(listOf(kind), withNewNeighbour(value, renamed)));
}

/** A fixture against another one that is copied, too, stands against its copy. */
function withNewNeighbour(value: JsonObject, renamed: ReadonlyMap<string, string>): JsonObject {
  const { against } = value;
  if (!isObject(against) || typeof against.fixture !== "string") return value;
  return { ...value, against: { ...against, fixture: renamed.get(against.fixture) ?? against.fixture } };
}
