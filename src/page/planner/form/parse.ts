// Texts in fields, and the values that they stand for.

import type { Json } from "../document/json";
import { parseLength, parseNumber } from "../geometry/lengths";
import type { LengthUnit } from "../geometry/units";
import { text } from "../text";
import type { Measure } from "./field";

/** A text that stands for no value; the message says what is expected. */
export class Unreadable extends Error {}

export function numberFrom(typed: string, measure: Measure, unit: LengthUnit): number {
  const value = measure === "length" ? parseLength(typed, unit.factor) : parseNumber(typed);
  if (value === null) throw new Unreadable(measure === "length" ? text.form.not_length : text.form.not_number);
  return Number(value.toPrecision(12));
}

export const numberText = (value: Json | undefined): string =>
  typeof value === "number" ? String(Number(value.toPrecision(9))) : "";

/** Numbers with commas, semicolons or spaces between them. */
export function numbersFrom(typed: string, measure: Measure, unit: LengthUnit): number[] {
  return typed
    .split(/[,;\s]+/)
    .filter((word) => word !== "")
    .map((word) => numberFrom(word, measure, unit));
}

export const numbersText = (value: Json | undefined): string => (Array.isArray(value) ? value.join(", ") : "");

/** One point in each line. */
export function pointsFrom(typed: string, size: number, measure: Measure, unit: LengthUnit): number[][] {
  return typed
    .split("\n")
    .filter((line) => line.trim() !== "")
    .map((line) => {
      const numbers = numbersFrom(line, measure, unit);
      if (numbers.length !== size) throw new Unreadable(text.form.not_point);
      return numbers;
    });
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
