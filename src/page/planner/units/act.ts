// The requests that change units. Each is one step of the history.

import { counted } from "../../data/format";
import { deleteSelection } from "../actions/copy";
import { isOn, type UnitState } from "../document/devices";
import type { Planner } from "../planner";
import { say, text } from "../text";
import { turned, type Aim } from "./aim";
import {
  aimOf,
  chosenUnits,
  indexWith,
  knownName,
  selectListed,
  selectUnits,
  stateOf,
  traitsOf,
  whyFixed,
} from "./chosen";

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
  | { action: "change"; join?: boolean; each: readonly ({ index: number } & UnitValues)[] }
  | { action: "remove"; each: readonly { index: number }[] }
  | { action: Mark; each: readonly { index: number; on: boolean }[] };

/** The ids of the units afterwards; none if the server refuses. */
export async function askForUnits(planner: Planner, label: string, request: UnitRequest): Promise<string[]> {
  const answer = await planner.document.ask<{ units: string[] }>("unit", { ...request, label }, label);
  return answer?.units ?? [];
}

/** What people call units in the history: "unit U1", "3 units". */
async function namesOf(planner: Planner, indices: readonly number[]): Promise<string> {
  if (indices.length !== 1) return counted(text.counted.units, indices.length);
  return say(text.units.named, await knownName(planner, indices[0]));
}

/** What a step with several units is called; `label` has a place for their names. */
const stepOf = async (planner: Planner, indices: readonly number[], label: string): Promise<string> =>
  say(label, await namesOf(planner, indices));

/** People may have selected something else while they waited. */
const canSelect = (planner: Planner): boolean =>
  planner.selection.items.length === 0 || chosenUnits(planner).length > 0;

/** `label` has a place for the names of the units. Changed units are entries of the list. */
export async function changeUnits(
  planner: Planner,
  indices: readonly number[],
  label: string,
  valuesOf: (index: number) => UnitValues,
  join = false,
): Promise<boolean> {
  const why = indices.map((index) => whyFixed(planner, index)).find((reason) => reason !== null);
  if (why) {
    planner.say(why, true);
    return false;
  }
  const each = indices.map((index) => ({ index, ...valuesOf(index) }));
  const ids = await askForUnits(planner, await stepOf(planner, indices, label), {
    action: "change",
    join,
    each,
  });
  if (ids.length > 0 && canSelect(planner)) selectListed(planner, ids);
  return ids.length === indices.length;
}

/** About the vertical, degrees counter-clockwise. */
export const turnUnits = (planner: Planner, indices: readonly number[], angle: number): Promise<boolean> =>
  changeUnits(planner, indices, text.units.steps.turn, (index) => turned(aimOf(planner, index), angle));

export async function markUnits(
  planner: Planner,
  indices: readonly number[],
  mark: Mark,
  on: boolean,
): Promise<boolean> {
  const { units } = planner.document;
  const traits = indices.map((index) => traitsOf(units, index));
  const wanted = indices.filter((index) => hasMark(mark, stateOf(units, index)) !== on);
  if (wanted.length === 0) return true;
  const label = on ? text.units.marking[mark] : text.units.unmarking[mark];
  const ids = await askForUnits(planner, await stepOf(planner, wanted, label), {
    action: mark,
    each: wanted.map((index) => ({ index, on })),
  });
  if (canSelect(planner))
    selectUnits(
      planner,
      traits.flatMap((one) => indexWith(units, one) ?? []),
    );
  return ids.length === wanted.length;
}

/** Entries of the list go; other candidates are switched off. */
export async function removeUnits(planner: Planner, indices: readonly number[]): Promise<boolean> {
  const { units } = planner.document;
  const others = indices.filter((index) => !units.isListed(index));
  if (others.length > 0) {
    const step = await stepOf(planner, others, text.units.unmarking.switch);
    const each = others.map((index) => ({ index }));
    if ((await askForUnits(planner, step, { action: "remove", each })).length < others.length) return false;
  }
  return others.length === indices.length || deleteSelection(planner);
}
