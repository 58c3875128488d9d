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
  ) {}

  static of(frame: PageData<unknown>, { stage }: { stage: Stage }): Column {
    return new Column(
      stage,
      frame.get("signal", Float32Array),
      frame.get("error", Float32Array),
      frame.get("doubts", Uint8Array),
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

/** Of the columns that are kept: at least those that the server keeps for undo, because it sends none of them again. */
const mostBytes = 2 ** 25;
const bytesPerLabel = 9;

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

  /** Keeps a column. If there are too many, those go that have been off the plan for longest. */
  keep(key: string, column: Column, onPlan: readonly { key: string }[]): void {
    const { columns } = this;
    columns.set(key, column);
    for (const used of [...onPlan.map((unit) => unit.key), key]) {
      const own = columns.get(used);
      if (own && columns.delete(used)) columns.set(used, own); // the newest are last
    }
    const most = Math.max(Math.ceil(mostBytes / (bytesPerLabel * column.signal.length)), onPlan.length + 1);
    for (const oldest of columns.keys()) {
      if (columns.size <= most) break;
      columns.delete(oldest);
    }
  }

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
