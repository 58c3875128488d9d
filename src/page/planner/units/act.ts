// The requests that change units. Each is one step of the history.

import { counted } from "../../data/format";
import { isOn, type UnitState } from "../document/devices";
import type { Planner } from "../planner";
import { say, text } from "../text";
import { turned, type Aim } from "./aim";
import { aimOf, stateOf, whyFixed } from "./chosen";
import type { MeantUnit, Numbered } from "./queue";

export const marks = ["switch", "pin", "exclude", "install"] as const;

/** What can be said of a unit, and taken back. */
export type Mark = (typeof marks)[number];

export const hasMark = (mark: Mark, state: UnitState): boolean =>
  mark === "switch"
    ? isOn(state)
    : state === ({ pin: "pinned", exclude: "excluded", install: "installed" } as const)[mark];

export interface UnitValues extends Partial<Aim> {
  type?: string;
  /** m */
  position?: readonly number[];
  power?: number;
}

type UnitRequest =
  | ({ action: "place"; as: "pinned" | "installed" } & UnitValues)
  | { action: "change"; join: boolean; each: readonly (Numbered & UnitValues)[] }
  | { action: "remove"; each: readonly Numbered[] }
  | { action: Mark; each: readonly (Numbered & { on: boolean })[] };

/** The ids of the units afterwards; none if the server refuses. */
export async function askForUnits(planner: Planner, label: string, request: UnitRequest): Promise<string[]> {
  const answer = await planner.document.ask<{ units: string[] }>("unit", { ...request, label }, label);
  return answer?.units ?? [];
}

/** What a step with units is called; `label` has a place for their names: "unit U1", "3 units". */
function stepOf(units: readonly Numbered[], label: string): string {
  const [{ id }] = units;
  return say(label, units.length === 1 ? say(text.units.named, id) : counted(text.counted.units, units.length));
}

const numbersOf = (units: readonly MeantUnit[]) => units.map(({ index }) => index);

/** `label` has a place for the names of the units. Changed units are entries of the list. */
export function changeUnits(
  planner: Planner,
  indices: readonly number[],
  label: string,
  valuesOf: (index: number) => UnitValues,
): Promise<boolean> {
  const { queue } = planner;
  const units = queue.meant(indices);
  const chosen = planner.selection.version;
  return queue.run(units, () => changeNow(planner, units, chosen, label, valuesOf));
}

/** As a part of a command that is running. `chosen`: the version of the selection when it was given. */
export async function changeNow(
  planner: Planner,
  units: readonly MeantUnit[],
  chosen: number,
  label: string,
  valuesOf: (index: number) => UnitValues,
  join = false,
): Promise<boolean> {
  const numbered = await planner.queue.numbered(units);
  if (!numbered) return false;
  const why = numbered.map(({ index }) => whyFixed(planner, index)).find((reason) => reason !== null);
  if (why) {
    planner.say(why, true);
    return false;
  }
  const each = numbered.map((one) => ({ ...one, ...valuesOf(one.index) }));
  const ids = await askForUnits(planner, stepOf(numbered, label), { action: "change", join, each });
  if (ids.length < units.length) return false;
  const { queue } = planner;
  units.forEach((unit, k) => unit.become(queue.entryWith(ids[k])));
  queue.select(numbersOf(units), chosen);
  return true;
}

/** About the vertical, degrees counter-clockwise. */
export const turnUnits = (planner: Planner, indices: readonly number[], angle: number): Promise<boolean> =>
  changeUnits(planner, indices, text.units.steps.turn, (index) => turned(aimOf(planner, index), angle));

/** Takes a mark from units that all have it, and gives it to them otherwise. */
export function toggleMark(planner: Planner, indices: readonly number[], mark: Mark): Promise<boolean> {
  const { queue, document } = planner;
  const units = queue.meant(indices);
  const chosen = planner.selection.version;
  return queue.run(units, async () => {
    const numbered = await queue.numbered(units);
    if (!numbered) return false;
    const lacking = numbered.filter(({ index }) => !hasMark(mark, stateOf(document.units, index)));
    const on = lacking.length > 0;
    const wanted = on ? lacking : numbered;
    const label = on ? text.units.marking[mark] : text.units.unmarking[mark];
    const each = wanted.map((one) => ({ ...one, on }));
    const ids = await askForUnits(planner, stepOf(wanted, label), { action: mark, each });
    queue.select(numbersOf(units), chosen);
    return ids.length === wanted.length;
  });
}

/** Entries of the list go; other candidates are switched off. */
export function removeUnits(planner: Planner, indices: readonly number[]): Promise<boolean> {
  const { queue, document } = planner;
  const units = queue.meant(indices);
  return queue.run(units, async () => {
    const each = await queue.numbered(units);
    if (!each) return false;
    const isDeletion = each.some(({ index }) => document.units.isListed(index));
    const label = stepOf(each, isDeletion ? text.edits.delete : text.units.unmarking.switch);
    return (await askForUnits(planner, label, { action: "remove", each })).length === each.length;
  });
}
