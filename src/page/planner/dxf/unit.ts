// The unit of a drawing, which headers often name wrongly. A person confirms it.

import { drawingUnits, factorOf } from "../geometry/units";
import type { DxfDrawing } from "./drawing";
import { bulkOf } from "./extents";

export interface ProposedUnit {
  unit: string;
  /** The header names it, and the size of the building is plausible; texts are in feet; or the size fits best. */
  why: "header" | "texts" | "size";
  /** The system of $MEASUREMENT, if the unit that the header names is of the other one. */
  contradiction: "metric" | "imperial" | null;
}

interface Unit {
  isImperial: boolean;
  /** How rare it is in drawings of buildings: 0 is common. */
  rarity: number;
}

const units: ReadonlyMap<string, Unit> = new Map([
  ["mm", { isImperial: false, rarity: 0 }],
  ["m", { isImperial: false, rarity: 0.2 }],
  ["in", { isImperial: true, rarity: 0.3 }],
  ["cm", { isImperial: false, rarity: 1 }],
  ["ft", { isImperial: true, rarity: 1.5 }],
]);

const [smallest, usual, largest] = [3, 40, 1000];
/** Where the header contradicts itself, the size has to tell more. */
const [smallestShop, largestShop] = [5, 200];
const feetAndInches = /^\d+'(-|\s|\d|$)/;
/** So many texts are no accident. */
const fewestTexts = 3;

/** The larger side of most of the drawing. */
function sizeOf({ segments }: DxfDrawing): number {
  const bulk = bulkOf(segments);
  return bulk ? Math.max(bulk.upper[0] - bulk.lower[0], bulk.upper[1] - bulk.lower[1]) : 0;
}

export function proposedUnit(drawing: DxfDrawing): ProposedUnit {
  const size = sizeOf(drawing);
  // A long text may stand in many places.
  const isInFeet =
    drawing.texts.filter(({ text }) => feetAndInches.test(text.slice(0, 40).trim())).length >= fewestTexts;
  const { unit: named, measurement } = drawing;
  const factor = drawingUnits.get(named ?? "");
  const isNamedImperial = /^(in|ft|yd)$/.test(named ?? "");
  const denies = (system: typeof measurement) =>
    factor !== undefined && system !== null && isNamedImperial !== (system === "imperial");
  const contradiction = denies(measurement) ? measurement : null;
  const [least, most] = contradiction ? [smallestShop, largestShop] : [smallest, largest];
  const isPlausible = (factor: number) => size * factor >= least && size * factor <= most;
  // Inches are what many programs name unasked; a metric unit is rarely named so.
  const isDenied = contradiction === "metric" || denies(isInFeet ? "imperial" : null);
  if (named !== null && factor !== undefined && isPlausible(factor) && !isDenied)
    return { unit: named, why: "header", contradiction };

  const system = isInFeet ? "imperial" : measurement;
  const misfit = (name: string): number => {
    const { isImperial, rarity } = units.get(name) as Unit;
    const factor = factorOf(name);
    const distance = size > 0 ? Math.abs(Math.log((size * factor) / usual)) : 0;
    const isOther = system !== null && (system === "imperial") !== isImperial;
    return distance + rarity + (isOther ? 3 : 0) + (isPlausible(factor) ? 0 : 10);
  };
  const [unit] = [...units.keys()].sort((a, b) => misfit(a) - misfit(b));
  return { unit, why: isInFeet && units.get(unit)?.isImperial ? "texts" : "size", contradiction };
}
