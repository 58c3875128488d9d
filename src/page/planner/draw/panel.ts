// The panel of a tool that draws: what it draws with.

import { element } from "../../panel/dom";
import { namesIn } from "../form/initial";
import { numberFrom, Unreadable } from "../form/parse";
import { lengthText } from "../geometry/units";
import { isOneSided, sizeOf, type Template } from "../make/run";
import type { Planner } from "../planner";
import { say, text } from "../text";
import { mountRows } from "../units/tool_rows";
import { ToolFields } from "./fields";
import { materialFor, type Purpose } from "./materials";
import type { OpeningKind } from "./settings";
import { modelOf, templateOf } from "./template";
import type { DrawTool } from "./tools";

/** The number of rows, which has the focus when the tool begins. */
export const countField = "tool/count";

/** Not the name of a preset. */
const likeKey = "\0";

export class ToolPanel {
  private readonly fields: ToolFields;

  constructor(private readonly planner: Planner) {
    this.fields = new ToolFields(planner);
  }

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
        return [this.fields.length("thickness")];
      case "zone":
        return [this.fields.length("zoneHeight")];
      case "opening":
        return [
          this.openings(opening),
          ...(opening === "window"
            ? [this.fields.length("sill"), this.fields.length("lintel")]
            : [this.fields.length("doorHeight")]),
          ...(opening === "open" ? [] : [this.materials(opening)]),
        ];
      case "block":
        return [
          this.column(isColumn),
          ...(isColumn ? [] : [this.fields.length("blockHeight")]),
          this.materials("block"),
        ];
      case "area":
        return [this.fields.unitType(), this.fields.length("spacing")];
      case "run":
        return this.presets();
      case "rows":
        return [this.count()];
      case "unit":
      case "rail":
      case "faces":
        return mountRows(this.fields, tool);
      default:
        return [];
    }
  }

  private count(): HTMLElement {
    const { settings, document } = this.planner;
    const field = this.fields.typed("count", {
      shown: String(settings.now.count),
      read: (typed) => {
        const value = numberFrom(typed, "none", document.unit);
        if (!Number.isInteger(value) || value < 2 || value > 1000) throw new Unreadable(text.draw.not_count);
        return value;
      },
      commit: (value) => settings.set({ count: Number(value) }),
    });
    // Esc first takes a new text back.
    field.addEventListener("keydown", ({ key }) => key === "Escape" && this.planner.setTool("select"));
    field.dataset.field = countField;
    return field;
  }

  private openings(opening: OpeningKind): HTMLElement {
    const kinds = Object.entries(text.draw.openings) as [OpeningKind, string][];
    return this.fields.select(text.draw.settings.opening, kinds, opening, (kind) =>
      this.planner.settings.set({ opening: kind }),
    );
  }

  private materials(purpose: Purpose): HTMLElement {
    const { document, settings } = this.planner;
    return this.fields.select(
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
    return this.fields.select(text.draw.settings.block, kinds, isColumn ? "column" : "block", (kind) =>
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
    const isThere = model !== null && namesIn(document.json, "fixtures").includes(model.id);
    if (usable.length === 0 && !model) return [element("p", { class: "note", text: text.draw.no_presets })];
    const like: [string, string][] = model
      ? [[likeKey, isThere ? say(text.draw.like, model.id) : text.draw.like_last]]
      : template
        ? []
        : [["", text.draw.choose]];
    const control = this.fields.select(
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
