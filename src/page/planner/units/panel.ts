// The part of the properties that belongs to the selected units: what is said of them, and for a single one its
// direction, type and power.

import { button, element } from "../../panel/dom";
import type { Commands } from "../access/commands";
import { chordText } from "../access/keys";
import { within } from "../draw/fields";
import { namesIn } from "../form/initial";
import { entry, type Place } from "../form/inputs";
import { numberFrom } from "../form/parse";
import { row } from "../form/row";
import type { Planner } from "../planner";
import { say, text } from "../text";
import { changeUnits, marks, type UnitValues } from "./act";
import { headed, headingOf, tilted, tiltOf, type Aim } from "./aim";
import { aimOf, chosenUnits, powerOf, whyFixed } from "./chosen";
import { allHave } from "./commands";

/** Names of directions, clockwise from north, in steps of 45 degrees. */
const winds = ["n", "ne", "e", "se", "s", "sw", "w", "nw"];

export class UnitPanel {
  constructor(
    private readonly planner: Planner,
    private readonly commands: Commands,
  ) {}

  /** Nothing unless units alone are selected. */
  content(): HTMLElement[] {
    const { planner } = this;
    const chosen = chosenUnits(planner);
    if (chosen.length === 0) return [];
    const [index] = chosen;
    const rows = chosen.length === 1 && planner.document.units.pathOf(index) !== null ? this.rows(index) : [];
    return [element("section", { class: "form units" }, this.states(chosen), ...rows)];
  }

  private states(chosen: readonly number[]): HTMLElement {
    const states = marks.map((mark) => {
      const [key] = this.commands.get(`unit_${mark}`).keys;
      return button(text.units.marks[mark], () => this.commands.run(`unit_${mark}`), {
        class: "chip",
        "aria-pressed": String(allHave(this.planner, chosen, mark)),
        disabled: !this.commands.isEnabled(`unit_${mark}`),
        title: say(text.access.with_key, text.commands[`unit_${mark}`], chordText(key)),
        "data-key": `unit/${mark}`,
      });
    });
    return element("div", { class: "chips", role: "group", "aria-label": text.units.state }, ...states);
  }

  private rows(index: number): HTMLElement[] {
    const { planner } = this;
    const { axis, roll_deg } = aimOf(planner, index);
    const heading = headingOf(axis);
    const isListed = planner.document.units.isListed(index);
    const { tilt, head, turn } = text.units.steps;
    // Those of entries of the list are among their other fields.
    const own = isListed
      ? []
      : [
          this.type(index),
          this.number(index, "roll", String(roll_deg), "°", [-360, 360], turn, (_, roll) => ({ roll_deg: roll })),
          this.number(
            index,
            "power",
            String(powerOf(planner, index)),
            "",
            [0.001, 1000],
            text.units.steps.power,
            (_, power) => ({ power }),
          ),
        ];
    return [
      this.number(index, "tilt", String(tiltOf(axis)), "°", [0, 180], tilt, tilted),
      this.number(index, "heading", heading === null ? "" : String(heading), "°", [-360, 360], head, headed),
      ...own,
    ];
  }

  private place(index: number, key: string, label: string): Place {
    const { json, shared, unit } = this.planner.document;
    const around = { json, shared, unit, part: null };
    const isDisabled =
      whyFixed(this.planner, index) !== null ||
      (key === "heading" && headingOf(aimOf(this.planner, index).axis) === null);
    return { id: `unit/${key}`, key: "", label, around, isDisabled, isRequired: true, problemId: "" };
  }

  private number(
    index: number,
    key: "tilt" | "heading" | "roll" | "power",
    shown: string,
    unit: string,
    [least, most]: [number, number],
    label: string,
    valuesOf: (aim: Aim, value: number) => UnitValues,
  ): HTMLElement {
    const name = text.units.fields[key];
    const field = entry(this.place(index, key, name), {
      id: `unit/${key}`,
      label: text.units.labels[key],
      shown,
      placeholder: "",
      unit,
      read: (typed) => {
        const wind = key === "heading" ? winds.indexOf(typed.toLowerCase()) : -1;
        if (wind >= 0) return 45 * wind;
        return within(numberFrom(typed, "degrees", this.planner.document.unit, { least, most }), least, most);
      },
      commit: (value) =>
        void changeUnits(this.planner, [index], label, (at) => valuesOf(aimOf(this.planner, at), Number(value))),
    });
    return this.field(key, row(name, field));
  }

  private field(key: string, made: HTMLElement): HTMLElement {
    made.dataset.field = `/unit/${key}`;
    return made;
  }

  private type(index: number): HTMLElement {
    const { document, answers } = this.planner;
    const type = answers.now("unit", index)?.type ?? "";
    const names = namesIn(document.json, "transceiver_types", document.shared);
    const name = text.fields.type;
    const select = element(
      "select",
      {
        "aria-label": name,
        "data-key": "unit/type",
        disabled: whyFixed(this.planner, index) !== null,
        on: {
          change: () =>
            void changeUnits(this.planner, [index], say(text.edits.assign, "{0}", select.value), () => ({
              type: select.value,
            })),
        },
      },
      ...names.map((value) => element("option", { value, text: value, selected: value === type })),
    );
    return this.field("type", row(name, select));
  }
}
