// The kinds of elements of a store, and the places of their lists in it.

import type { PartKind } from "../document/messages";
import { isObject, pointerTo, valueAt, type Json, type JsonObject } from "../document/json";

export type ElementKind = PartKind | "label" | "unit";

export const lists: { kind: ElementKind; list: string }[] = [
  { kind: "zone", list: "/room/zones" },
  { kind: "wall", list: "/room/inner_walls" },
  { kind: "opening", list: "/room/openings" },
  { kind: "fixture", list: "/fixtures" },
  { kind: "label", list: "/labels" },
  { kind: "plane", list: "/measuring_planes" },
  { kind: "area", list: "/transceivers/areas" },
  { kind: "grid", list: "/transceivers/grids" },
  { kind: "rail", list: "/transceivers/rails" },
  { kind: "faces", list: "/transceivers/on" },
  { kind: "unit", list: "/transceivers/list" },
  { kind: "keep_out", list: "/transceivers/keep_out" },
];

export const kinds: ElementKind[] = ["room", ...lists.map(({ kind }) => kind)];

const room = "/room";

/** The kind of the element with this path; null if it is none. */
export function kindOf(path: string): ElementKind | null {
  if (path === room) return "room";
  const cut = path.lastIndexOf("/");
  if (!/^\/\d+$/.test(path.slice(cut))) return null;
  return lists.find(({ list }) => list === path.slice(0, cut))?.kind ?? null;
}

export const listOf = (kind: ElementKind): string => lists.find((entry) => entry.kind === kind)?.list ?? room;

/** The element that a place in the store lies in; null for places outside of elements. */
export function elementAround(pointer: string): string | null {
  for (let path = pointer; path !== ""; path = path.slice(0, path.lastIndexOf("/"))) if (kindOf(path)) return path;
  return null;
}

export interface StoreElement {
  path: string;
  kind: ElementKind;
  /** Its position in the list of its kind. */
  index: number;
  value: JsonObject;
}

export function elementAt(json: Json, path: string): StoreElement | null {
  const kind = kindOf(path);
  const value = valueAt(json, path);
  return kind && isObject(value)
    ? { path, kind, index: Number(path.slice(path.lastIndexOf("/") + 1)) || 0, value }
    : null;
}

/** All elements in the order of the layers. */
export function elementsOf(json: Json): StoreElement[] {
  const paths = lists.flatMap(({ list }) => {
    const members = valueAt(json, list);
    return Array.isArray(members) ? members.map((_, index) => pointerTo(list, index)) : [];
  });
  return [room, ...paths].flatMap((path) => elementAt(json, path) ?? []);
}
