// What labels need, gamma tau of every kind, to be changed and put back.

import { element } from "../panel/dom";
import { decibels, grouped, percent } from "./format";
import type { Model } from "./model";

const mostDecibels = 10;

interface Row {
  number: HTMLInputElement;
  slider: HTMLInputElement;
  change: HTMLElement;
  share: HTMLElement;
}

export class Thresholds {
  readonly root = element("section", { class: "v3-box" }, element("h3", { text: "What labels need" }));
  private readonly rows: Row[] = [];

  constructor(private readonly model: Model) {
    const { kinds } = model.store.labels;
    kinds.forEach((kind, k) => this.root.append(this.row(k, kind.type)));
  }

  private row(kind: number, type: string): HTMLElement {
    const { factor, name } = this.model.store.unit;
    const planned = this.model.store.labels.kinds[kind].requirement;
    const set = (value: number) => {
      if (!(value > 0) || !Number.isFinite(value)) return;
      this.model.state.requirements[kind] = value;
      this.model.recount();
    };
    const number = element("input", {
      type: "number",
      min: 0,
      step: "any",
      "aria-label": `Threshold of ${type} labels, ${name}`,
      on: { change: () => (number.value === "" ? this.update() : set(Number(number.value) * factor)) },
    });
    const slider = element("input", {
      type: "range",
      min: -mostDecibels,
      max: mostDecibels,
      step: 0.1,
      "aria-label": `Threshold of ${type} labels against the plan, dB`,
      on: {
        input: () => set(Number(slider.value) === 0 ? planned : planned * 10 ** (Number(slider.value) / 10)),
      },
    });
    const change = element("output", { class: "v3-note" });
    const share = element("output", { "data-kind": kind });
    this.rows.push({ number, slider, change, share });
    return element(
      "div",
      { class: "v3-need" },
      element("div", {}, element("strong", { text: type }), share),
      element("div", {}, element("label", {}, number, ` ${name}`), change),
      slider,
    );
  }

  update(): void {
    const { store, state } = this.model;
    this.rows.forEach(({ number, slider, change, share }, kind) => {
      const value = state.requirements[kind];
      const planned = store.labels.kinds[kind].requirement;
      number.value = String(Number((value / store.unit.factor).toPrecision(6)));
      const shift = 10 * Math.log10(value / planned);
      slider.value = String(shift);
      slider.setAttribute("aria-valuetext", value === planned ? "as planned" : decibels(shift));
      change.textContent = value === planned ? "as planned" : `${decibels(shift)} against the plan`;
      const { met, all } = this.model.share((label) => store.label.kind[label] === kind);
      share.textContent = `${percent(all ? met / all : 1)} reached (${grouped(met)} of ${grouped(all)})`;
    });
  }
}
