// Details of the selected label or unit.

import { reachClass } from "../scene/classes";
import { element, button } from "./dom";
import { counted, decibels, fixed, grouped, percent, significant } from "../data/format";
import type { Contribution, Model } from "../data/model";
import type { Selection } from "../data/state";

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
      button("Show", () => selection && this.show(selection), { class: "v3-small", "aria-label": `Look at ${id}` }),
      button("×", () => this.model.select(null), { class: "v3-small", "aria-label": "Close", "data-key": "close" }),
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
    return [at, at.map((value) => fixed(value, 2)).join(", ") + "\u00a0m"];
  }

  private showLabel(label: number): void {
    const { store, coverage } = this.model;
    const [, place] = this.at(store.label.position, label);
    const { name } = store.unit;
    const signal = coverage.signal[label];
    const found = this.model.contributions(label);
    const rows = found.slice(0, mostRows).map((link, k) => this.row(link, k));
    const rest = found.slice(mostRows).reduce((sum, { mean }) => sum + mean, 0);
    this.root.replaceChildren(
      this.head(store.labels.kinds[store.label.kind[label]].type, store.labels.ids[label]),
      element(
        "p",
        { class: coverage.met[label] ? "v3-met" : "v3-unmet" },
        element("strong", { text: decibels(coverage.margin(label)), "data-fact": "margin" }),
        coverage.met[label] ? " above the requirement" : " – not reached",
      ),
      this.facts([
        ...this.certified(label),
        [store.redundant ? "Signal without strongest unit" : "Signal", `${this.signal(signal)}\u00a0${name}`, "signal"],
        ["Requirement", `${this.signal(coverage.requirement(label))}\u00a0${name}`, "requirement"],
        ["Reached alone by", counted(coverage.serving[label], "unit"), "serving"],
        ["Level", String(store.label.level[label] + 1)],
        ["Position", place],
      ]),
      found.length
        ? this.table(rows, name)
        : element("p", { class: "v3-note", text: "This label receives no signal from the units that are on." }),
      found.length > mostRows
        ? element("p", {
            class: "v3-note",
            text: `${grouped(found.length - mostRows)} more units contribute ${this.signal(rest)}\u00a0${name} in total.`,
          })
        : "",
    );
  }

  private certified(label: number): [string, string, string?][] {
    if (!this.model.store.certificate) return [];
    return [["Verdict", this.model.verdict(label) ?? "for the original plan only", "verdict"]];
  }

  private table(rows: HTMLElement[], unit: string): HTMLElement {
    const { signals } = this.model;
    const head = element("tr", {}, element("th", { text: "Unit" }), element("th", { text: unit, class: "n" }));
    if (signals.error.length) head.append(element("th", { text: "± error", class: "n", title: "standard error" }));
    if (signals.directShare.length) head.append(element("th", { text: "direct", title: "share that arrives without reflection" }));
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
      row.append(element("td", { class: "n", text: error === null ? "–" : `±\u00a0${this.signal(error, 2)}`, "data-fact": "error" }));
    if (signals.directShare.length && directShare === null) row.append(element("td", { text: "–", "data-fact": "direct" }));
    if (directShare !== null) {
      const bar = element("span", { class: "v3-bar", "aria-hidden": "true" });
      bar.style.setProperty("--share", percent(directShare, 1).replace("\u00a0", ""));
      row.append(
        element("td", { class: "v3-share" }, bar, element("span", { text: percent(directShare, 0), "data-fact": "direct" })),
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
    const kind = `${number === undefined ? "Candidate" : `Unit ${number} of the plan`}, ${store.units.types[unit]}`;
    const facts: [string, string, string?][] = [
      ["Reaches alone", counted(coverage.reach[unit], "label"), "alone"],
      ["Farthest reached", farthest > 0 ? `${fixed(farthest, 1)}\u00a0m` : "–"],
      ["10 to 100 % of requirement at", counted(classes[2], "label")],
      ["1 to 10 % of requirement at", counted(classes[1], "label")],
      ["Position", place],
    ];
    if (!store.redundant || !on)
      facts.unshift([on ? "Needed by" : "Would add", counted(coverage.decides[unit], "label"), "decides"]);
    this.root.replaceChildren(
      this.head(kind, store.units.ids[unit]),
      element(
        "p",
        {},
        button(on ? "Switch off" : "Switch on", () => this.model.switchUnit(unit, !on), {
          class: "v3-primary",
          "data-key": "switch",
        }),
      ),
      this.facts(facts),
    );
  }
}
