// The units on the plan, with the number of labels that each reaches alone.

import { counted, grouped } from "../../../data/format";
import { button, element, replaceChildren } from "../../../panel/dom";
import { unitStates } from "../../document/devices";
import type { UnitOnPlan } from "../../document/messages";
import type { Planner } from "../../planner";
import { say, text } from "../../text";
import { deviceItem } from "../../view/hit";

const most = 200;

interface Row {
  root: HTMLElement;
  name: HTMLButtonElement;
  alone: HTMLElement;
}

export class UnitList {
  private readonly list = element("ul", { class: "light-list" });
  private readonly note = element("p", { class: "note", hidden: true });
  readonly root = element("div", {}, this.list, this.note);
  private of: readonly UnitOnPlan[] | null = null;
  private rows: Row[] = [];

  constructor(
    private readonly planner: Planner,
    /** Moves the picture there. */
    private readonly show: (unit: number) => void,
  ) {}

  /** During a drag only numbers change, often. */
  update(): void {
    const { units } = this.planner.light;
    if (this.of !== units) this.build(units);
    this.rows.forEach((row, k) => this.refresh(row, units[k]));
  }

  private build(units: readonly UnitOnPlan[]): void {
    this.of = units;
    this.rows = units.slice(0, most).map(({ index, id }) => this.row(index, id));
    replaceChildren(
      this.list,
      this.rows.map(({ root }) => root),
    );
    this.note.hidden = units.length <= most;
    this.note.textContent = say(text.light.more_units, grouped(units.length - most));
  }

  private row(index: number, id: string): Row {
    const name = button(id, () => this.go(index), { class: "plain", "data-key": `unit-${index}` });
    const alone = element("small", {});
    return { root: element("li", {}, name, alone), name, alone };
  }

  private refresh({ root, name, alone }: Row, { index, key }: UnitOnPlan): void {
    const { light, document, selection } = this.planner;
    const isThere = index < document.units.count;
    const state = unitStates[document.units.state[index]] ?? "candidate";
    const count = light.reachOf(key);
    const words = count === null ? "…" : counted(text.light.alone, count);
    if (alone.textContent !== words) alone.textContent = words;
    const title = isThere ? text.light.units[state] : "";
    if (root.title !== title) root.title = title;
    const isSelected = isThere && selection.has(deviceItem(document.units, index));
    if (isSelected !== (name.ariaCurrent === "true")) name.ariaCurrent = isSelected ? "true" : null;
  }

  private go(index: number): void {
    const { document, selection } = this.planner;
    if (index >= document.units.count) return;
    selection.set([deviceItem(document.units, index)]);
    this.show(index);
  }
}
