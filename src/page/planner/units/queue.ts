// Commands that change units run one after the other. Each takes the numbers of its units when its turn comes, because every
// change of the store may shift them, and the ids with them: the server refuses a number that another unit has by then.

import type { Devices } from "../document/devices";
import { valueAt } from "../document/json";
import type { Planner } from "../planner";
import { text } from "../text";
import { deviceItem } from "../view/hit";
import { indexWith, listPath, traitsOf, type Traits } from "./chosen";

/** A unit that a command means, whatever its number becomes. */
export class MeantUnit {
  private traits: Traits;
  private found: number | undefined;
  /** The version of the units in which it was looked for. */
  private version: number;

  constructor(
    private readonly units: Devices,
    index: number,
  ) {
    this.traits = traitsOf(units, index);
    this.found = index;
    this.version = units.version;
  }

  /** Its number; undefined while the store has no such unit. */
  get index(): number | undefined {
    if (this.version !== this.units.version) this.take(indexWith(this.units, this.traits));
    return this.found;
  }

  /** A command has replaced it by a unit with this number. */
  become(index: number | undefined): void {
    if (index === undefined) return;
    this.take(index);
    this.traits = traitsOf(this.units, index);
  }

  private take(index: number | undefined): void {
    this.found = index;
    this.version = this.units.version;
  }
}

export interface Numbered {
  index: number;
  id: string;
}

interface Command {
  units: readonly MeantUnit[];
}

export class UnitQueue {
  private last: Promise<unknown> = Promise.resolve();
  private readonly commands = new Set<Command>();

  constructor(private readonly planner: Planner) {}

  /** Those that other commands mean, too, are shared with them, so that all of them follow what replaces a unit. */
  meant(indices: readonly number[]): MeantUnit[] {
    const known = [...this.commands].flatMap(({ units }) => units);
    return indices.map(
      (index) => known.find((unit) => unit.index === index) ?? new MeantUnit(this.planner.document.units, index),
    );
  }

  /** Runs a command after all earlier ones. */
  run<Result>(units: readonly MeantUnit[], work: () => Promise<Result>): Promise<Result> {
    const command = { units };
    this.commands.add(command);
    const result = this.last.then(work).finally(() => this.commands.delete(command));
    this.last = result.catch(() => {});
    return result;
  }

  /** The numbers and ids of units at one time; null, which the page says, if one of them is gone. */
  async numbered(units: readonly MeantUnit[]): Promise<Numbered[] | null> {
    const { document, answers } = this.planner;
    for (;;) {
      const { version } = document.units;
      const indices = units.flatMap(({ index }) => index ?? []);
      const found = await Promise.all(indices.map((index) => answers.of("unit", index)));
      if (version !== document.units.version) continue; // numbers and ids are of different times
      const ids = found.flatMap((device) => device?.id ?? []);
      if (ids.length === units.length) return indices.map((index, k) => ({ index, id: ids[k] }));
      this.planner.say(indices.length === units.length ? text.notices.no_connection : text.units.gone, true);
      return null;
    }
  }

  /** The number of an entry of the list. */
  entryWith(id: string): number | undefined {
    const { document } = this.planner;
    const list = valueAt(document.confirmed, listPath);
    const entry = Array.isArray(list) ? list.findIndex((one) => valueAt(one, "/id") === id) : -1;
    return document.units.withPath(`${listPath}/${entry}`);
  }

  /** What a command has changed is selected, unless a person has selected something else since `version`. */
  select(indices: readonly (number | undefined)[], version: number): void {
    const { selection, document } = this.planner;
    if (selection.version !== version) return;
    selection.replace(indices.flatMap((index) => (index === undefined ? [] : [deviceItem(document.units, index)])));
  }
}
