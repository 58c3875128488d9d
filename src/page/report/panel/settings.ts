// The settings of the reader: visible shelf levels, and the requirement gamma tau of every kind of label.

import { button, element } from "../../panel/dom";
import { grouped, percent } from "../../data/format";
import { decibels } from "../data/decibels";
import type { Model } from "../data/model";
import { say, text } from "../data/text";

export class Levels {
  readonly root = element("section", { class: "v3-box" }, element("h3", { text: text.levels.title }));
  private readonly boxes: HTMLInputElement[] = [];
  private readonly shares: HTMLElement[] = [];
  private readonly goods: HTMLInputElement;

  constructor(private readonly model: Model) {
    const { store } = model;
    const list = element("ul", { class: "v3-list v3-levels" });
    // From the top level down.
    for (let level = store.levels.length - 1; level >= 0; --level) {
      const box = element("input", {
        type: "checkbox",
        on: { change: () => this.set((shown, k) => (k === level ? box.checked : shown)) },
      });
      const share = element("small", { "data-level": level + 1 });
      const { from, to } = store.levels[level];
      const heights = from === to ? from : say(text.levels.heights, from, to);
      this.boxes[level] = box;
      this.shares[level] = share;
      list.append(
        element(
          "li",
          {},
          element(
            "label",
            {},
            box,
            element("span", {}, element("strong", { text: String(level + 1) }), ` ${heights}\u00a0m`, share),
          ),
          store.levels.length > 1
            ? button(text.levels.only, () => this.set((_, k) => k === level), {
                class: "v3-small",
                "aria-label": say(text.levels.only_title, level + 1),
              })
            : null,
        ),
      );
    }
    this.goods = element("input", {
      type: "checkbox",
      on: {
        change: () => {
          model.state.goods = this.goods.checked;
          model.changed();
        },
      },
    });
    this.root.append(
      list,
      element(
        "div",
        { class: "v3-row" },
        store.levels.length > 1 ? button(text.levels.all, () => this.set(() => true), { class: "v3-small" }) : null,
        store.part.look.includes(2) ? element("label", {}, this.goods, text.levels.goods) : null,
      ),
    );
  }

  private set(shown: (was: boolean, level: number) => boolean): void {
    this.model.state.levels = this.model.state.levels.map(shown);
    this.model.changed();
  }

  update(): void {
    const { store, state } = this.model;
    this.goods.checked = state.goods;
    this.boxes.forEach((box, level) => {
      box.checked = state.levels[level];
      const { met, all } = this.model.share((label) => store.label.level[label] === level);
      this.shares[level].textContent = say(text.numbers.share, grouped(met), grouped(all));
    });
  }
}

const mostDecibels = 10;

interface Row {
  number: HTMLInputElement;
  slider: HTMLInputElement;
  change: HTMLElement;
  share: HTMLElement;
}

export class Thresholds {
  readonly root = element("section", { class: "v3-box" }, element("h3", { text: text.requirements.title }));
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
      "aria-label": say(text.requirements.number, type, name),
      on: { change: () => (number.value === "" ? this.update() : set(Number(number.value) * factor)) },
    });
    const slider = element("input", {
      type: "range",
      min: -mostDecibels,
      max: mostDecibels,
      step: 0.1,
      "aria-label": say(text.requirements.slider, type),
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
      slider.setAttribute("aria-valuetext", value === planned ? text.requirements.as_planned : decibels(shift));
      change.textContent =
        value === planned ? text.requirements.as_planned : say(text.requirements.changed, decibels(shift));
      const { met, all } = this.model.share((label) => store.label.kind[label] === kind);
      share.textContent = say(text.requirements.reached, percent(all ? met / all : 1), grouped(met), grouped(all));
    });
  }
}
