// The selected units: entries of the list, and candidates of grids, areas, rails and faces.

import { isOn, unitStates, type Devices, type UnitState } from "../document/devices";
import { isObject, valueAt, type Json } from "../document/json";
import type { Part } from "../document/messages";
import { elementAt } from "../elements/kinds";
import { contains } from "../geometry/polygon";
import type { Planner } from "../planner";
import { text } from "../text";
import { deviceItem } from "../view/hit";
import type { Item } from "../view/selection";
import type { Aim } from "./aim";

const samePlace = 1e-4; // m

export const listPath = "/transceivers/list";

/** The number of a unit that an item is; undefined if it is none. */
export function unitOf({ units }: Planner["document"], item: Item): number | undefined {
  if (item.kind === "device") return item.device === "unit" ? item.index : undefined;
  return item.kind === "element" && item.path.startsWith(`${listPath}/`) ? units.withPath(item.path) : undefined;
}

/** Their numbers, if nothing else is selected. */
export function chosenUnits({ selection, document }: Planner): number[] {
  const found: number[] = [];
  for (const item of selection.items) {
    const index = unitOf(document, item);
    if (index === undefined) return [];
    found.push(index);
  }
  return found;
}

export const stateOf = ({ state }: Devices, index: number): UnitState => unitStates[state[index]] ?? "candidate";

export const stateWords = (units: Devices, index: number): string => text.units.states[stateOf(units, index)];

/** Where the units on the plan are shown, m. No name covers them. */
export function placesOnPlan({ document: { units }, mover, layers }: Planner): number[][] {
  if (!layers.isShown("unit")) return [];
  const places: number[][] = [];
  for (let index = 0; index < units.count; ++index)
    if (isOn(stateOf(units, index)))
      places.push(mover.shown?.index === index ? [...mover.shown.mount.position] : units.at(index));
  return places;
}

/** A candidate is selected before it is dragged, because many lie where frames and turns of the view begin. */
export const canGrab = ({ document, selection }: Planner, index: number): boolean =>
  document.units.stands(index) || selection.has(deviceItem(document.units, index));

/** What tells a unit from others after a change of its state, which may change its number. */
export interface Traits {
  path: string | null;
  position: Float32Array;
  direction: Float32Array;
}

const three = (values: Float32Array, index: number) => values.subarray(3 * index, 3 * index + 3);

export const traitsOf = (units: Devices, index: number): Traits => ({
  path: units.pathOf(index),
  position: three(units.position, index).slice(),
  direction: three(units.direction, index).slice(),
});

const listOf = (path: string | null) => path?.slice(0, path.lastIndexOf("/"));

/** Numbers in paths shift, too: they tell units of one place apart. */
export function indexWith(units: Devices, { path, position, direction }: Traits): number | undefined {
  const has = (values: Float32Array, index: number, wanted: Float32Array) =>
    wanted.every((value, axis) => value === values[3 * index + axis]);
  const similar: number[] = [];
  for (let index = 0; index < units.count; ++index) {
    if (!has(units.position, index, position) || !has(units.direction, index, direction)) continue;
    const own = units.pathOf(index);
    if (own === path) return index;
    if (listOf(own) === listOf(path)) similar.push(index);
  }
  return similar.length === 1 ? similar[0] : undefined;
}

/** The entry of the list, or the element that makes the candidate. */
function elementOf({ document }: Planner, index: number): { [key: string]: Json } {
  const path = document.units.pathOf(index);
  return (path !== null && elementAt(document.json, path)?.value) || {};
}

export function aimOf(planner: Planner, index: number): Aim {
  const axis = Array.from(three(planner.document.units.direction, index));
  return { axis, roll_deg: Number(elementOf(planner, index).roll_deg ?? 0) };
}

/** Relative to the type. */
export const powerOf = (planner: Planner, index: number): number =>
  Number(elementOf(planner, index).relative_power ?? 1);

/** The name that people know it by; its kind until the server has answered. */
export function nameOfUnit(planner: Planner, index: number): string {
  const { id } = planner.document.units.isListed(index) ? elementOf(planner, index) : {};
  return typeof id === "string" ? id : (planner.answers.now("unit", index)?.id ?? text.kinds.unit);
}

/** Why its place, direction, type and power cannot be changed; null if they can. */
export function whyFixed({ document }: Planner, index: number): string | null {
  if (document.locked) return text.why_not.locked;
  if (document.units.pathOf(index) === null) return text.why_not.file;
  // Another candidate becomes an entry of the list.
  return listIsFile({ document }) && !document.units.isListed(index) ? text.units.list_is_file : null;
}

/** Whether the list is a file, to which the server adds nothing. */
export const listIsFile = ({ document }: Pick<Planner, "document">): boolean =>
  isObject(valueAt(document.json, listPath));

/** Why no unit can be at a place (m) for a plan; null if it can. */
export function whyNotAt({ document }: Planner, [x, y, z]: readonly number[]): string | null {
  const isIn = ({ kind, path, outline }: Part) => {
    if (kind !== "keep_out" || !contains(outline, [x, y])) return false;
    const heights = path === null ? undefined : elementAt(document.json, path)?.value.z;
    const [low, high] = Array.isArray(heights) ? heights.map((value) => Number(value) * document.unit.factor) : [];
    return low === undefined || (z >= low && z <= high);
  };
  if (document.parts.all.some(isIn)) return text.units.keep_out;
  const { position, state, count } = document.units;
  for (let index = 0; index < count; ++index) {
    const isOccupied = isOn(unitStates[state[index]]) && isSamePlace(three(position, index), [x, y, z]);
    if (isOccupied) return text.units.occupied;
  }
  return null;
}

export const isSamePlace = (a: ArrayLike<number>, b: ArrayLike<number>): boolean =>
  Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) < samePlace;
