// From a copy, a label or a unit to the element that it comes from; and views of the selection.

import type { Planner } from "../planner";
import { pointerTo } from "../document/json";
import { elementAt, elementsOf, listOf } from "../elements/kinds";
import { nameOf } from "../elements/names";
import { say, text } from "../text";
import { deviceItem, freePaths, isDeviceFree, itemOf } from "../view/hit";
import type { Item } from "../view/selection";

/** Selects the element that a copy or a device belongs to: the whole row. */
export function selectSource(planner: Planner): void {
  const { selection } = planner;
  const sources = selection.items.flatMap((item): Item[] =>
    item.kind === "element" ? [item] : item.path === null ? [] : [{ kind: "element", path: item.path }],
  );
  if (sources.length > 0) selection.set(sources);
}

/** A row, a copy of it, or a fixture that stands against something. */
export function canDissolve(planner: Planner): boolean {
  const [item, ...others] = planner.selection.items;
  if (!item || item.path === null || others.length > 0) return false;
  return planner.document.parts
    .of(item.path)
    .some(({ locked, against }) => locked === "repeat" || against !== undefined);
}

/** Turns a row, or a fixture against something, into fixtures with places of their own, and selects them. */
export async function dissolve({ document, selection }: Planner): Promise<void> {
  const [item] = selection.items;
  const element = item?.path ? elementAt(document.json, item.path) : null;
  if (!element) return;
  const count = () => elementsOf(document.json).length;
  const before = count();
  if (!(await document.dissolve(element.path, say(text.edits.dissolve, nameOf(element))))) return;
  const made = Array.from({ length: count() - before + 1 }, (_, k) => element.index + k);
  selection.setPaths(made.map((index) => pointerTo(listOf(element.kind), index)));
}

/** The labels and units that are elements of the store. */
function freeDevices({ document, layers }: Planner): Item[] {
  return [document.labels, document.units].flatMap((list) =>
    Array.from({ length: list.count }, (_, index) => index)
      .filter((index) => list.isListed(index) && isDeviceFree(list, index, layers))
      .map((index) => deviceItem(list, index)),
  );
}

/** The room is among them if it has an outline, so that the whole drawing can move. */
export function selectAll(planner: Planner): void {
  const { document, layers, selection } = planner;
  const room = elementAt(document.json, "/room");
  const withRoom = room?.value.outline !== undefined && layers.isFree("room") ? [room.path] : [];
  const paths = [...withRoom, ...freePaths(document, layers)];
  selection.set([...paths.map((path): Item => ({ kind: "element", path })), ...freeDevices(planner)]);
}

export function showAll({ viewport, wholeBounds }: Planner): void {
  viewport.fit(wholeBounds);
}

export function showSelection({ viewport, selectionBounds }: Planner): void {
  viewport.fit(selectionBounds, 120);
}

/** Selects the next or previous outline, label or unit in the order of the list. */
export function nextItem(planner: Planner, step: 1 | -1): void {
  const { document, layers, selection } = planner;
  const outlines = document.parts.all.filter(({ kind }) => layers.isFree(kind)).map(itemOf);
  const items = [...outlines, ...freeDevices(planner)];
  if (items.length === 0) return;
  const at = items.findIndex((item) => selection.has(item));
  const next = items[(at < 0 ? (step > 0 ? 0 : items.length - 1) : at + step + items.length) % items.length];
  selection.set([next]);
}
