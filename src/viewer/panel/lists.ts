// Searchable lists of units and labels: everything clickable in the picture is also available here.

import { button, element, replaceChildren } from "./dom";
import { counted, decibels, grouped } from "../data/format";
import type { Model } from "../data/model";

const mostRows = 60;

abstract class SearchList {
  readonly root = element("div", { class: "v3-search" });
  private readonly search: HTMLInputElement;
  private readonly list = element("ul", { class: "v3-list" });
  private readonly note = element("p", { class: "v3-note" });

  constructor(
    protected readonly model: Model,
    kind: string,
    lead: string,
  ) {
    this.search = element("input", {
      type: "search",
      placeholder: `Search ${kind} by id`,
      "aria-label": `Search ${kind} by id`,
      on: { input: () => this.update() },
    });
    this.root.append(element("p", { class: "v3-note", text: lead }), this.search, this.list, this.note);
  }

  protected abstract order(): number[];
  protected abstract id(index: number): string;
  protected abstract row(index: number): HTMLElement;

  protected entry(kind: "unit" | "label", index: number, marks: Node[], pressed: () => void, note: string): HTMLElement {
    const link = button(this.id(index), pressed, { class: "v3-link", "data-key": `${kind}${index}` });
    return element(
      "li",
      { class: this.model.isSelected(kind, index) ? "selected" : "", [`data-${kind}`]: index },
      ...marks,
      element("div", {}, link, element("small", { text: note })),
    );
  }

  update(): void {
    if (this.root.hidden) return;
    const wanted = this.search.value.trim().toLowerCase();
    const found = this.order().filter((index) => this.id(index).toLowerCase().includes(wanted));
    replaceChildren(
      this.list,
      found.slice(0, mostRows).map((index) => this.row(index)),
    );
    this.note.textContent =
      found.length === 0
        ? "No id matches."
        : found.length > mostRows
          ? `${grouped(found.length - mostRows)} more: search to find them.`
          : "";
  }
}

export class UnitList extends SearchList {
  constructor(model: Model) {
    super(
      model,
      "units",
      "Switch any candidate on or off to update all numbers. Planned units come first, then the candidates that reach the most labels alone.",
    );
  }

  protected order(): number[] {
    const { reach } = this.model.coverage;
    const rank = (unit: number) => this.model.numberOf(unit) ?? Infinity;
    return [...reach.keys()].sort((a, b) =>
      rank(a) === rank(b) ? reach[b] - reach[a] || a - b : rank(a) - rank(b),
    );
  }

  protected id(unit: number): string {
    return this.model.store.units.ids[unit];
  }

  protected row(unit: number): HTMLElement {
    const { coverage, state, store } = this.model;
    const on = state.on[unit] !== 0;
    const number = this.model.numberOf(unit);
    const decides = coverage.decides[unit];
    const effect = store.redundant && on ? "" : on ? `, needed by ${grouped(decides)}` : `, would add ${grouped(decides)}`;
    const box = element("input", {
      type: "checkbox",
      "data-key": `on${unit}`,
      "aria-label": `${this.id(unit)} is on`,
      on: { change: (event) => this.model.switchUnit(unit, (event.target as HTMLInputElement).checked) },
    });
    box.checked = on;
    const text = number === undefined ? (on ? "+" : "·") : String(number);
    const badge = element("span", { class: on ? "v3-badge" : "v3-badge off", text });
    const select = () => this.model.select({ kind: "unit", index: unit });
    return this.entry("unit", unit, [box, badge], select, `${counted(coverage.reach[unit], "label")} alone${effect}`);
  }
}

export class LabelList extends SearchList {
  constructor(
    model: Model,
    private readonly show: (label: number) => void,
  ) {
    super(model, "labels", "Choose a label to see the units whose signals it receives. The smallest margin comes first.");
  }

  protected order(): number[] {
    const { coverage } = this.model;
    const margins = Float64Array.from(coverage.signal, (_, label) => coverage.margin(label));
    return [...margins.keys()].sort((a, b) => margins[a] - margins[b] || a - b);
  }

  protected id(label: number): string {
    return this.model.store.labels.ids[label];
  }

  protected row(label: number): HTMLElement {
    const { coverage } = this.model;
    const dot = element("span", { class: coverage.met[label] ? "v3-dot" : "v3-dot unmet", "aria-hidden": "true" });
    const note = decibels(coverage.margin(label)) + (coverage.met[label] ? "" : ", not reached");
    return this.entry("label", label, [dot], () => this.show(label), note);
  }
}
