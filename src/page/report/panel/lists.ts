// Searchable lists of units and labels: everything clickable in the picture is also available here.

import { button, element, replaceChildren } from "../../panel/dom";
import { counted, grouped } from "../../data/format";
import { decibels } from "../data/decibels";
import type { Model } from "../data/model";
import { say, text } from "../data/text";

const mostRows = 60;

abstract class SearchList {
  readonly root = element("div", { class: "v3-search" });
  private readonly search: HTMLInputElement;
  private readonly list = element("ul", { class: "v3-list" });
  private readonly note = element("p", { class: "v3-note" });

  constructor(
    protected readonly model: Model,
    search: string,
    lead: string,
  ) {
    this.search = element("input", {
      type: "search",
      placeholder: search,
      "aria-label": search,
      on: { input: () => this.update() },
    });
    this.root.append(element("p", { class: "v3-note", text: lead }), this.search, this.list, this.note);
  }

  protected abstract order(): number[];
  protected abstract id(index: number): string;
  protected name(index: number): string {
    return this.id(index);
  }
  protected abstract row(index: number): HTMLElement;

  protected entry(
    kind: "unit" | "label",
    index: number,
    marks: Node[],
    pressed: () => void,
    note: string,
  ): HTMLElement {
    const link = button(this.name(index), pressed, { class: "v3-link", "data-key": `${kind}${index}` });
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
    const found = this.order().filter((index) =>
      [this.id(index), this.name(index)].some((text) => text.toLowerCase().includes(wanted)),
    );
    replaceChildren(
      this.list,
      found.slice(0, mostRows).map((index) => this.row(index)),
    );
    this.note.textContent =
      found.length === 0
        ? text.lists.none
        : found.length > mostRows
          ? say(text.lists.more, grouped(found.length - mostRows))
          : "";
  }
}

export class UnitList extends SearchList {
  constructor(model: Model) {
    super(model, text.lists.units.search, text.lists.units.lead);
  }

  protected order(): number[] {
    const { reach } = this.model.coverage;
    const rank = (unit: number) => this.model.numberOf(unit) ?? Infinity;
    return [...reach.keys()].sort((a, b) => (rank(a) === rank(b) ? reach[b] - reach[a] || a - b : rank(a) - rank(b)));
  }

  protected id(unit: number): string {
    return this.model.store.units.ids[unit];
  }

  protected row(unit: number): HTMLElement {
    const { coverage, state, store } = this.model;
    const on = state.on[unit] !== 0;
    const number = this.model.numberOf(unit);
    const effect = on ? text.lists.units.needed : text.lists.units.adds;
    const texts = store.redundant && on ? text.lists.units.reach : effect;
    const note = counted(texts, coverage.reach[unit], grouped(coverage.decides[unit]));
    const box = element("input", {
      type: "checkbox",
      "data-key": `on${unit}`,
      "aria-label": say(text.lists.units.on, this.id(unit)),
      on: { change: (event) => this.model.switchUnit(unit, (event.target as HTMLInputElement).checked) },
    });
    box.checked = on;
    const mark = number === undefined ? (on ? "+" : "·") : String(number);
    const badge = element("span", { class: on ? "v3-badge" : "v3-badge off", text: mark });
    const select = () => this.model.select({ kind: "unit", index: unit });
    return this.entry("unit", unit, [box, badge], select, note);
  }
}

export class LabelList extends SearchList {
  constructor(
    model: Model,
    private readonly show: (label: number) => void,
  ) {
    super(model, text.lists.labels.search, text.lists.labels.lead);
  }

  protected order(): number[] {
    const { coverage } = this.model;
    const missed = this.model.missedInShop();
    const margins = Float64Array.from(coverage.signal, (_, label) => coverage.margin(label));
    const rank = (label: number) => (missed?.has(label) ? 0 : 1);
    return [...margins.keys()].sort((a, b) => rank(a) - rank(b) || margins[a] - margins[b] || a - b);
  }

  protected id(label: number): string {
    return this.model.store.labels.ids[label];
  }

  protected override name(label: number): string {
    return this.model.store.labels.names[label];
  }

  protected row(label: number): HTMLElement {
    const { coverage } = this.model;
    const missed = this.model.missedInShop()?.has(label);
    const isMet = coverage.met[label] && !missed;
    const dot = element("span", { class: isMet ? "v3-dot" : "v3-dot unmet", "aria-hidden": "true" });
    const margin = decibels(coverage.margin(label));
    const note = isMet
      ? margin
      : say(missed ? text.lists.labels.missed_in_state : text.lists.labels.not_reached, margin);
    return this.entry("label", label, [dot], () => this.show(label), note);
  }
}
