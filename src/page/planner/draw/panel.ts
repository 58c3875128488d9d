// The panel of a tool that draws: what it draws with. Lengths are typed in the unit of the store.

import { element } from "../../panel/dom";
import { namesIn } from "../form/initial";
import { entry, type Place } from "../form/inputs";
import { numberFrom, Unreadable } from "../form/parse";
import { lengthText, tidy } from "../geometry/units";
import { isOneSided, sizeOf, type Preset } from "../make/run";
import type { Planner } from "../planner";
import { say, text } from "../text";
import { siteOf } from "./finish";
import type { OpeningKind, Settings } from "./settings";
import type { DrawTool } from "./tools";

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
          ...(opening === "open" ? [] : [this.materials()]),
        ];
      case "block":
        return [this.column(isColumn), ...(isColumn ? [] : [this.length("blockHeight")]), this.materials()];
      case "area":
        return [this.length("spacing")];
      case "run":
        return [this.presets()];
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

  private materials(): HTMLElement {
    const { document, settings } = this.planner;
    const names = namesIn(document.json, "materials", document.shared);
    const chosen = settings.now.material ?? names[0] ?? null;
    return this.select(
      text.draw.settings.material,
      names.map((name) => [name, name]),
      chosen,
      (material) => settings.set({ material }),
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

  /** The catalogue: one preset is chosen. Arrow keys move through the list. */
  private presets(): HTMLElement {
    const { presets, settings, document } = this.planner;
    const site = siteOf(this.planner);
    const usable = presets.all.filter((preset) => sizeOf(site, preset) !== null);
    if (usable.length === 0) return element("p", { class: "note", text: text.draw.no_presets });
    const says = (preset: Preset) => {
      const size = sizeOf(site, preset);
      const side = isOneSided(preset) ? text.draw.one_sided : "";
      const parts = size
        ? [size.length, size.depth, size.height].map((metres) => lengthText(metres, document.unit))
        : [];
      return say(text.draw.preset_size, ...parts, side);
    };
    return element(
      "fieldset",
      { class: "catalogue" },
      element("legend", { text: text.draw.settings.preset }),
      ...usable.map((preset) => {
        const input = element("input", {
          type: "radio",
          name: "preset",
          "data-key": `tool/preset/${preset.name}`,
          on: { change: () => settings.set({ preset: preset.name }) },
        });
        input.checked = settings.now.preset === preset.name;
        return element(
          "label",
          {},
          input,
          element("span", { text: preset.name }),
          element("small", { text: says(preset) }),
        );
      }),
    );
  }
}
