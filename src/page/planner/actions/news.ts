// What another tab or another program has done to the store, in a few words.

import type { Others } from "../document/document";
import type { Json } from "../document/json";
import { elementsOf } from "../elements/kinds";
import { namesOf } from "../elements/names";
import { say, text } from "../text";

/** The elements of a store that another one does not have. */
function elementsOnlyIn(json: Json, other: Json): ReturnType<typeof elementsOf> {
  const known = new Set(elementsOf(other).map(({ value }) => JSON.stringify(value)));
  return elementsOf(json).filter(({ value }) => !known.has(JSON.stringify(value)));
}

export function newsOf({ by, history: { before, after }, json }: Others): string {
  if (by === "plan") return say(text.notices.planned, after.steps[after.position - 1]?.label ?? "");
  if (by === "program") {
    const there = elementsOnlyIn(json.after, json.before);
    const changed = there.length > 0 ? there : elementsOnlyIn(json.before, json.after);
    return say(text.notices.outside, changed.length > 0 ? namesOf(changed) : text.properties.store);
  }
  if (after.position < before.position) return say(text.notices.others.undo, before.steps[after.position].label);
  const step = after.steps[after.position - 1];
  const old = before.steps[after.position - 1];
  const isRedone = before.position < after.position && old?.label === step?.label && old?.time === step?.time;
  return say(isRedone ? text.notices.others.redo : text.notices.others.edit, step?.label ?? "");
}
