// Numbers in the fields of a table: with a decimal point or comma, marks of thousands, and units of length.

import { writtenNumber, type Mark, type WrittenNumber } from "../geometry/written_number";
import type { Table } from "./table";

/** Programs that separate by commas write decimal points, spreadsheets that separate by semicolons decimal commas. */
const usualMarks: Record<string, Mark | undefined> = { ",": ".", ";": "," };

/**
 * The decimal mark of the numbers in some columns; null if they do not show it, or show both. The separator shows it unless
 * a column has whole numbers beside 1.250: such a file does not write decimals to all numbers.
 */
export function markOf({ rows, separator }: Table, columns: readonly number[]): Mark | null {
  const certain = new Set<Mark>();
  const doubtful = new Set<Mark>();
  let isUsual = true;
  for (const column of columns) {
    let [hasWhole, hasUnclear] = [false, false];
    for (const { fields, fault } of rows) {
      const number = fault ? null : writtenNumber(fields[column]);
      if (!number) continue;
      if (number.mark) (number.grouped === undefined ? certain : doubtful).add(number.mark);
      hasUnclear ||= number.grouped !== undefined;
      hasWhole ||= number.mark === undefined && number.value !== 0;
    }
    isUsual &&= !(hasWhole && hasUnclear);
  }
  const usual = usualMarks[separator];
  if (certain.size === 0 && usual && isUsual && doubtful.has(usual)) certain.add(usual);
  const all = new Set([...certain, ...doubtful]);
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

/** A whole number that may have words before it, "Boden 3", or a letter or point behind it, but no unit: "25 cm". */
export function countIn(field: string): number | null {
  if (writtenNumber(field)?.unit) return null;
  const digits = /^[^\d]*?(-?\d{1,6})(?:[.,]0{1,2})?(?:[a-z](?![a-z])|[.):\]])?\s*$/i.exec(field)?.[1];
  return digits === undefined ? null : Number(digits);
}

/** As countIn, of a board or a segment, which may have words behind it: "3. Boden". */
export function ordinalIn(field: string): number | null {
  const digits = /^[^\d]*?(-?\d{1,6})(?:[.,]0{1,2})?[^\d.,]*$|^(\d{1,3})(?:\.|st|nd|rd|th|e|er|º|ª)\s*\p{L}+$/iu.exec(
    field,
  );
  const found = digits?.[1] ?? digits?.[2];
  return found === undefined || writtenNumber(field)?.unit ? null : Number(found);
}
