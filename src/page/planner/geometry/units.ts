// The unit of length of a store file: conversion, rounding and steps.

export interface LengthUnit {
  name: string;
  /** m */
  factor: number;
  /** Decimals that show a tenth of a millimetre. */
  decimals: number;
  /** A step of the arrow keys and of a drag. */
  step: number;
}

const units: LengthUnit[] = [
  { name: "m", factor: 1, decimals: 4, step: 0.01 },
  { name: "cm", factor: 0.01, decimals: 2, step: 1 },
  { name: "mm", factor: 0.001, decimals: 1, step: 10 },
  { name: "ft", factor: 0.3048, decimals: 4, step: 0.05 },
  { name: "in", factor: 0.0254, decimals: 3, step: 0.5 },
];

export const metre = units[0];

export const unitNamed = (name: string): LengthUnit => units.find((unit) => unit.name === name) ?? metre;

/** Units of drawings, m. */
export const drawingUnits: ReadonlyMap<string, number> = new Map([
  ["mm", 0.001],
  ["cm", 0.01],
  ["dm", 0.1],
  ["m", 1],
  ["km", 1000],
  ["in", 0.0254],
  ["ft", 0.3048],
  ["yd", 0.9144],
]);

/** m; that of a metre for an unknown unit. */
export const factorOf = (unit: string): number => drawingUnits.get(unit) ?? 1;

/** Without the digits that only rounding makes. */
export function tidy(value: number, { decimals }: LengthUnit): number {
  return Number(value.toFixed(decimals)) + 0;
}

/** The nearest multiple of the unit's step. */
export function stepped(value: number, unit: LengthUnit): number {
  return tidy(Math.round(value / unit.step) * unit.step, unit);
}

/** A length in m, as a text in the unit. */
export function lengthText(metres: number, unit: LengthUnit): string {
  const decimals = Math.max(unit.decimals - 2, 0);
  return `${(metres / unit.factor).toFixed(decimals)}\u00a0${unit.name}`;
}
