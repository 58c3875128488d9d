// Details of the selected label or unit.

import { reachClass } from "../scene/classes";
import { element, button } from "../../panel/dom";
import { counted, fixed, grouped, percent, significant } from "../../data/format";
import { decibels } from "../data/decibels";
import type { Contribution, Model } from "../data/model";
import type { Selection } from "../data/state";
import { partsOf, say, text } from "../data/text";

const mostRows = 12;

export class Card {
  readonly root = element("section", { class: "v3-card", "aria-live": "polite", hidden: true });

  constructor(
    private readonly model: Model,
    private readonly show: (selection: NonNullable<Selection>) => void,
  ) {}

  update(): void {
    const { selection } = this.model.state;
    this.root.hidden = selection === null;
    if (selection === null) this.root.replaceChildren();
    else if (selection.kind === "label") this.showLabel(selection.index);
    else this.showUnit(selection.index);
  }

  private signal(value: number, digits = 3): string {
    return significant(value / this.model.store.unit.factor, digits);
  }

  private head(kind: string, id: string): HTMLElement {
    const { selection } = this.model.state;
    return element(
      "header",
      {},
      element("div", {}, element("small", { text: kind }), element("h3", { text: id })),
      button(text.card.show, () => selection && this.show(selection), {
        class: "v3-small",
        "aria-label": say(text.card.look, id),
      }),
      button("×", () => this.model.select(null), {
        class: "v3-small",
        "aria-label": text.card.close,
        "data-key": "close",
      }),
    );
  }

  private facts(facts: [string, string, string?][]): HTMLElement {
    const list = element("dl", { class: "v3-facts" });
    for (const [name, value, key] of facts)
      list.append(element("dt", { text: name }), element("dd", { text: value, "data-fact": key }));
    return list;
  }

  private at(position: Float32Array, index: number): [number[], string] {
    const at = Array.from(position.subarray(3 * index, 3 * index + 3));
    return [at, say(text.card.place, ...at.map((value) => fixed(value, 2)))];
  }

  private showLabel(label: number): void {
    const { store, coverage } = this.model;
    const [, place] = this.at(store.label.position, label);
    const { name } = store.unit;
    const signal = coverage.signal[label];
    const found = this.model.contributions(label);
    const rows = found.slice(0, mostRows).map((link, k) => this.row(link, k));
    const rest = found.slice(mostRows).reduce((sum, { mean }) => sum + mean, 0);
    const margin = element("strong", { text: decibels(coverage.margin(label)), "data-fact": "margin" });
    this.root.replaceChildren(
      this.head(store.labels.kinds[store.label.kind[label]].type, store.labels.names[label]),
      element(
        "p",
        { class: coverage.met[label] ? "v3-met" : "v3-unmet" },
        ...partsOf(coverage.met[label] ? text.card.above : text.card.not_reached, margin),
      ),
      this.facts([
        ...this.certified(label),
        ...this.inShop(label),
        [
          store.redundant ? text.card.signal_redundant : text.card.signal,
          `${this.signal(signal)}\u00a0${name}`,
          "signal",
        ],
        [text.card.requirement, `${this.signal(coverage.requirement(label))}\u00a0${name}`, "requirement"],
        [text.card.serving, counted(text.numbers.units, coverage.serving[label]), "serving"],
        [text.card.level, String(store.label.level[label] + 1)],
        [text.card.position, place],
        ...this.id(label),
      ]),
      found.length ? this.table(rows, name) : element("p", { class: "v3-note", text: text.card.nothing }),
      found.length > mostRows
        ? element("p", {
            class: "v3-note",
            text: say(text.card.rest, grouped(found.length - mostRows), `${this.signal(rest)}\u00a0${name}`),
          })
        : "",
    );
  }

  /** Second, after the name. */
  private id(label: number): [string, string][] {
    const { ids, names } = this.model.store.labels;
    return names[label] === ids[label] ? [] : [[text.card.id, ids[label]]];
  }

  private certified(label: number): [string, string, string?][] {
    if (!this.model.store.certificate) return [];
    const verdict = this.model.verdict(label);
    return [[text.card.verdict, verdict === null ? text.card.original_only : text.verdicts[verdict], "verdict"]];
  }

  /** In the chosen state of the shop. */
  private inShop(label: number): [string, string, string?][] {
    const { shop } = this.model;
    if (!shop) return [];
    const missed = this.model.missedInShop();
    const verdict =
      missed === null
        ? text.card.original_only
        : missed.has(label)
          ? text.shop.verdicts.missed
          : text.shop.verdicts.reached;
    return [[say(text.card.in_state, shop.number), verdict, "in-state"]];
  }

  private table(rows: HTMLElement[], unit: string): HTMLElement {
    const { signals } = this.model;
    const head = element("tr", {}, element("th", { text: text.card.unit }), element("th", { text: unit, class: "n" }));
    if (signals.error.length)
      head.append(element("th", { text: text.card.error, class: "n", title: text.card.error_title }));
    if (signals.directShare.length)
      head.append(element("th", { text: text.card.direct, title: text.card.direct_title }));
    return element("table", {}, element("thead", {}, head), element("tbody", {}, ...rows));
  }

  private row({ unit, mean, error, directShare }: Contribution, k: number): HTMLElement {
    const { store } = this.model;
    const number = this.model.numberOf(unit);
    const row = element(
      "tr",
      { "data-unit": unit },
      element(
        "td",
        {},
        element("span", { class: "v3-badge", text: number === undefined ? "+" : String(number) }),
        button(store.units.ids[unit], () => this.model.select({ kind: "unit", index: unit }), {
          class: "v3-link",
          "data-key": `row${k}`,
        }),
      ),
      element("td", { class: "n", text: this.signal(mean), "data-fact": "mean" }),
    );
    const { signals } = this.model;
    if (signals.error.length)
      row.append(
        element("td", {
          class: "n",
          text: error === null ? "–" : `±\u00a0${this.signal(error, 2)}`,
          "data-fact": "error",
        }),
      );
    if (signals.directShare.length && directShare === null)
      row.append(element("td", { text: "–", "data-fact": "direct" }));
    if (directShare !== null) {
      const bar = element("span", { class: "v3-bar", "aria-hidden": "true" });
      bar.style.setProperty("--share", `${(100 * directShare).toFixed(1)}%`);
      row.append(
        element(
          "td",
          { class: "v3-share" },
          bar,
          element("span", { text: percent(directShare, 0), "data-fact": "direct" }),
        ),
      );
    }
    return row;
  }

  private showUnit(unit: number): void {
    const { store, coverage, state } = this.model;
    const [at, place] = this.at(store.candidate.position, unit);
    const links = this.model.reachOf(unit);
    const classes = [0, 0, 0, 0];
    let farthest = 0;
    for (const { label, mean } of links) {
      const need = coverage.requirement(label);
      const alone = coverage.isMet(mean, need);
      ++classes[reachClass(mean / need, alone)];
      const p = store.label.position.subarray(3 * label, 3 * label + 3);
      if (alone) farthest = Math.max(farthest, Math.hypot(p[0] - at[0], p[1] - at[1], p[2] - at[2]));
    }
    const on = state.on[unit] !== 0;
    const number = this.model.numberOf(unit);
    const type = store.units.types[unit];
    const kind = number === undefined ? say(text.card.candidate, type) : say(text.card.planned, number, type);
    const facts: [string, string, string?][] = [
      [text.card.alone, counted(text.numbers.labels, coverage.reach[unit]), "alone"],
      [text.card.farthest, farthest > 0 ? `${fixed(farthest, 1)}\u00a0m` : "–"],
      [text.card.high, counted(text.numbers.labels, classes[2])],
      [text.card.low, counted(text.numbers.labels, classes[1])],
      [text.card.position, place],
    ];
    if (store.units.places[unit]) facts.push([text.card.in_shop, store.units.places[unit], "place"]);
    if (store.units.orders[type]) facts.push([text.card.order, store.units.orders[type], "order"]);
    if (!store.redundant || !on)
      facts.unshift([
        on ? text.card.needed_by : text.card.would_add,
        counted(text.numbers.labels, coverage.decides[unit]),
        "decides",
      ]);
    this.root.replaceChildren(
      this.head(kind, store.units.ids[unit]),
      element(
        "p",
        {},
        button(on ? text.card.switch_off : text.card.switch_on, () => this.model.switchUnit(unit, !on), {
          class: "v3-primary",
          "data-key": "switch",
        }),
      ),
      this.facts(facts),
    );
  }
}
