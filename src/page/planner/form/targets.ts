// The elements that a form edits, and the values that they have in common.

import { EditBuilder } from "../document/edit";
import { equal, isObject, pointerTo, tokensOf, valueAt, type Json, type JsonObject } from "../document/json";
import type { Details } from "../document/messages";

export interface Target {
  path: string;
  own: JsonObject;
  /** With the keys of presets. */
  effective: JsonObject;
  /** The answer of the server; null if it is not known. */
  details: Details | null;
}

/** A value as a form shows it. */
export interface Shown {
  /** Of the element itself; undefined if it has none or if the elements differ. */
  own: Json | undefined;
  /** What applies without an own value: that of a preset, or the default. */
  base: Json | undefined;
  /** The preset that `base` comes from; empty for a default. */
  origin: string;
  /** The elements differ. */
  isMixed: boolean;
  /** Some element has an own value. */
  isOwn: boolean;
}

function commonOf(values: readonly (Json | undefined)[]): { value: Json | undefined; isMixed: boolean } {
  const isMixed = values.some((value) => !equal(value, values[0]));
  return { value: isMixed ? undefined : values[0], isMixed };
}

/** The outermost list in which a value lies; null: none. */
function listAround(root: Json, pointer: string): string | null {
  const tokens = tokensOf(pointer);
  const count = tokens.findIndex((_, k) => Array.isArray(valueAt(root, pointerTo("", ...tokens.slice(0, k)))));
  return count < 0 ? null : pointerTo("", ...tokens.slice(0, count));
}

/** A list of the element replaces that of its preset, so that its members inherit nothing. */
export const inheritedAt = ({ own, details }: Target, pointer: string): Json | undefined =>
  details && listAround(own, pointer) === null ? valueAt(details.inherited, pointer) : undefined;

/** The value of the element itself, or of a list of its preset, which a change would copy as a whole. */
export const changedAt = ({ own, effective }: Target, pointer: string): Json | undefined =>
  valueAt(listAround(effective, pointer) === null ? own : effective, pointer);

/** Sets or removes a value of an element. A change in a list of its preset makes a list of its own. */
export function setIn(builder: EditBuilder, { path, effective }: Target, pointer: string, value: Json | undefined) {
  const list = listAround(effective, pointer);
  const isOwn = list === null || builder.get(path + list) !== undefined;
  if (isOwn) {
    builder.set(path + pointer, value);
    return;
  }
  const copy = new EditBuilder(valueAt(effective, list) as Json);
  copy.set(pointer.slice(list.length), value ?? undefined); // null, which removes a value of a preset, has no use there
  builder.set(path + list, copy.json);
}

/** `fallback`: the default in the unit of the file. */
export function shownAt(
  targets: readonly Target[],
  pointer: string,
  fallback: (target: Target) => Json | undefined,
): Shown {
  const own = commonOf(targets.map((target) => valueAt(target.own, pointer)));
  const baseOf = (target: Target) => inheritedAt(target, pointer) ?? fallback(target);
  const present = commonOf(targets.map((target) => valueAt(target.own, pointer) ?? baseOf(target)));
  const base = commonOf(targets.map(baseOf));
  const [first] = targets;
  const isInherited = first !== undefined && inheritedAt(first, pointer) !== undefined;
  return {
    own: own.value,
    base: base.value,
    origin: isInherited && typeof first.own.preset === "string" ? first.own.preset : "",
    isMixed: present.isMixed,
    isOwn: targets.some((target) => valueAt(target.own, pointer) !== undefined),
  };
}

/** The value that applies, of the element itself or of its preset. */
export const presentAt = ({ own, effective }: Target, pointer: string): Json | undefined =>
  valueAt(own, pointer) ?? valueAt(effective, pointer);

/** "fixtures[3].labels.spacing (preset 'run')" as a JSON pointer. */
export function pointerOfPath(path: string): string {
  const place = path.replace(/ \(.*$/, "");
  return [...place.matchAll(/\[(\d+)\]|\["([^"]*)"\]|([^.[\]]+)/g)]
    .map(([, index, quoted, key]) => `/${(index ?? quoted ?? key).replaceAll("~", "~0").replaceAll("/", "~1")}`)
    .join("");
}

export const objectAt = (target: Target, pointer: string): JsonObject => {
  const found = presentAt(target, pointer);
  const inherited = valueAt(target.effective, pointer);
  return { ...(isObject(inherited) ? inherited : {}), ...(isObject(found) ? found : {}) };
};
