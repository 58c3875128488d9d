// Fields of the tab about plans.

import { element } from "../../panel/dom";

interface Bounds {
  least: number;
  most: number;
  step?: number;
}

/** A number with its name and unit. `usual`: shown while it is empty, the default of the program. */
export class NumberField {
  readonly input: HTMLInputElement;
  readonly unit: HTMLElement;
  readonly root: HTMLElement;

  constructor(name: string, unit: string, { least, most, step }: Bounds, usual = "") {
    this.input = element("input", { type: "number", min: least, max: most, step: step ?? "any", placeholder: usual });
    this.unit = element("small", { text: unit });
    this.root = element("label", { class: "row" }, element("span", { text: name }), this.input, this.unit);
  }

  /** Undefined: none, or one that does not fit. */
  get value(): number | undefined {
    const { value, validity, valueAsNumber } = this.input;
    return value === "" || !validity.valid ? undefined : valueAsNumber;
  }
}

export class CheckBox {
  readonly input = element("input", { type: "checkbox" });
  readonly root: HTMLElement;

  constructor(name: string, says = "", picture: Node | null = null) {
    this.root = element("label", { class: "check", title: says }, this.input, picture, element("span", { text: name }));
  }

  get isOn(): boolean {
    return this.input.checked;
  }
}
