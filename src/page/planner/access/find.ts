// Finds articles, fixtures, labels and units by their ids.

import { showSelection } from "../actions/source";
import type { Hit, Point } from "../document/messages";
import type { Planner } from "../planner";
import { text } from "../text";
import { deviceItem, itemOf } from "../view/hit";
import type { Item } from "../view/selection";
import { openPicker, type Result } from "./picker";

function itemOfHit(planner: Planner, { kind, path, key, index }: Hit): Item | null {
  const { labels, units, parts } = planner.document;
  const part = key === undefined ? undefined : parts.withKey(key);
  if (part) return itemOf(part);
  if (index !== undefined) return deviceItem(kind === "unit" ? units : labels, index);
  return path ? { kind: "element", path } : null;
}

/** `done`: after the choice of a hit. */
export function openFind(planner: Planner, done: () => void): void {
  const search = async (typed: string): Promise<Result[]> => {
    if (typed === "") return [];
    const { hits } = await planner.document
      .request<{ hits: Hit[] }>("find", { text: typed })
      .catch(() => ({ hits: [] }));
    return hits.map((hit) => ({
      name: hit.id,
      note: hit.description ?? (text.kinds as Record<string, string>)[hit.kind] ?? hit.kind,
      choose: () => {
        const item = itemOfHit(planner, hit);
        const place: Point = [hit.at[0], hit.at[1]];
        if (item) planner.selection.set([item]);
        if (item && planner.boundsOfItem(item)) showSelection(planner);
        else planner.viewport.fit({ lower: place, upper: place }, 120);
        done();
      },
    }));
  };
  openPicker(text.access.find, text.access.find_hint, search);
}
