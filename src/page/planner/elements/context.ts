// An element with all that is known about it: what a change of it needs.

import type { StoreDocument } from "../document/document";
import { isObject, type JsonObject } from "../document/json";
import type { Part } from "../document/messages";
import type { LengthUnit } from "../geometry/units";
import { elementAt, type StoreElement } from "./kinds";

export interface Context extends StoreElement {
  /** The element with the keys of its presets. */
  effective: JsonObject;
  /** Its resolved outlines: one, or its copies. */
  parts: readonly Part[];
  unit: LengthUnit;
}

/** Null for a missing element. Lacks the keys of presets that the page has not received yet. */
export function contextOf(document: StoreDocument, path: string): Context | null {
  const element = elementAt(document.json, path);
  if (!element) return null;
  const known = needsDetails(element) ? document.details.now(path)?.effective : undefined;
  return {
    ...element,
    effective: withPreset(known, element.value),
    parts: document.parts.of(path),
    unit: document.unit,
  };
}

/** Objects of a preset and of the element are joined key by key; the element's keys may be newer than the answer. */
export function withPreset(known: JsonObject | undefined, own: JsonObject): JsonObject {
  const joined: JsonObject = { ...known, ...own };
  for (const [key, value] of Object.entries(own)) {
    const base = known?.[key];
    if (isObject(value) && isObject(base)) joined[key] = { ...base, ...value };
  }
  return joined;
}

/** Only elements with a preset have keys that are not in the store itself. */
const needsDetails = ({ value }: StoreElement): boolean => value.preset !== undefined;

/**
 * Waits until the keys of presets are known. Contexts are taken afterwards, in one go with the edit, because the store may
 * change during the wait.
 */
export async function knowDetails(document: StoreDocument, paths: readonly string[], isShift: boolean): Promise<void> {
  const unknown = paths.filter((path) => {
    const element = elementAt(document.json, path);
    // A shift changes the place alone, which is hardly ever that of a preset.
    return element && needsDetails(element) && !document.details.has(path) && !(isShift && element.value.at);
  });
  await Promise.all(unknown.map((path) => document.details.of(path)));
}
