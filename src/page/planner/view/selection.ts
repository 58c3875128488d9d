// What is selected: elements, single copies of a row, and labels or units that belong to an element.

import type { Changes } from "../changes";
import { equal, valueAt, type Json } from "../document/json";
import type { DeviceKind, Devices } from "../document/devices";
import { elementAt, listOf } from "../elements/kinds";

export type Item =
  | { kind: "element"; path: string }
  /** One outline that cannot be changed alone. `path`: of the element that it is a copy of. */
  | { kind: "copy"; key: string; path: string | null }
  | { kind: "device"; device: DeviceKind; index: number; path: string | null };

const nameOf = (item: Item): string =>
  item.kind === "element" ? item.path : item.kind === "copy" ? `#${item.key}` : `#${item.device}${item.index}`;

/** The key of a copy after its element has moved to a path. */
export function copyKey(key: string, path: string): string {
  const cut = key.indexOf("#");
  return cut < 0 ? key : path.slice(1) + key.slice(cut);
}

/** Where an element is after a change; null if it is removed. */
export type Place = (path: string) => string | null;

/** Finds the same elements in another store, by their ids, or by their values if they have none. */
export const placeAgain =
  (before: Json, after: Json): Place =>
  (path) => {
    const old = elementAt(before, path);
    const list = old && valueAt(after, listOf(old.kind));
    if (!old || !Array.isArray(list)) return valueAt(after, path) === undefined ? null : path;
    const { id } = old.value;
    const isSame = (value: Json | undefined) =>
      id === undefined ? equal(value, old.value) : valueAt(value, "/id") === id;
    if (isSame(valueAt(after, path))) return path;
    const index = list.findIndex(isSame);
    if (index >= 0) return `${listOf(old.kind)}/${index}`;
    const listBefore = valueAt(before, listOf(old.kind));
    const isChanged = id === undefined && Array.isArray(listBefore) && listBefore.length === list.length;
    return isChanged ? path : null;
  };

export class Selection {
  /** Changes when something else is selected, not when the selection follows the store. */
  version = 0;
  private list: Item[] = [];
  private names = new Set<string>();

  constructor(private readonly changes: Changes) {}

  get items(): readonly Item[] {
    return this.list;
  }

  /** The selected elements, which can be changed. */
  get paths(): string[] {
    return this.list.flatMap((item) => (item.kind === "element" ? [item.path] : []));
  }

  has(item: Item): boolean {
    return this.names.has(nameOf(item));
  }

  set(items: readonly Item[]): void {
    if (this.replace(items)) ++this.version;
  }

  /** The same things under other names. False if nothing changes. */
  replace(items: readonly Item[]): boolean {
    const known = new Map(items.map((item) => [nameOf(item), item]));
    if (known.size === this.list.length && items.every((item) => this.has(item))) return false;
    this.put([...known.values()]);
    this.changes.note("selection");
    return true;
  }

  private put(list: Item[]): void {
    this.list = list;
    this.names = new Set(list.map(nameOf));
  }

  setPaths(paths: readonly string[]): void {
    this.set(paths.map((path) => ({ kind: "element", path })));
  }

  add(items: readonly Item[]): void {
    this.set([...this.list, ...items]);
  }

  toggle(item: Item): void {
    if (this.has(item)) this.set(this.list.filter((other) => nameOf(other) !== nameOf(item)));
    else this.add([item]);
  }

  clear(): void {
    this.set([]);
  }

  /** Follows elements to their places after a change. */
  follow(place: Place): void {
    const moved = this.list.flatMap((item): Item[] => {
      if (item.path === null) return [item];
      const path = place(item.path);
      if (path === null) return [];
      if (path === item.path) return [item];
      return [item.kind === "copy" ? { ...item, path, key: copyKey(item.key, path) } : { ...item, path }];
    });
    if (moved.length === this.list.length && moved.every((item, k) => item === this.list[k])) return;
    this.put(moved);
    this.changes.note("selection");
  }

  /** Labels or units [from, from + removed) are replaced by others. Those of the same elements are likely the same. */
  replaceDevices(devices: Devices, from: number, removed: number, added: number): void {
    const next = this.list.flatMap((item): Item[] => {
      if (item.kind !== "device" || item.device !== devices.kind || item.index < from) return [item];
      if (item.index >= from + removed) return [{ ...item, index: item.index + added - removed }];
      return added === removed && devices.pathOf(item.index) === item.path ? [item] : [];
    });
    this.replace(next);
  }

  /** Drops items that no longer exist. */
  keep(exists: (item: Item) => boolean): void {
    this.replace(this.list.filter(exists));
  }
}
