// The controls of what a tool draws with. Lengths are typed in the unit of the store.

import { element } from "../../panel/dom";
import type { Json } from "../document/json";
import { namesIn } from "../form/initial";
import { entry, type Place } from "../form/inputs";
import { numberFrom, Unreadable } from "../form/parse";
import { row } from "../form/row";
import { tidy } from "../geometry/units";
import type { Planner } from "../planner";
import { say, text } from "../text";
import type { AngleKey, LengthKey, Settings } from "./settings";

interface Written {
  shown: string;
  placeholder?: string;
  unit?: string;
  isRequired?: boolean;
  read: (typed: string) => Json;
  commit: (value: Json | undefined) => void;
}

export class ToolFields {
  constructor(readonly planner: Planner) {}

  get now(): Settings {
    return this.planner.settings.now;
  }

  set(changed: Partial<Settings>): void {
    this.planner.settings.set(changed);
  }

  /** A text field under the name of a setting. */
  typed(key: keyof typeof text.draw.settings, field: Written): HTMLElement {
    const { json, shared, unit } = this.planner.document;
    const label = text.draw.settings[key];
    const { placeholder = "", unit: unitName = "", isRequired = true, ...rest } = field;
    const id = `tool/${key}`;
    const around = { json, shared, unit, part: null };
    const place: Place = { id, key: "", label, around, isDisabled: false, isRequired, problemId: "" };
    return row(label, entry(place, { id, label, placeholder, unit: unitName, ...rest }));
  }

  length(key: LengthKey): HTMLElement {
    const { unit } = this.planner.document;
    return this.typed(key, {
      shown: String(tidy(this.now[key] / unit.factor, unit)),
      unit: unit.name,
      read: (typed) => {
        const value = numberFrom(typed, "length", unit);
        if (value <= 0) throw new Unreadable(text.picture.not_positive);
        return value;
      },
      commit: (value) => this.set({ [key]: Number(value) * unit.factor }),
    });
  }

  angle(key: AngleKey, least: number, most: number): HTMLElement {
    return this.typed(key, {
      shown: String(this.now[key]),
      unit: "°",
      read: (typed) => within(numberFrom(typed, "degrees", this.planner.document.unit, { least, most }), least, most),
      commit: (value) => this.set({ [key]: Number(value) }),
    });
  }

  select<Value extends string>(
    name: string,
    values: readonly [Value, string][],
    chosen: Value | null,
    choose: (value: Value) => void,
  ): HTMLElement {
    const control = element(
      "select",
      { "aria-label": name, "data-key": `tool/${name}`, on: { change: () => choose(control.value as Value) } },
      ...values.map(([value, label]) => element("option", { value, text: label, selected: value === chosen })),
    );
    return row(name, control);
  }

  /** One of two choices. */
  either(
    name: string,
    { yes, no }: { yes: string; no: string },
    now: boolean,
    choose: (now: boolean) => void,
  ): HTMLElement {
    const values: ["yes" | "no", string][] = [
      ["yes", yes],
      ["no", no],
    ];
    return this.select(name, values, now ? "yes" : "no", (value) => choose(value === "yes"));
  }

  /** The type of transceivers. */
  unitType(): HTMLElement {
    const { document, unitTool } = this.planner;
    const names = namesIn(document.json, "transceiver_types", document.shared);
    return this.select(
      text.draw.settings.unitType,
      names.map((name) => [name, name]),
      unitTool.type ?? null,
      (unitType) => this.set({ unitType }),
    );
  }
}

export function within(value: number, least: number, most: number): number {
  if (value < least) throw new Unreadable(say(text.form.too_small, least));
  if (value > most) throw new Unreadable(say(text.form.too_large, most));
  return value;
}
