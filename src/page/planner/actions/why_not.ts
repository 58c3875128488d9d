// Why the selection cannot be changed, and what to do instead.

import type { Planner } from "../planner";
import { text } from "../text";

/** Null if it can be changed. */
export function whyNot({ document, selection, selected }: Planner): string | null {
  if (document.locked) return text.why_not.locked;
  if (selected.length > 0) return null;
  const [item] = selection.items;
  if (!item) return text.why_not.nothing;
  if (item.path === null) return text.why_not.file;
  return item.kind === "copy" ? text.why_not.copy : text.why_not.device;
}

/** Why it cannot be copied or deleted. */
export const whyNoCopy = (planner: Planner): string =>
  whyNot(planner) ?? (planner.selected.every(({ kind }) => kind === "room") ? text.why_not.room : text.why_not.unseen);
