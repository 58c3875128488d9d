// The scale bar: a round length of the store as it is on the screen.

import { element } from "../../panel/dom";
import type { LengthUnit } from "../geometry/units";
import type { Planner } from "../planner";

const longest = 130; // pixels

/** The longest of 1, 2 or 5 times a power of ten that fits, in a unit. */
export function roundLength(scale: number, unit: number): number {
  const most = longest / (scale * unit);
  const power = 10 ** Math.floor(Math.log10(most));
  return ([5, 2, 1].find((factor) => factor * power <= most) ?? 1) * power;
}

/** People read metres, centimetres or feet, also if the file is in millimetres or inches. */
function readUnit({ name, factor }: LengthUnit, scale: number): { name: string; factor: number } {
  if (name === "ft" || name === "in")
    return scale * 0.3048 > longest ? { name: "in", factor: 0.0254 } : { name: "ft", factor: 0.3048 };
  return scale > longest ? { name: "cm", factor: 0.01 } : { name: "m", factor: name === "m" ? factor : 1 };
}

export class ScaleBar {
  private readonly bar = element("span", { class: "bar" });
  private readonly words = element("span", { class: "words" });
  readonly root = element("div", { class: "scale", "aria-hidden": "true" }, this.words, this.bar);

  constructor(private readonly planner: Planner) {}

  update(): void {
    const { viewport, document, isPlan } = this.planner;
    this.root.hidden = !isPlan;
    const unit = readUnit(document.unit, viewport.scale);
    const length = roundLength(viewport.scale, unit.factor);
    this.words.textContent = `${Number(length.toPrecision(3))}\u00a0${unit.name}`;
    this.bar.style.width = `${(length * unit.factor * viewport.scale).toFixed(1)}px`;
  }
}
