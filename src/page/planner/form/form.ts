// A form for one element or several: the fields of the schema, with what the server says about them.

import { button, element } from "../../panel/dom";
import type { EditBuilder } from "../document/edit";
import { isObject, pointerTo, valueAt, type Json, type JsonObject } from "../document/json";
import { say, text } from "../text";
import type { Field, FieldType, Group, Variant } from "./field";
import { initialObject, initialValue, type Surroundings } from "./initial";
import { leafInput, optionName, typeChoice, type Place } from "./inputs";
import { changedAt, inheritedAt, objectAt, presentAt, setIn, shownAt, type Shown, type Target } from "./targets";
import { problemId } from "./problems";
import { alternativeOf, commonFields, fieldsOf, optionOf, variantOf } from "./variants";

/** Changes one element; `path` is that of the element. */
type Write = (builder: EditBuilder, target: Target) => void;

export interface FormContext {
  targets: Target[];
  around: Surroundings;
  isDisabled: boolean;
  /** Problems by the pointer of the value, relative to the element. */
  problems: ReadonlyMap<string, string>;
  /** Which parts of the form are unfolded. */
  unfolded: Set<string>;
  /** `what`: the name of the field. */
  write: (what: string, write: Write) => void;
  /** Takes the place of writing a value, for values that depend on others; of several targets, that of the first. */
  override?: (pointer: string, value: Json | undefined) => boolean;
}

const fieldName = (key: string): string => (text.fields as Record<string, string>)[key] ?? key.replaceAll("_", " ");

export class Form {
  constructor(private readonly context: FormContext) {}

  /** The rows of the fields that the targets have in common; `groups`: of each target. */
  elementRows(groups: readonly Group[]): HTMLElement[] {
    return this.rows(groups, "");
  }

  private rows(groups: readonly Group[], pointer: string): HTMLElement[] {
    const { targets } = this.context;
    const [group] = groups;
    const values = targets.map((target) => objectAt(target, pointer));
    const variants = values.map((value, k) => variantOf(groups[k] ?? group, value));
    const fields = commonFields(variants.map((variant, k) => fieldsOf(variant, values[k]))).filter(
      ({ key }) => key !== "id" || targets.length === 1,
    );
    const isSame = variants.every((variant) => variant === variants[0]);
    const alternatives = variants.flatMap((variant) => variant.alternatives);
    const isGiven = alternatives.some((keys) => keys.every((key) => this.isInherited(pointerTo(pointer, key))));
    const needed = isGiven ? [] : alternatives.flat();
    const rows = fields.map((field) =>
      this.row(needed.includes(field.key) ? { ...field, isRequired: true } : field, pointer),
    );
    if (isSame && group.variants.length > 1 && group.variants.every(({ name }) => name !== "parts"))
      rows.unshift(this.variantRow(group, variants[0], pointer));
    if (isSame && variants[0].alternatives.length > 1)
      rows.splice(this.alternativePlace(fields, variants[0]), 0, this.alternativeRow(variants[0], values[0], pointer));
    return rows;
  }

  /** Whether presets give a value to all targets. */
  private isInherited(pointer: string): boolean {
    return this.context.targets.every((target) => inheritedAt(target, pointer) !== undefined);
  }

  private alternativePlace(fields: Field[], { alternatives }: Variant): number {
    const keys = alternatives.flat();
    return Math.max(
      fields.findIndex(({ key }) => keys.includes(key)),
      0,
    );
  }

  private place(pointer: string, key: string, isRequired: boolean): Place {
    const { around, isDisabled } = this.context;
    const id = `field${pointer}`;
    return { id, key, label: fieldName(key), around, isDisabled, isRequired, problemId: problemId(pointer) };
  }

  private shown(pointer: string, field: Field): Shown {
    const { unit } = this.context.around;
    const isLength = field.type.kind === "number" && field.type.measure === "length";
    const inFile = (value: Json | undefined) =>
      isLength && typeof value === "number" ? Number((value / unit.factor).toPrecision(6)) : value;
    return shownAt(this.context.targets, pointer, ({ own, details }) => {
      const isOwn = valueAt(own, pointer) !== undefined;
      const resolved = isOwn || !details?.resolved ? undefined : valueAt(details.resolved, pointer);
      return inFile(resolved ?? field.default ?? this.facesWithLabels(pointer));
    });
  }

  /** Without a choice, all faces of a fixture have labels. */
  private facesWithLabels(pointer: string): Json | undefined {
    if (pointer !== "/labels/faces") return undefined;
    return valueAt(this.context.targets[0]?.effective ?? {}, "/faces") ?? ["front", "back"];
  }

  private set(what: string, pointer: string, next: (present: Json | undefined) => Json | undefined): void {
    const { targets, override, write } = this.context;
    if (override?.(pointer, next(presentAt(targets[0], pointer)))) return;
    write(what, (builder, target) => {
      setIn(builder, target, pointer, next(presentAt(target, pointer)));
    });
  }

  private row(field: Field, parent: string): HTMLElement {
    const { key, type } = field;
    const pointer = pointerTo(parent, key);
    const isRequired = field.isRequired && !this.isInherited(pointer);
    const shown = this.shown(pointer, field);
    const isRemovable = !field.isRequired && shown.origin !== "";
    const place = { ...this.place(pointer, key, isRequired), isRemovable };
    const active = type.kind === "either" ? optionOf(type.options, shown.own ?? shown.base) : type;
    const commit = (next: (present: Json | undefined) => Json | undefined) => this.set(place.label, pointer, next);
    const choice = type.kind === "either" ? typeChoice(place, type.options, shown, commit) : null;
    const isNamed = choice !== null && active.kind === "constant"; // by the choice
    const control = isNamed ? element("span", {}) : leafInput(place, active, shown, commit);
    const known = { ...field, isRequired };
    if (control) return this.leafRow(place, known, shown, [choice, control]);
    return this.nestedRow(place, known, active, pointer, choice);
  }

  private leafRow(place: Place, field: Field, shown: Shown, controls: (HTMLElement | null)[]): HTMLElement {
    const pointer = place.id.slice("field".length);
    const isChosen = controls.some((control) => control instanceof HTMLSelectElement && control.id === place.id);
    const canReset = shown.isOwn && !field.isRequired && !place.isDisabled && !isChosen;
    const reset = button("↺", () => this.set(place.label, pointer, () => undefined), {
      class: "reset",
      title: text.form.reset,
      "aria-label": say(text.form.reset_of, place.label),
      "data-key": `${place.id}/reset`,
    });
    return element(
      "div",
      { class: "row", "data-field": pointer },
      element("label", { for: place.id, text: place.label, title: field.description }),
      element(
        "div",
        {
          class: "control",
          title: shown.isOwn || !shown.origin ? undefined : say(text.properties.of_preset, shown.origin),
        },
        ...controls,
        canReset ? reset : null,
      ),
    );
  }

  /** An object, a list or a map, which can be folded. */
  private nestedRow(
    place: Place,
    field: Field,
    type: FieldType,
    pointer: string,
    choice: HTMLElement | null,
  ): HTMLElement {
    const { targets, unfolded } = this.context;
    const isThere = targets.some((target) => presentAt(target, pointer) !== undefined);
    const isOwn = targets.some((target) => valueAt(target.own, pointer) !== undefined);
    if (!isThere) return this.missingRow(place, field, type, pointer);
    const body = this.bodyOf(type, pointer, place);
    const folded = element("details", { class: "nested", "data-field": pointer });
    folded.open = unfolded.has(pointer) || [...this.context.problems.keys()].some((at) => at.startsWith(`${pointer}/`));
    folded.addEventListener("toggle", () => {
      if (folded.open) unfolded.add(pointer);
      else unfolded.delete(pointer);
    });
    const remove =
      isOwn && !field.isRequired && !place.isDisabled
        ? button(text.form.remove, () => this.set(place.label, pointer, () => undefined), {
            class: "small",
            "aria-label": say(text.form.remove_of, place.label),
            "data-key": `${place.id}/remove`,
          })
        : null;
    folded.append(
      element("summary", { text: place.label, title: field.description, "data-key": `${place.id}/fold` }),
      ...(choice
        ? [element("div", { class: "row" }, element("span", { class: "name", text: text.form.form }), choice)]
        : []),
      ...body,
      ...(remove ? [element("div", { class: "buttons" }, remove)] : []),
    );
    return folded;
  }

  private missingRow(place: Place, field: Field, type: FieldType, pointer: string): HTMLElement {
    const { around, isDisabled } = this.context;
    const add = button(
      text.form.add,
      () => this.set(place.label, pointer, () => this.withFirst(type, field.key, around)),
      {
        class: "small",
        disabled: isDisabled,
        "aria-label": say(text.form.add_of, place.label),
        "data-key": `${place.id}/add`,
      },
    );
    return element(
      "div",
      { class: "row", "data-field": pointer },
      element("span", { class: "name", text: place.label, title: field.description }),
      element("div", { class: "control" }, add),
    );
  }

  /** A list begins with one member, because an empty one shows nothing to fill in. */
  private withFirst(type: FieldType, key: string, around: Surroundings): Json {
    this.context.unfolded.add(pointerTo("", key));
    return type.kind === "list" ? [initialObject(type.item, 0, around)] : initialValue(type, key, around);
  }

  private bodyOf(type: FieldType, pointer: string, place: Place): HTMLElement[] {
    if (type.kind === "group") return this.rows([type.group], pointer);
    if (type.kind === "map") return this.mapRows(type, pointer, place);
    return type.kind === "list" ? this.listRows(type.item, pointer, place) : [];
  }

  private listRows(item: Group, pointer: string, place: Place): HTMLElement[] {
    const { targets, around, isDisabled } = this.context;
    if (targets.length !== 1) return [element("p", { class: "note", text: text.form.one_only })];
    const list = presentAt(targets[0], pointer);
    const members = Array.isArray(list) ? list : [];
    const change = (next: (list: Json[]) => Json[]) =>
      this.set(place.label, pointer, (now) => next(Array.isArray(now) ? now : []));
    return [
      ...members.map((_, k) =>
        element(
          "fieldset",
          { class: "member" },
          element("legend", { text: say(text.form.member, place.label, k + 1) }),
          ...this.rows([item], pointerTo(pointer, k)),
          button(text.form.remove, () => change((now) => now.filter((_member, n) => n !== k)), {
            class: "small",
            disabled: isDisabled,
            "data-key": `${place.id}/${k}/remove`,
          }),
        ),
      ),
      element(
        "div",
        { class: "buttons" },
        button(text.form.add, () => change((now) => [...now, initialObject(item, 0, around)]), {
          class: "small",
          disabled: isDisabled,
          "aria-label": say(text.form.add_of, place.label),
          "data-key": `${place.id}/more`,
        }),
      ),
    ];
  }

  private mapRows(type: Extract<FieldType, { kind: "map" }>, pointer: string, place: Place): HTMLElement[] {
    const { targets, around, isDisabled } = this.context;
    const [target] = targets;
    if (targets.length !== 1) return [element("p", { class: "note", text: text.form.one_only })];
    const map = objectAt(target, pointer);
    const set = (key: string, value: Json | undefined) => {
      this.context.write(place.label, (builder, one) => setIn(builder, one, pointerTo(pointer, key), value));
    };
    const rows = Object.keys(map).map((key) => {
      const at = pointerTo(pointer, key);
      const own: Place = { ...this.place(at, key, true), label: key === "" ? text.form.no_name : key };
      const shown = shownAt(targets, at, () => undefined);
      const control = leafInput(own, type.value, shown, (next) => set(key, next(map[key])));
      const isOwn = valueAt(target.own, at) !== undefined;
      return element(
        "div",
        { class: "row", "data-field": at },
        element("label", { for: own.id, text: own.label }),
        element(
          "div",
          { class: "control" },
          control,
          isOwn && !isDisabled
            ? button("×", () => set(key, undefined), {
                class: "reset",
                "aria-label": say(text.form.remove_of, key),
                "data-key": `${at}/remove`,
              })
            : null,
        ),
      );
    });
    const name = element("input", {
      type: "text",
      "aria-label": say(text.form.new_key, place.label),
      placeholder: text.keys[type.keys],
      disabled: isDisabled,
      "data-key": `${place.id}/new`,
      on: {
        change: () => {
          const key = name.value.trim();
          if (key === "") return;
          name.value = "";
          if (Object.hasOwn(map, key))
            document.getElementById(this.place(pointerTo(pointer, key), key, true).id)?.focus();
          else set(key, initialValue(type.value, "", around));
        },
      },
    });
    name.dataset.shown = ""; // text that is being typed stays
    return [...rows, element("div", { class: "row" }, element("span", { class: "name", text: text.form.add }), name)];
  }

  /** Chooses one of several forms of an object. Values that both have stay. */
  private variantRow(group: Group, active: Variant, pointer: string): HTMLElement {
    const names = group.variants.map(({ name }) => (group.isTyped ? optionName(name) : fieldName(name)));
    const what = group.isTyped ? fieldName("type") : text.form.given_by;
    return this.choiceRow(what, `${pointer}/variant`, names, group.variants.indexOf(active), (index) => {
      const next = group.variants[index];
      this.context.write(what, (builder, target) => {
        const value = objectAt(target, pointer);
        const keys = next.fields.map(({ key }) => key);
        const kept = Object.entries(value).filter(([key]) => keys.includes(key) && key !== "type");
        const first = this.firstOf(group, index, value);
        for (const key of Object.keys(valueObject(target, pointer)))
          if (!keys.includes(key) || key === "type") setIn(builder, target, pointerTo(pointer, key), undefined);
        const all: JsonObject = { ...first, ...Object.fromEntries(kept) };
        for (const [key, own] of Object.entries(all)) setIn(builder, target, pointerTo(pointer, key), own);
      });
    });
  }

  private firstOf(group: Group, index: number, value: JsonObject): JsonObject {
    const { around } = this.context;
    const first = initialObject(group, index, around);
    // Keys of the element's place are computed from its outline.
    for (const { key, type } of group.variants[index].fields)
      if (first[key] !== undefined && value[key] === undefined && key !== "type")
        first[key] = initialValue(type, key, around);
    return first;
  }

  /** Chooses which of several sets of keys an object has. */
  private alternativeRow(variant: Variant, value: JsonObject, pointer: string): HTMLElement {
    const { alternatives } = variant;
    const active = alternatives.indexOf(alternativeOf(variant, value));
    const names = alternatives.map((keys) => keys.map(fieldName).join(", "));
    return this.choiceRow(text.form.given_by, `${pointer}/alternative`, names, active, (index) => {
      const keys = alternatives[index];
      const removed = alternatives.flat().filter((key) => !keys.includes(key));
      // The side that a fixture stands against decides its angle.
      if (keys.includes("against")) removed.push("rotation_deg");
      this.context.write(text.form.given_by, (builder, target) => {
        const own = valueObject(target, pointer);
        for (const key of removed)
          if (own[key] !== undefined) setIn(builder, target, pointerTo(pointer, key), undefined);
        for (const { key, type } of variant.fields) {
          const isTurn = key === "rotation_deg" && keys.includes("at");
          if ((keys.includes(key) && own[key] === undefined) || isTurn)
            setIn(builder, target, pointerTo(pointer, key), initialValue(type, key, this.context.around));
        }
      });
    });
  }

  private choiceRow(
    label: string,
    id: string,
    names: string[],
    active: number,
    chosen: (index: number) => void,
  ): HTMLElement {
    const select = element("select", {
      id: `field${id}`,
      "data-key": `field${id}`,
      disabled: this.context.isDisabled,
      on: { change: () => chosen(select.selectedIndex) },
    });
    for (const name of names) select.append(element("option", { text: name }));
    select.selectedIndex = active;
    return element(
      "div",
      { class: "row" },
      element("label", { for: `field${id}`, text: label }),
      element("div", { class: "control" }, select),
    );
  }
}

const valueObject = (target: Target, pointer: string): JsonObject => {
  const found = changedAt(target, pointer);
  return isObject(found) ? found : {};
};
