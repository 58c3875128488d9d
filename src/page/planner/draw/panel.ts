// The panel of a tool that draws: what it draws with. Lengths are typed in the unit of the store.

import { element } from "../../panel/dom";
import { namesIn } from "../form/initial";
import { entry, type Place } from "../form/inputs";
import { numberFrom, Unreadable } from "../form/parse";
import { lengthText, tidy } from "../geometry/units";
import { isOneSided, sizeOf, type Template } from "../make/run";
import type { Planner } from "../planner";
import { say, text } from "../text";
import { materialFor, type Purpose } from "./materials";
import type { OpeningKind, Settings } from "./settings";
import { modelOf, templateOf } from "./template";
import type { DrawTool } from "./tools";

/** Not the name of a preset. */
const likeKey = "\0";

type LengthKey = {
  [Key in keyof Settings]: Settings[Key] extends number ? (Key extends "count" ? never : Key) : never;
}[keyof Settings];

const row = (name: string, control: HTMLElement) =>
  element(
    "div",
    { class: "row" },
    element("span", { class: "name", text: name }),
    element("div", { class: "control" }, control),
  );

export class ToolPanel {
  constructor(private readonly planner: Planner) {}

  content(tool: DrawTool): HTMLElement[] {
    return [
      element(
        "header",
        {},
        element("h2", { text: text.commands[`draw_${tool}`] }),
        element("p", { class: "subtitle", text: text.draw.says[tool] }),
      ),
      element("section", { class: "form" }, ...this.rows(tool)),
    ];
  }

  private rows(tool: DrawTool): HTMLElement[] {
    const { opening, isColumn } = this.planner.settings.now;
    switch (tool) {
      case "wall":
        return [this.length("thickness")];
      case "zone":
        return [this.length("zoneHeight")];
      case "opening":
        return [
          this.openings(opening),
          ...(opening === "window" ? [this.length("sill"), this.length("lintel")] : [this.length("doorHeight")]),
          ...(opening === "open" ? [] : [this.materials(opening)]),
        ];
      case "block":
        return [this.column(isColumn), ...(isColumn ? [] : [this.length("blockHeight")]), this.materials("block")];
      case "area":
        return [this.length("spacing")];
      case "run":
        return this.presets();
      case "rows":
        return [this.count()];
      default:
        return [];
    }
  }

  private placeOf(key: keyof Settings, label: string): Place {
    const { json, shared, unit } = this.planner.document;
    const around = { json, shared, unit, part: null };
    return { id: `tool/${key}`, key: "", label, around, isDisabled: false, isRequired: true, problemId: "" };
  }

  private count(): HTMLElement {
    const { settings } = this.planner;
    const label = text.draw.settings.count;
    const place = this.placeOf("count", label);
    return row(
      label,
      entry(place, {
        id: place.id,
        label,
        shown: String(settings.now.count),
        placeholder: "",
        unit: "",
        read: (typed) => {
          const value = numberFrom(typed, "none", this.planner.document.unit);
          if (!Number.isInteger(value) || value < 2 || value > 1000) throw new Unreadable(text.draw.not_count);
          return value;
        },
        commit: (value) => settings.set({ count: Number(value) }),
      }),
    );
  }

  private length(key: LengthKey): HTMLElement {
    const { document, settings } = this.planner;
    const { unit } = document;
    const label = text.draw.settings[key];
    const place = this.placeOf(key, label);
    return row(
      label,
      entry(place, {
        id: place.id,
        label,
        shown: String(tidy(settings.now[key] / unit.factor, unit)),
        placeholder: "",
        unit: unit.name,
        read: (typed) => {
          const value = numberFrom(typed, "length", unit);
          if (value <= 0) throw new Unreadable(text.picture.not_positive);
          return value;
        },
        commit: (value) => settings.set({ [key]: Number(value) * unit.factor }),
      }),
    );
  }

  private select<Value extends string>(
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

  private openings(opening: OpeningKind): HTMLElement {
    const kinds = Object.entries(text.draw.openings) as [OpeningKind, string][];
    return this.select(text.draw.settings.opening, kinds, opening, (kind) =>
      this.planner.settings.set({ opening: kind }),
    );
  }

  private materials(purpose: Purpose): HTMLElement {
    const { document, settings } = this.planner;
    return this.select(
      text.draw.settings.material,
      namesIn(document.json, "materials", document.shared).map((name) => [name, name]),
      materialFor(this.planner, purpose) ?? null,
      (material) => settings.set({ materials: { ...settings.now.materials, [purpose]: material } }),
    );
  }

  private column(isColumn: boolean): HTMLElement {
    const kinds: ["block" | "column", string][] = [
      ["block", text.draw.blocks.block],
      ["column", text.draw.blocks.column],
    ];
    return this.select(text.draw.settings.block, kinds, isColumn ? "column" : "block", (kind) =>
      this.planner.settings.set({ isColumn: kind === "column" }),
    );
  }

  /** The catalogue of the project, and the fixture that the next one is like. */
  private presets(): HTMLElement[] {
    const { planner } = this;
    const { presets, settings, document } = planner;
    const usable = presets.all.filter(({ effective }) => sizeOf(effective, document.unit) !== null);
    const template = templateOf(planner);
    const model = template && modelOf(planner);
    if (usable.length === 0 && !model) return [element("p", { class: "note", text: text.draw.no_presets })];
    const like: [string, string][] = model
      ? [[likeKey, say(text.draw.like, model.id)]]
      : template
        ? []
        : [["", text.draw.choose]];
    const control = this.select(
      text.draw.settings.preset,
      [...like, ...usable.map(({ name }): [string, string] => [name, name])],
      model ? likeKey : (template?.preset ?? ""),
      (preset) => settings.set({ preset, isLike: false }),
    );
    return template ? [control, element("p", { class: "note", text: this.saysOf(template) })] : [control];
  }

  private saysOf({ effective, preset, module }: Template): string {
    const { unit } = this.planner.document;
    const size = sizeOf(effective, unit);
    const name = modelOf(this.planner) && preset !== null ? `${preset}: ` : "";
    const [length, depth, height] = [module ?? 0, size?.depth ?? 0, size?.height ?? 0].map((metres) =>
      lengthText(metres, unit),
    );
    const side = isOneSided(effective) ? text.draw.one_sided : "";
    return name + say(module === null ? text.draw.free_size : text.draw.preset_size, length, depth, height, side);
  }
}
