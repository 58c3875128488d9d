// The types of the project: presets of fixtures, materials, label types and transceiver types.

import { button, element, replaceChildren } from "../../panel/dom";
import { EditBuilder } from "../document/edit";
import { pointerTo, splitPointer, valueAt, type Json } from "../document/json";
import { assignedTypes } from "../actions/assign";
import { nextId } from "../elements/copies";
import { namesIn } from "../form/initial";
import { isNamed, type TypeList } from "../elements/types";
import type { Planner } from "../planner";
import { say, text } from "../text";

/** Presets come last, because there are many. */
const lists: TypeList[] = ["materials", "label_types", "transceiver_types", "presets"];

export class TypeLists {
  private readonly sections = element("div", {});
  readonly root = element(
    "div",
    { class: "scroll types" },
    element("p", { class: "note", text: text.types.lead }),
    this.sections,
  );

  constructor(private readonly planner: Planner) {}

  update(): void {
    const { json, shared } = this.planner.document;
    const assigned = assignedTypes(this.planner);
    replaceChildren(
      this.sections,
      lists.flatMap((list) => {
        const names = namesIn(json, list, shared);
        if (names.length === 0) return [];
        return [
          element("h3", { text: text.types.names[list] }),
          element(
            "ul",
            { class: "type-list" },
            ...names.map((name) =>
              this.row(list, name, list === assigned?.list ? digitOf(assigned.names.indexOf(name)) : null),
            ),
          ),
        ];
      }),
    );
  }

  /** `digit`: the key that gives the type to the selection. */
  private row(list: TypeList, name: string, digit: number | null): HTMLElement {
    const path = pointerTo("", list, name);
    const { planner } = this;
    const { json } = planner.document;
    const isOwn = valueAt(json, path) !== undefined;
    const isOpen = planner.typePath === path && planner.selection.items.length === 0;
    const files = [valueAt(json, "/catalogues") ?? []].flat().join(", ");
    const why = isOwn ? undefined : say(text.types.of_catalogue, name, files);
    return element(
      "li",
      {},
      button(name, () => (why === undefined ? planner.openType(path) : planner.say(why, true)), {
        class: isOwn ? "plain" : "plain shared",
        title: why,
        "aria-pressed": String(isOpen),
        "data-key": path,
      }),
      digit === null ? null : element("kbd", { text: String(digit), title: text.types.assign }),
    );
  }
}

const digitOf = (index: number): number | null => (index >= 0 && index < 9 ? index + 1 : null);

/** A copy of a type under the next free name. */
export function duplicateType(planner: Planner, path: string): void {
  const [list, name] = splitPointer(path);
  const { document } = planner;
  const next = nextId(name, new Set(namesIn(document.json, list.slice(1) as TypeList)));
  const builder = new EditBuilder(document.json);
  builder.set(pointerTo(list, next), valueAt(document.json, path) as Json);
  void document.edit({ label: say(text.edits.duplicate, name), ops: builder.ops });
  planner.openType(pointerTo(list, next));
}

/** The name of a type that nothing names yet, such as a copy; null for another type. */
export function nameField(planner: Planner, path: string): HTMLElement | null {
  const { document } = planner;
  const [parent, name] = splitPointer(path);
  const list = parent.slice(1) as TypeList;
  if (isNamed(document.json, list, name)) return null;
  const rename = (typed: string) => {
    if (typed === "" || typed === name) return;
    if (namesIn(document.json, list, document.shared).includes(typed)) {
      planner.say(say(text.types.taken, typed), true);
      return;
    }
    const builder = new EditBuilder(document.json);
    builder.set(pointerTo(parent, typed), valueAt(document.json, path) as Json);
    builder.set(path, undefined);
    void document.edit({ label: say(text.types.rename, name, typed), ops: builder.ops });
    planner.openType(pointerTo(parent, typed));
  };
  return element(
    "label",
    { class: "row" },
    element("span", { text: text.fields.name }),
    element("input", {
      type: "text",
      value: name,
      disabled: document.locked !== null,
      "data-key": "type-name",
      on: { change: ({ target }) => rename((target as HTMLInputElement).value.trim()) },
    }),
  );
}

export function deleteType(planner: Planner, path: string): void {
  const { document } = planner;
  const [, name] = splitPointer(path);
  const builder = new EditBuilder(document.json);
  builder.set(path, undefined);
  void document.edit({ label: say(text.edits.delete, name), ops: builder.ops });
  planner.openType(null);
}
