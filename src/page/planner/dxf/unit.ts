// The unit of a drawing, which headers often name wrongly. A person confirms it.

import type { DxfDrawing } from "./drawing";
import { bulkOf } from "./extents";

export interface ProposedUnit {
  unit: string;
  /** The header names it, and the size of the building is plausible; texts are in feet; or the size fits best. */
  why: "header" | "texts" | "size";
}

interface Unit {
  /** m */
  factor: number;
  isImperial: boolean;
  /** How rare it is in drawings of buildings: 0 is common. */
  rarity: number;
}

const units: ReadonlyMap<string, Unit> = new Map([
  ["mm", { factor: 0.001, isImperial: false, rarity: 0 }],
  ["m", { factor: 1, isImperial: false, rarity: 0.2 }],
  ["in", { factor: 0.0254, isImperial: true, rarity: 0.3 }],
  ["cm", { factor: 0.01, isImperial: false, rarity: 1 }],
  ["ft", { factor: 0.3048, isImperial: true, rarity: 1.5 }],
]);
const further: Readonly<Record<string, number>> = { dm: 0.1, km: 1000, yd: 0.9144, mi: 1609.344, dam: 10, hm: 100 };

const [smallest, usual, largest] = [3, 40, 1000];
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
  const isPlausible = (factor: number) => size * factor >= smallest && size * factor <= largest;
  const isInFeet = drawing.texts.filter(({ text }) => feetAndInches.test(text.trim())).length >= fewestTexts;
  const { unit: named, measurement } = drawing;
  const known = named === null ? undefined : units.get(named);
  const factor = known?.factor ?? further[named ?? ""];
  const isContradicted = isInFeet && known?.isImperial === false;
  if (named !== null && factor !== undefined && isPlausible(factor) && !isContradicted)
    return { unit: named, why: "header" };

  const system = isInFeet ? "imperial" : measurement;
  const misfit = ({ factor, isImperial, rarity }: Unit): number => {
    const distance = size > 0 ? Math.abs(Math.log((size * factor) / usual)) : 0;
    const isOther = system !== null && (system === "imperial") !== isImperial;
    return distance + rarity + (isOther ? 3 : 0) + (isPlausible(factor) ? 0 : 10);
  };
  const [unit] = [...units].reduce((best, one) => (misfit(one[1]) < misfit(best[1]) ? one : best));
  return { unit, why: isInFeet && units.get(unit)?.isImperial ? "texts" : "size" };
}
