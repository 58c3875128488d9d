// What is selected: elements, single copies of a row, and labels or units that belong to an element.

import type { Changes } from "../changes";
import { valueAt, type Json } from "../document/json";
import type { DeviceKind } from "../document/devices";
import { elementAt, listOf } from "../elements/kinds";

export type Item =
  | { kind: "element"; path: string }
  /** One outline that cannot be changed alone. `path`: of the element that it is a copy of. */
  | { kind: "copy"; key: string; path: string | null }
  | { kind: "device"; device: DeviceKind; index: number; path: string | null };

const nameOf = (item: Item): string =>
  item.kind === "element" ? item.path : item.kind === "copy" ? `#${item.key}` : `#${item.device}${item.index}`;

/** Where an element is after a change; null if it is removed. */
export type Place = (path: string) => string | null;

/** Finds the same elements in another store, by their ids. */
export const placeAgain =
  (before: Json, after: Json): Place =>
  (path) => {
    const old = elementAt(before, path);
    if (!old) return valueAt(after, path) === undefined ? null : path;
    const { id } = old.value;
    if (elementAt(after, path)?.value.id === id) return path;
    const list = valueAt(after, listOf(old.kind));
    const index = Array.isArray(list) ? list.findIndex((_, k) => valueAt(list, `/${k}/id`) === id) : -1;
    return id === undefined || index < 0 ? null : `${listOf(old.kind)}/${index}`;
  };

export class Selection {
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
    const known = new Map(items.map((item) => [nameOf(item), item]));
    if (known.size === this.list.length && items.every((item) => this.has(item))) return;
    this.put([...known.values()]);
    this.changes.note("selection");
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
      return path === null ? [] : [path === item.path ? item : ({ ...item, path } as Item)];
    });
    if (moved.length === this.list.length && moved.every((item, k) => item === this.list[k])) return;
    this.put(moved);
    this.changes.note("selection");
  }

  /** Drops items that no longer exist. */
  keep(exists: (item: Item) => boolean): void {
    this.set(this.list.filter(exists));
  }
}
