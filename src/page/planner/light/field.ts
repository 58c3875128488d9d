// The signals of all labels under the units on the plan, of one generation: sums of columns, kept by differences.

import type { PageData } from "../../data/page_data";
import { stages, type Stage } from "../document/messages";

/** What one unit sends to every label. */
export class Column {
  constructor(
    readonly stage: Stage,
    /** In the order of the labels, as are the errors, which are standard errors. */
    readonly signal: Float32Array,
    readonly error: Float32Array,
    readonly doubts: Uint8Array,
    readonly batches = 0,
  ) {}

  static of(frame: PageData<unknown>, { stage, batches }: { stage: Stage; batches?: number }): Column {
    return new Column(
      stage,
      frame.get("signal", Float32Array),
      frame.get("error", Float32Array),
      frame.get("doubts", Uint8Array),
      batches,
    );
  }
}

const reaches = new WeakMap<Column, { requirement: Float32Array; count: number }>();

/** The number of labels that a unit reaches alone. */
export function reachOf(column: Column, requirement: Float32Array): number {
  const known = reaches.get(column);
  if (known?.requirement === requirement) return known.count;
  const { signal } = column;
  let count = 0;
  for (let label = 0; label < requirement.length; ++label) if (signal[label] >= requirement[label]) ++count;
  reaches.set(column, { requirement, count });
  return count;
}

/** Replaced columns leave rounding errors, so that sums are made anew now and then. */
const mostReplaced = 4096;

export class Field {
  total = new Float64Array();
  variance = new Float64Array();
  requirement: Float32Array | null = null;
  /** All columns of the generation, by the key of their unit. */
  readonly columns = new Map<string, Column>();
  /** The columns that the sums contain. */
  summed: ReadonlyMap<string, Column> = new Map();
  private replaced = 0;

  constructor(readonly generation: number) {}

  /** The number of labels. */
  get count(): number {
    return this.requirement?.length ?? 0;
  }

  /** The roughest stage of the sums. */
  get stage(): Stage {
    let least = stages.length - 1;
    for (const { stage } of this.summed.values()) least = Math.min(least, stages.indexOf(stage));
    return stages[least];
  }

  require(requirement: Float32Array): void {
    this.requirement = requirement;
    this.total = new Float64Array(requirement.length);
    this.variance = new Float64Array(requirement.length);
    const { summed } = this;
    this.summed = new Map();
    this.sum(summed);
  }

  /** Makes the sums those of other columns. */
  sum(wanted: ReadonlyMap<string, Column>): void {
    if (!this.requirement) {
      this.summed = wanted;
      return;
    }
    let before = this.summed;
    if (++this.replaced > mostReplaced) {
      this.replaced = 0;
      this.total.fill(0);
      this.variance.fill(0);
      before = new Map();
    }
    for (const [key, column] of before) if (wanted.get(key) !== column) this.add(column, -1);
    for (const [key, column] of wanted) if (before.get(key) !== column) this.add(column, 1);
    this.summed = wanted;
  }

  private add({ signal, error }: Column, sign: 1 | -1): void {
    const { total, variance } = this;
    const count = Math.min(signal.length, total.length);
    for (let label = 0; label < count; ++label) {
      total[label] += sign * signal[label];
      variance[label] += sign * error[label] * error[label];
    }
  }
}
