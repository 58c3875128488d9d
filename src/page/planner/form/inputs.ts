// The controls of single values. Values of presets and defaults are grey; a change is one step of the history.

import { element } from "../../panel/dom";
import type { Json } from "../document/json";
import { say, text } from "../text";
import type { FieldType, Measure, NameList } from "./field";
import { initialValue, namesIn, roomWithoutZones, type Surroundings } from "./initial";
import {
  jsonFrom,
  numberFrom,
  numbersFrom,
  numbersText,
  numberText,
  pointsFrom,
  pointsText,
  Unreadable,
  unitText,
} from "./parse";
import type { Shown } from "./targets";
import { fits, optionOf } from "./variants";

/** Computes the new value of each element from its present one; undefined removes it. */
export type Commit = (next: (present: Json | undefined) => Json | undefined) => void;

export interface Place {
  /** Of the control. */
  id: string;
  key: string;
  label: string;
  around: Surroundings;
  isDisabled: boolean;
  isRequired: boolean;
  /** Null removes the value of a preset. */
  isRemovable?: boolean;
  /** The id of the error text. */
  problemId: string;
}

interface Entry {
  shown: string;
  placeholder: string;
  unit: string;
  label: string;
  id: string;
  read: (typed: string) => Json;
  commit: (value: Json | undefined) => void;
  lines?: number;
}

const typingPause = 400; // ms; half a number is no mistake

/** A text field that accepts only what it can read. */
export function entry(place: Place, { shown, placeholder, unit, label, id, read, commit, lines }: Entry): HTMLElement {
  const why = element("span", { class: "why", role: "alert", hidden: true, id: `${id}-why` });
  const attributes = {
    id,
    "data-key": id,
    "aria-label": label,
    "aria-describedby": `${id}-why ${place.problemId}`,
    placeholder,
    disabled: place.isDisabled,
    autocomplete: "off",
    spellcheck: "false",
  };
  const input =
    lines === undefined
      ? element("input", { type: "text", ...attributes })
      : element("textarea", { rows: Math.min(Math.max(lines, 2), 8), ...attributes });
  input.value = shown;
  input.dataset.shown = shown;
  // Enter is followed by a change event with the same text.
  let last = shown;
  /** Reads the text, and says what is wrong with it. */
  const judge = (use: (value: Json | undefined) => void) => {
    const typed = input.value.trim();
    why.textContent = "";
    try {
      use(typed === "" ? undefined : read(typed));
    } catch (error) {
      if (!(error instanceof Unreadable)) throw error;
      why.textContent = error.message;
    }
    why.hidden = why.textContent === "";
    input.ariaInvalid = String(!why.hidden);
  };
  const changed = () => {
    clearTimeout(timer);
    const typed = input.value.trim();
    if (typed === last) return;
    last = typed;
    input.dataset.shown = typed;
    judge((value) => {
      if (value === undefined && place.isRequired) input.value = shown;
      else commit(value);
    });
  };
  let timer: ReturnType<typeof setTimeout> | undefined;
  input.addEventListener("input", () => {
    clearTimeout(timer);
    timer = setTimeout(judge, typingPause, () => {});
  });
  input.addEventListener("change", changed);
  input.addEventListener("keydown", (event) => {
    const { key, ctrlKey } = event as KeyboardEvent;
    if (key === "Escape" && input.value !== shown) {
      clearTimeout(timer);
      input.value = shown;
      input.dataset.shown = shown;
      last = shown;
      why.hidden = true;
      input.ariaInvalid = "false";
      event.stopPropagation();
    } else if (key === "Enter" && (lines === undefined || ctrlKey)) {
      changed();
      if (input.ariaInvalid !== "true") input.blur(); // the next keys are for the plan
    } else if (key === "Escape") input.blur();
  });
  return element("span", { class: "entry" }, input, unit ? element("span", { class: "unit", text: unit }) : null, why);
}

const mixedOr = (shown: Shown, base: string): string => (shown.isMixed ? text.form.mixed : base);

function numberInput(
  place: Place,
  { measure, isInteger, least, most }: Extract<FieldType, { kind: "number" }>,
  shown: Shown,
  commit: Commit,
): HTMLElement {
  const { unit } = place.around;
  return entry(place, {
    id: place.id,
    label: place.label,
    shown: numberText(shown.own),
    placeholder: mixedOr(shown, numberText(shown.base)),
    unit: unitText(measure, unit),
    read: (typed) => {
      const value = numberFrom(typed, measure, unit, { least, most });
      if (isInteger && !Number.isInteger(value)) throw new Unreadable(text.form.not_whole);
      if (value < least) throw new Unreadable(say(text.form.too_small, least));
      if (value > most) throw new Unreadable(say(text.form.too_large, most));
      return value;
    },
    commit: (value) => commit(() => value),
  });
}

/** The names of the numbers of a vector. */
function componentsOf(key: string, size: number): string[] {
  const named = (text.components as Record<string, string[] | undefined>)[key];
  return named?.length === size ? named : text.components.position.slice(0, size);
}

/** One number of a vector, with its name. */
export const component = (name: string, input: HTMLElement): HTMLElement =>
  element("span", { class: "component" }, element("span", { class: "axis", text: name, "aria-hidden": "true" }), input);

function vectorInput(place: Place, size: number, measure: Measure, shown: Shown, commit: Commit): HTMLElement {
  const { unit } = place.around;
  const names = componentsOf(place.key, size);
  const at = (value: Json | undefined, k: number) => (Array.isArray(value) ? numberText(value[k]) : "");
  return element(
    "span",
    { class: "vector" },
    ...names.map((name, k) =>
      component(
        name,
        entry(place, {
          id: `${place.id}/${k}`,
          label: say(text.form.component, place.label, name),
          shown: at(shown.own, k),
          placeholder: mixedOr(shown, at(shown.base, k)),
          unit: k === size - 1 ? unitText(measure, unit) : "",
          read: (typed) => numberFrom(typed, measure, unit),
          commit: (value) =>
            commit((present) => {
              if (value === undefined) return undefined;
              const list = Array.isArray(present) ? [...present] : new Array<Json>(size).fill(0);
              list[k] = value;
              return list;
            }),
        }),
      ),
    ),
  );
}

function listInput(
  place: Place,
  type: Extract<FieldType, { kind: "numbers" | "points" | "json" | "text" }>,
  shown: Shown,
  commit: Commit,
) {
  const { unit } = place.around;
  const measure = type.kind === "numbers" || type.kind === "points" ? type.measure : "none";
  const textOf = (value: Json | undefined): string => {
    if (value === undefined) return "";
    if (type.kind === "text") return String(value);
    if (type.kind === "json") return JSON.stringify(value);
    return type.kind === "points" ? pointsText(value) : numbersText(value);
  };
  const read = (typed: string): Json => {
    if (type.kind === "text") return typed;
    if (type.kind === "json") return jsonFrom(typed);
    return type.kind === "points" ? pointsFrom(typed, type.size, measure, unit) : numbersFrom(typed, measure, unit);
  };
  const own = textOf(shown.own);
  const base = textOf(shown.base);
  return entry(place, {
    id: place.id,
    label: place.label,
    shown: own,
    placeholder: mixedOr(shown, base),
    unit: unitText(measure, unit),
    read,
    commit: (value) => commit(() => value),
    lines: type.kind === "points" || type.kind === "json" ? (own || base).split("\n").length : undefined,
  });
}

/** Not a name of the store. */
const nothing = "\0";

/** One of several names. The first option is the inherited value, or none; another one removes an inherited value. */
function choiceInput(place: Place, names: string[], shown: Shown, commit: Commit, nameOf = (value: string) => value) {
  const inherited = typeof shown.base === "string" ? nameOf(shown.base) : "";
  const select = element("select", {
    id: place.id,
    "data-key": place.id,
    "aria-label": place.label,
    "aria-describedby": place.problemId,
    disabled: place.isDisabled,
    class: shown.own === undefined ? "inherited" : "",
    on: {
      change: () => commit(() => (select.value === nothing ? null : select.value === "" ? undefined : select.value)),
    },
  });
  const own = shown.own === null ? nothing : typeof shown.own === "string" ? shown.own : "";
  const first = shown.isMixed
    ? text.form.mixed
    : inherited !== ""
      ? own === ""
        ? inherited
        : say(text.form.inherit, inherited)
      : text.form.none;
  if (!place.isRequired || own === "") select.append(element("option", { value: "", text: first }));
  // A name that is not there (any more) stays visible; the server says what is wrong with it.
  const isKnown = own === "" || own === nothing || names.includes(own);
  const all = isKnown ? names : [own, ...names];
  if (own === nothing || (place.isRemovable && inherited !== ""))
    select.append(element("option", { value: nothing, text: text.form.none }));
  for (const name of all) select.append(element("option", { value: name, text: nameOf(name) }));
  select.value = own;
  return select;
}

function flagInput(place: Place, shown: Shown, commit: Commit): HTMLElement {
  const box = element("input", {
    type: "checkbox",
    id: place.id,
    "data-key": place.id,
    "aria-label": place.label,
    "aria-describedby": place.problemId,
    disabled: place.isDisabled,
    on: { change: () => commit(() => box.checked) },
  });
  box.checked = (shown.own ?? shown.base) === true;
  box.indeterminate = shown.isMixed;
  return box;
}

function setInput(place: Place, values: string[], shown: Shown, commit: Commit): HTMLElement {
  const present = shown.own ?? shown.base;
  return element(
    "span",
    { class: shown.own === undefined ? "flags inherited" : "flags" },
    ...values.map((value) => {
      const box = element("input", {
        type: "checkbox",
        "data-key": `${place.id}/${value}`,
        "aria-describedby": place.problemId,
        disabled: place.isDisabled,
        on: {
          change: () =>
            commit((now) => {
              const list = Array.isArray(now) ? now : Array.isArray(shown.base) ? shown.base : [];
              return values.filter((name) => (name === value ? box.checked : list.includes(name)));
            }),
        },
      });
      box.checked = Array.isArray(present) && present.includes(value);
      box.indeterminate = shown.isMixed;
      return element("label", {}, box, optionName(value));
    }),
  );
}

/** What people call a value of the file. */
export const optionName = (value: string): string => (text.options as Record<string, string>)[value] ?? value;

function constantText(value: Json): HTMLElement {
  return element("span", { class: "constant", text: optionName(String(value)) });
}

/** Chooses one of several types of a value. */
export function typeChoice(place: Place, options: FieldType[], shown: Shown, commit: Commit): HTMLSelectElement {
  const present = shown.own ?? shown.base;
  const active = optionOf(options, present);
  const select = element("select", {
    class: "form-of-value",
    "data-key": `${place.id}/form`,
    "aria-label": say(text.form.form_of, place.label),
    disabled: place.isDisabled,
    on: {
      change: () => {
        const type = options[select.selectedIndex];
        commit((now) => (fits(type, now) ? now : initialValue(type, place.key, place.around)));
      },
    },
  });
  for (const type of options) select.append(element("option", { text: formName(type) }));
  select.selectedIndex = options.indexOf(active);
  return select;
}

function formName(type: FieldType): string {
  return type.kind === "constant" ? optionName(String(type.value)) : (text.forms as Record<string, string>)[type.kind];
}

/** The control of a value without keys of its own. */
export function leafInput(place: Place, type: FieldType, shown: Shown, commit: Commit): HTMLElement | null {
  const { json, shared, presets } = place.around;
  const names = (of: NameList) => (of === "presets" && presets ? [...presets] : namesIn(json, of, shared));
  switch (type.kind) {
    case "number":
      return numberInput(place, type, shown, commit);
    case "vector":
      return vectorInput(place, type.size, type.measure, shown, commit);
    case "flag":
      return flagInput(place, shown, commit);
    case "choice":
      return choiceInput(place, type.values, shown, commit, optionName);
    case "name":
      return choiceInput(place, names(type.of), shown, commit, (name) =>
        type.of === "areas" && name === "room"
          ? text.kinds.room
          : type.of === "areas" && name === roomWithoutZones
            ? text.form.room_without_zones
            : name,
      );
    case "set":
      return setInput(place, type.values, shown, commit);
    case "constant":
      return constantText(type.value);
    case "numbers":
    case "points":
    case "json":
    case "text":
      return listInput(place, type, shown, commit);
    default:
      return null;
  }
}

/** Also of a text that stands for no value, whose message must stay. */
export const isTyping = (field: HTMLElement): boolean =>
  (field instanceof HTMLInputElement || field instanceof HTMLTextAreaElement) &&
  field.dataset.shown !== undefined &&
  (field.value.trim() !== field.dataset.shown || field.ariaInvalid === "true");

/** Chosen names that are cut off can be read as a hint. */
export function nameFully(panel: HTMLElement): void {
  panel.addEventListener("pointerover", ({ target }) => {
    if (!(target instanceof HTMLSelectElement)) return;
    const around = target.parentElement?.closest<HTMLElement>("[title]")?.title;
    target.title = [target.selectedOptions[0]?.text, around].filter(Boolean).join("\n");
  });
}
