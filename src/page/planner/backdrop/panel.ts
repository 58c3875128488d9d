// The panel of the picture of the floor plan.

import { button, element } from "../../panel/dom";
import type { Commands, CommandId } from "../access/commands";
import { openMenu } from "../access/menu";
import { outlineMenu } from "../actions/outlines";
import { component, entry, type Place } from "../form/inputs";
import { numberFrom, numbersFrom, numbersText, Unreadable, unitText } from "../form/parse";
import { drawingUnits } from "../geometry/units";
import type { Planner } from "../planner";
import { layerRows } from "../sheet/layer_rows";
import { say, text } from "../text";
import type { Drawing, Line } from "./drawing";
import { checkText, editDrawing, isTraced } from "./edits";
import { comparisonOf, cropBetween, turnedTo, withScale } from "./transform";

const row = (name: string, ...controls: (HTMLElement | null)[]) =>
  element(
    "div",
    { class: "row" },
    element("span", { class: "name", text: name }),
    element("div", { class: "control" }, ...controls),
  );

export class PicturePanel {
  constructor(
    private readonly planner: Planner,
    private readonly commands: Commands,
  ) {}

  content(drawing: Drawing): HTMLElement[] {
    const { planner } = this;
    const { picture } = planner;
    const why = picture.state.kind === "failed" ? picture.state.why : "";
    return [
      element(
        "header",
        {},
        element("h2", { text: drawing.file }),
        element("p", { class: "subtitle", text: text.picture.title }),
        why === "" ? null : element("p", { class: "problem", role: "alert", text: why }),
        element(
          "div",
          { class: "buttons" },
          this.command("choose_picture", text.picture.other_file),
          this.command("remove_picture", text.form.remove),
        ),
      ),
      element("section", { class: "form" }, ...this.lookRows()),
      element("section", { class: "form" }, ...this.placeRows(drawing)),
      element("section", { class: "form" }, ...this.unitRows(drawing), ...this.scaleRows(drawing)),
      ...this.layerRows(drawing),
      element(
        "div",
        { class: "buttons" },
        button(text.types.close, () => planner.openType(null), { "data-key": "close-picture" }),
      ),
    ];
  }

  private stateOf({ scale, unit }: Drawing): string {
    if (scale) return text.picture.unchecked;
    return unit === undefined ? text.picture.no_scale : "";
  }

  private command(id: CommandId, name: string): HTMLElement {
    return button(name, () => this.commands.run(id), {
      class: "small",
      title: text.commands[id],
      "aria-label": `${name}: ${text.commands[id]}`,
      disabled: !this.commands.isEnabled(id),
      "data-key": id,
    });
  }

  private lookRows(): HTMLElement[] {
    const { look } = this.planner;
    const flag = (key: "isShown" | "isLocked" | "isGrey" | "isInverted", name: string) => {
      const box = element("input", {
        type: "checkbox",
        "data-key": `picture/${key}`,
        on: { change: () => look.set({ [key]: box.checked }) },
      });
      box.checked = look.now[key];
      return element("label", {}, box, name);
    };
    const slider = element("input", {
      type: "range",
      min: 0,
      max: 100,
      step: 5,
      "aria-label": text.picture.fade,
      "data-key": "picture/fade",
      on: { input: () => look.set({ fade: 0.01 * Number(slider.value) }) },
    });
    slider.value = String(Math.round(100 * look.now.fade));
    const flags = [
      flag("isShown", text.picture.shown),
      flag("isLocked", text.picture.locked),
      flag("isGrey", text.picture.grey),
      flag("isInverted", text.picture.inverted),
    ];
    return [element("div", { class: "flags" }, ...flags), row(text.picture.fade, slider)];
  }

  private entry(
    key: string,
    label: string,
    shown: string,
    measure: "length" | "degrees",
    write: (value: number, drawing: Drawing) => Drawing,
    { unit = unitText(measure, this.planner.document.unit), isPositive = false } = {},
  ): HTMLElement {
    return entry(this.placeOf(key, label), {
      id: `picture/${key}`,
      label,
      shown,
      placeholder: "",
      unit,
      read: (typed) => {
        const value = numberFrom(typed, measure, this.planner.document.unit);
        if (isPositive && value <= 0) throw new Unreadable(text.picture.not_positive);
        return value;
      },
      commit: (value) => this.write(label, (drawing) => write(Number(value), drawing)),
    });
  }

  private placeOf(key: string, label: string): Place {
    const { json, shared, unit, locked } = this.planner.document;
    return {
      id: `picture/${key}`,
      key: "",
      label,
      around: { json, shared, unit, part: null },
      isDisabled: locked !== null,
      isRequired: key !== "crop",
      problemId: "",
    };
  }

  private write(what: string, change: (drawing: Drawing) => Drawing): void {
    const { drawing } = this.planner;
    if (drawing) void editDrawing(this.planner, say(text.edits.change, what, text.picture.title), change(drawing));
  }

  private placeRows(drawing: Drawing): HTMLElement[] {
    const { unit } = this.planner.document;
    const names = text.components.position;
    const coordinate = (axis: 0 | 1) =>
      component(
        names[axis],
        this.entry(
          `at/${axis}`,
          say(text.form.component, text.picture.at, names[axis]),
          String(drawing.at[axis]),
          "length",
          (value, now) => ({ ...now, at: axis === 0 ? [value, now.at[1]] : [now.at[0], value] }),
          { unit: axis === 1 ? unit.name : "" },
        ),
      );
    const turn = drawing.rotation_deg ?? 0;
    return [
      row(text.picture.at, element("span", { class: "vector" }, coordinate(0), coordinate(1))),
      row(
        text.fields.rotation_deg,
        this.entry("turn", text.fields.rotation_deg, String(turn), "degrees", (value, now) =>
          turnedTo(now, unit, value),
        ),
        this.command("turn_picture_back", "−90°"),
        this.command("turn_picture", "+90°"),
      ),
      row(text.picture.crop, this.cropEntry(drawing), this.command("crop", text.picture.draw)),
    ];
  }

  private cropEntry({ crop, size }: Drawing): HTMLElement {
    return entry(this.placeOf("crop", text.picture.crop), {
      id: "picture/crop",
      label: text.picture.crop_says,
      shown: numbersText(crop),
      placeholder: numbersText([0, 0, ...size]),
      unit: "",
      read: (typed) => {
        try {
          return numbersFrom(typed, "none", this.planner.document.unit, 4);
        } catch {
          throw new Unreadable(text.picture.not_crop);
        }
      },
      commit: (value) =>
        this.write(text.picture.crop, (drawing) => {
          const [left, upper, right, lower] = Array.isArray(value) ? value.map(Number) : [0, 0, ...size];
          return { ...drawing, crop: cropBetween(drawing, [left, upper], [right, lower]) };
        }),
    });
  }

  /** Of a DXF drawing. A unit takes the place of lines of known length. */
  private unitRows({ unit, origin }: Drawing): HTMLElement[] {
    if (!origin) return [];
    const choice = element(
      "select",
      {
        "data-key": "picture/unit",
        "aria-label": text.dxf.unit,
        on: {
          change: () =>
            this.write(text.dxf.unit, (now) => ({ ...now, unit: choice.value, scale: undefined, check: undefined })),
        },
      },
      ...(unit === undefined ? [element("option", { value: "", text: text.dxf.by_scale })] : []),
      ...[...drawingUnits.keys()].map((name) =>
        element("option", { value: name, text: name, selected: name === unit }),
      ),
    );
    return [row(text.dxf.unit, choice)];
  }

  private layerRows(drawing: Drawing): HTMLElement[] {
    const { picture, look } = this.planner;
    const layers = picture.sheet?.layers ?? [];
    if (layers.length === 0) return [];
    const decide = (decided: Record<string, boolean>) => look.decideLayers(drawing.file, decided);
    const take = (layer: number, x: number, y: number) => {
      this.planner.offerOutlines(this.planner.traced.outlinesOf(layer));
      openMenu(this.commands, [outlineMenu], x, y, () => this.planner.offerOutlines(null));
    };
    return [layerRows(layers, picture.hidden, { decide, take })];
  }

  private scaleRows(drawing: Drawing): HTMLElement[] {
    const { document } = this.planner;
    const length = (key: "scale" | "check", write: (line: Line, now: Drawing) => Drawing) => {
      const line = drawing[key];
      if (!line) return null;
      const change = (value: number, now: Drawing) => write({ ...(now[key] ?? line), length: value }, now);
      return this.entry(key, text.picture[key], String(line.length), "length", change, { isPositive: true });
    };
    const keeps = isTraced(document.json) ? "line" : "corner";
    const words = checkText(this.planner, drawing);
    return [
      row(
        text.picture.scale,
        length("scale", (line, now) => withScale(now, document.unit, { line, isStraight: false, keeps })),
        this.command("scale", text.picture.draw),
      ),
      row(
        text.picture.check,
        length("check", (check, now) => ({ ...now, check })),
        this.command("check_scale", text.picture.draw),
      ),
      element("p", {
        class: comparisonOf(drawing)?.agrees === false ? "problem" : "note",
        text: words || this.stateOf(drawing),
      }),
    ];
  }
}
