// Texts in fields, and the values that they stand for.

import type { Json } from "../document/json";
import { say } from "../../data/text";
import { lengthsOf, numbersOf } from "../geometry/lengths";
import type { LengthUnit } from "../geometry/units";
import { text } from "../text";
import type { Measure } from "./field";

/** A text that stands for no value; the message says what is expected. */
export class Unreadable extends Error {}

export interface Limits {
  least: number;
  most: number;
}
const anyNumber: Limits = { least: -Infinity, most: Infinity };

const readings = (typed: string, measure: Measure, unit: LengthUnit): number[] =>
  measure === "length" ? lengthsOf(typed, unit.factor) : numbersOf(typed);

/** Of two values that an unclear number may stand for, the one within the limits. */
export function numberFrom(typed: string, measure: Measure, unit: LengthUnit, limits = anyNumber): number {
  const found = readings(typed, measure, unit);
  if (found.length === 0) throw new Unreadable(measure === "length" ? text.form.not_length : text.form.not_number);
  const possible = found.filter((value) => value >= limits.least && value <= limits.most);
  if (possible.length > 1)
    throw new Unreadable(say(text.form.unclear, ...possible.map((one) => `${one} ${unitText(measure, unit)}`.trim())));
  return Number((possible.at(0) ?? found[0]).toPrecision(12));
}

export const numberText = (value: Json | undefined): string =>
  typeof value === "number" ? String(Number(value.toPrecision(9))) : "";

/** The ways to part a list into numbers: a comma separates numbers, or is their decimal mark. */
function partings(typed: string): string[][] {
  const at = (separator: RegExp) => typed.split(separator).map((word) => word.trim());
  const hasDecimalComma = /\d,\d/.test(typed);
  if (typed.includes(";")) return [at(/[;\n]/)];
  if (hasDecimalComma) {
    const pairs = typed.match(/[^,\s]+,[^,\s]+(?=,|$)/g) ?? [];
    return [at(/[,\s]+/), at(/,\s+|\s+(?!,)/), at(/,\s+/), ...(pairs.join() === typed ? [pairs] : [])];
  }
  if (typed.includes(",")) return [at(/,/)];
  // 2 400 may be one number.
  const thousands = typed.replace(/\s+/g, " ").match(/[1-9]\d{0,2}(?: \d{3})+(?!\d)|\S+/g) ?? [];
  return [at(/\s+/), thousands, [typed]];
}

/** Numbers with semicolons, commas or spaces between them; of lists with different readings, those of a size count. */
export function numbersFrom(typed: string, measure: Measure, unit: LengthUnit, size?: number): number[] {
  if (typed.trim() === "") return [];
  const lists = new Map<string, number[]>();
  for (const words of partings(typed.trim())) {
    while (words.length > 1 && words.at(-1) === "") words.pop();
    const found = words.map((word) => readings(word, measure, unit));
    if (found.some((values) => values.length === 0) || (size !== undefined && words.length !== size)) continue;
    if (found.some((values) => values.length > 1)) throw new Unreadable(text.form.unclear_list);
    const list = found.map(([value]) => Number(value.toPrecision(12)));
    lists.set(list.join(" "), list);
  }
  if (lists.size > 1) throw new Unreadable(text.form.unclear_list);
  const [list] = lists.values();
  if (list) return list;
  if (size !== undefined) throw new Unreadable(text.form.not_point);
  throw new Unreadable(measure === "length" ? text.form.not_length : text.form.not_number);
}

export const numbersText = (value: Json | undefined): string => (Array.isArray(value) ? value.join(", ") : "");

/** One point in each line. */
export function pointsFrom(typed: string, size: number, measure: Measure, unit: LengthUnit): number[][] {
  return typed
    .split("\n")
    .filter((line) => line.trim() !== "")
    .map((line) => numbersFrom(line, measure, unit, size));
}

export const pointsText = (value: Json | undefined): string =>
  Array.isArray(value) ? value.map(numbersText).join("\n") : "";

export function jsonFrom(typed: string): Json {
  try {
    return JSON.parse(typed) as Json;
  } catch {
    throw new Unreadable(text.form.not_json);
  }
}

export const unitText = (measure: Measure, unit: LengthUnit): string =>
  measure === "length" ? unit.name : measure === "degrees" ? "°" : measure === "none" ? "" : measure;
