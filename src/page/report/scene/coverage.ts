// The effect of a selection on every label. As in placement/problem/placement_problem.cpp, sums are in double precision
// and in row order, so that the same labels are met.

import type { Signals, Store } from "../data/store";

export class Coverage {
  readonly signal: Float64Array;
  readonly met: Uint8Array;
  /** Units that are on and reach the label alone. */
  readonly serving: Uint16Array;
  reached = 0;
  /** Labels that each unit reaches alone, on or off. */
  readonly reach: Uint32Array;
  /**
   * Labels that a unit decides: met only because it is on, or met if it were also on. Not counted for units that are on
   * if any one unit may fail.
   */
  readonly decides: Uint32Array;

  private readonly needs: Float64Array;

  constructor(
    private readonly store: Store,
    private readonly signals: Signals,
  ) {
    const labels = store.labels.ids.length;
    this.signal = new Float64Array(labels);
    this.met = new Uint8Array(labels);
    this.serving = new Uint16Array(labels);
    this.reach = new Uint32Array(store.units.ids.length);
    this.decides = new Uint32Array(store.units.ids.length);
    this.needs = new Float64Array(labels);
  }

  /** A label's requirement under the thresholds of the last update. */
  requirement(label: number): number {
    return this.needs[label];
  }

  isMet(signal: number, requirement: number): boolean {
    return signal >= requirement * (1 - this.store.tolerance);
  }

  /** 10 log10(signal / requirement) of the label. */
  margin(label: number): number {
    return this.needs[label] > 0 ? 10 * Math.log10(this.signal[label] / this.needs[label]) : Infinity;
  }

  update(on: Uint8Array, requirements: readonly number[]): void {
    const { begin, column, mean, rest } = this.signals;
    // The rounding error of the plan's sum is corrected per label, so that only switched units cause errors.
    const { cooperative, units } = this.store;
    const whole = rest.length > 0 && (cooperative || units.selected.every((unit) => on[unit]));
    this.reach.fill(0);
    this.decides.fill(0);
    this.reached = 0;
    for (let i = 0; i < this.signal.length; ++i) {
      const requirement = requirements[this.store.label.kind[i]];
      this.needs[i] = requirement;
      const signal = this.received(i, on, -1) + (whole ? rest[i] : 0);
      const met = this.isMet(signal, requirement);
      this.signal[i] = signal;
      this.met[i] = met ? 1 : 0;
      if (met) ++this.reached;
      let serving = 0;
      for (let at = begin[i]; at < begin[i + 1]; ++at)
        if (this.isMet(mean[at], requirement)) {
          ++this.reach[column[at]];
          if (on[column[at]]) ++serving;
        }
      this.serving[i] = serving;
      this.countDecisive(i, on);
    }
    // Rounded entries may change the decision for a label; for the plan, the exact numbers are known.
    if (rest.length > 0 && !this.store.redundant && this.isPlan(on, requirements))
      units.selected.forEach((unit, k) => (this.decides[unit] = units.neededBy[k]));
  }

  private isPlan(on: Uint8Array, requirements: readonly number[]): boolean {
    const { labels, units } = this.store;
    const count = on.reduce((sum, is) => sum + (is ? 1 : 0), 0);
    return (
      count === units.selected.length &&
      units.selected.every((unit) => on[unit]) &&
      labels.kinds.every(({ requirement }, kind) => requirement === requirements[kind])
    );
  }

  /** The signal of a label under the placement problem, with one unit switched (-1: none). */
  private received(label: number, on: Uint8Array, turned: number): number {
    const { begin, column, mean } = this.signals;
    const { cooperative, redundant } = this.store;
    let result = 0;
    let largest = 0;
    for (let at = begin[label]; at < begin[label + 1]; ++at) {
      const unit = column[at];
      if ((on[unit] !== 0) === (unit === turned)) continue;
      const signal = mean[at];
      const part = redundant ? Math.min(largest, signal) : signal;
      largest = Math.max(largest, signal);
      result = cooperative ? result + part : Math.max(result, part);
    }
    return result;
  }

  private countDecisive(label: number, on: Uint8Array): void {
    const { begin, column, mean, rest } = this.signals;
    const { cooperative, redundant } = this.store;
    const signal = this.signal[label];
    const requirement = this.needs[label];
    const met = this.met[label] !== 0;
    if (met && redundant) return;
    const shown = rest.length > 0 ? this.received(label, on, -1) : signal;
    const whole = cooperative ? signal - shown : 0;
    const slack = 1e-6 * requirement;
    for (let at = begin[label]; at < begin[label + 1]; ++at) {
      const unit = column[at];
      if ((on[unit] !== 0) !== met) continue;
      // A bound often decides without evaluating received().
      if (cooperative && (met ? signal - mean[at] > requirement + slack : signal + mean[at] < requirement - slack))
        continue;
      if (!cooperative && (met ? mean[at] < shown : !this.isMet(mean[at], requirement))) continue;
      if (this.isMet(this.received(label, on, unit) + whole, requirement) !== met) ++this.decides[unit];
    }
  }
}
