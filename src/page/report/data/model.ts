// The state of the view and the values derived from it.

import { classesOf, withMissed, type Classes } from "../scene/classes";
import { Coverage } from "../scene/coverage";
import { changedUnits, initialState, switchUnit, type Selection, type State } from "./state";
import { verdicts, type ShopState, type Signals, type Store } from "./store";

/** One entry of the matrix. */
export interface Contribution {
  label: number;
  unit: number;
  mean: number;
  error: number | null;
  directShare: number | null;
}

const known = (value: number | undefined) => (value === undefined || Number.isNaN(value) ? null : value);

export class Model {
  state: State;
  readonly coverage: Coverage;
  /** Labels that the plan reaches under its own requirements. */
  readonly plannedReached: number;
  private readonly numbers = new Map<number, number>();
  private readonly installed: Set<number>;
  private readonly listeners: (() => void)[] = [];

  constructor(
    readonly store: Store,
    readonly signals: Signals,
  ) {
    this.state = initialState(store);
    this.coverage = new Coverage(store, signals);
    this.coverage.update(this.state.on, this.state.requirements);
    this.plannedReached = this.coverage.reached;
    store.units.selected.forEach((unit, k) => this.numbers.set(unit, k + 1));
    this.installed = new Set(store.units.installed);
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  /** Notifies listeners of changes other than units and requirements. */
  changed(): void {
    for (const listener of this.listeners) listener();
  }

  /** Recomputes after a change of units or requirements. */
  recount(): void {
    this.coverage.update(this.state.on, this.state.requirements);
    this.changed();
  }

  replace(state: State): void {
    this.state = state;
    this.recount();
  }

  switchUnit(unit: number, on: boolean): void {
    switchUnit(this.store, this.state, unit, on);
    this.recount();
  }

  select(selection: Selection): void {
    this.state.selection = selection;
    this.changed();
  }

  isSelected(kind: "label" | "unit", index: number): boolean {
    return this.state.selection?.kind === kind && this.state.selection.index === index;
  }

  get classes(): Classes {
    const classes = classesOf(this.store, this.coverage, this.state.mode, this.isAsPlanned());
    const missed = this.missedInShop();
    return missed ? withMissed(classes, missed) : classes;
  }

  /** The chosen state of the shop; null for the shop as in the store file. */
  get shop(): ShopState | null {
    return this.state.shop === null ? null : this.store.states[this.state.shop];
  }

  /** The labels out of reach in the chosen state; null without one or after changes of the plan. */
  missedInShop(): Set<number> | null {
    return this.shop && this.isAsPlanned() ? new Set(this.shop.missed) : null;
  }

  /** The certified verdict on a label; null without a certificate or after changes. */
  verdict(label: number): (typeof verdicts)[number] | null {
    return this.store.certificate && this.isAsPlanned() ? verdicts[this.store.label.verdict[label]] : null;
  }

  /** The number of a planned unit in the table of the report; undefined for other candidates. */
  numberOf(unit: number): number | undefined {
    return this.numbers.get(unit);
  }

  isInstalled(unit: number): boolean {
    return this.installed.has(unit);
  }

  unitsOn(): number[] {
    return Array.from(this.state.on.keys()).filter((unit) => this.state.on[unit]);
  }

  isAsPlanned(): boolean {
    const { added, removed } = changedUnits(this.store, this.state);
    return added.length === 0 && removed.length === 0 && this.hasPlannedThresholds();
  }

  hasPlannedThresholds(): boolean {
    return this.state.requirements.every((value, kind) => value === this.store.labels.kinds[kind].requirement);
  }

  private contribution(label: number, at: number): Contribution {
    const { column, mean, error, directShare } = this.signals;
    return {
      label,
      unit: column[at],
      mean: mean[at],
      error: known(error[at]),
      directShare: known(directShare[at]),
    };
  }

  /** The contributions of the units that are on to a label, the strongest first. */
  contributions(label: number): Contribution[] {
    const { begin, column } = this.signals;
    const found: Contribution[] = [];
    for (let at = begin[label]; at < begin[label + 1]; ++at)
      if (this.state.on[column[at]]) found.push(this.contribution(label, at));
    return found.sort((a, b) => b.mean - a.mean || a.unit - b.unit);
  }

  /** The contributions of one unit to the labels that receive it. */
  reachOf(unit: number): Contribution[] {
    const { begin, column } = this.signals;
    const found: Contribution[] = [];
    for (let label = 0; label + 1 < begin.length; ++label)
      for (let low = begin[label], high = begin[label + 1]; low < high; ) {
        const middle = (low + high) >> 1;
        if (column[middle] === unit) {
          found.push(this.contribution(label, middle));
          break;
        }
        if (column[middle] < unit) low = middle + 1;
        else high = middle;
      }
    return found;
  }

  /** The number of met labels and of all labels for which `counts` is true. */
  share(counts: (label: number) => boolean): { met: number; all: number } {
    let met = 0;
    let all = 0;
    this.coverage.met.forEach((isMet, label) => {
      if (!counts(label)) return;
      ++all;
      met += isMet;
    });
    return { met, all };
  }
}
