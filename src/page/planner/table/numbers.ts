// Numbers in the fields of a table: with a decimal point or comma, marks of thousands, and units of length.

import { writtenNumber, type Mark, type WrittenNumber } from "../geometry/written_number";
import type { Table } from "./table";

/** Programs that separate by commas write decimal points, spreadsheets that separate by semicolons decimal commas. */
const usualMarks: Record<string, Mark | undefined> = { ",": ".", ";": "," };

/** The decimal mark of the numbers in some columns; null if they do not show it, or show both. */
export function markOf({ rows, separator }: Table, columns: readonly number[]): Mark | null {
  const certain = new Set<Mark>();
  const unclear = new Set<Mark>();
  for (const { fields, fault } of rows)
    for (const column of fault ? [] : columns) {
      const number = writtenNumber(fields[column]);
      if (number?.mark) (number.grouped === undefined ? certain : unclear).add(number.mark);
    }
  const [usual] = [usualMarks[separator]];
  if (certain.size === 0 && usual && unclear.has(usual)) certain.add(usual);
  const all = new Set([...certain, ...unclear]);
  if (all.size === 0) return ".";
  return all.size === 1 && certain.size === 1 ? [...certain][0] : null;
}

/** A number whose mark may be one of thousands, while the decimal mark is not known. */
export const unclear = "unclear";

/** In its own unit of length, if it names one; null if it is not a number, or has another decimal mark. */
export function numberIn(
  field: string,
  mark: Mark | null,
): { value: number; unit?: WrittenNumber["unit"] } | typeof unclear | null {
  const number = writtenNumber(field);
  if (!number) return null;
  const { value, grouped, unit } = number;
  if (grouped !== undefined) return mark === null ? unclear : { value: number.mark === mark ? value : grouped, unit };
  return number.mark !== undefined && mark !== null && number.mark !== mark ? null : { value, unit };
}

/** A whole number that may have words around it: "Boden 3", but not "25 cm". */
export function countIn(field: string): number | null {
  if (writtenNumber(field)?.unit) return null;
  const digits = /^[^\d]*?(-?\d{1,6})(?:[.,]0{1,2})?[^\d.,]*$/.exec(field)?.[1];
  return digits === undefined ? null : Number(digits);
}
