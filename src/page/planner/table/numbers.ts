// Numbers as spreadsheets of all countries write them: with a decimal point or comma, and thousands separators.

import type { Table } from "./table";

type Mark = "." | ",";

const otherOf = (mark: Mark): Mark => (mark === "." ? "," : ".");

/** What the number shows about the decimal mark; "maybe": 1.500 is one and a half, or 1500. */
function shownBy(number: string): { mark: Mark; isCertain: boolean } | null {
  const marks = number.replace(/[^.,]/g, "");
  if (marks === "") return null;
  const last = marks.at(-1) as Mark;
  if (marks.includes(otherOf(last))) return { mark: last, isCertain: true };
  if (marks.length > 1) return { mark: otherOf(last), isCertain: true };
  return { mark: last, isCertain: !/^[+-]?[1-9]\d{0,2}[.,]\d{3}$/.test(number) };
}

/** The decimal mark of the numbers in some columns. */
export function markOf({ rows }: Table, columns: readonly number[]): Mark {
  let likely: Mark | null = null;
  for (const { fields, fault } of rows)
    for (const column of fault ? [] : columns) {
      const field = fields[column].replace(/\s/g, "");
      const shown = /^[+-]?[\d.,]+$/.test(field) ? shownBy(field) : null;
      if (shown?.isCertain) return shown.mark;
      likely ??= shown?.mark ?? null;
    }
  return likely ?? ".";
}

/** Null if it is not a number. */
export function numberIn(field: string, mark: Mark): number | null {
  const plain = field.replace(/(?<=\d)[\s'’](?=\d{3}(\D|$))/g, "");
  const groups = otherOf(mark) === "." ? /^[+-]?\d{1,3}(\.\d{3})+(,\d+)?$/ : /^[+-]?\d{1,3}(,\d{3})+(\.\d+)?$/;
  const joined = groups.test(plain) ? plain.replaceAll(otherOf(mark), "") : plain;
  const number = joined.replace(",", ".");
  return /^[+-]?(\d+\.?\d*|\.\d+)$/.test(number) ? Number(number) : null;
}

/** A whole number that may have words around it: "Boden 3". */
export function countIn(field: string): number | null {
  const digits = /^[^\d]*?(-?\d{1,6})(?:[.,]0+)?[^\d]*$/.exec(field)?.[1];
  return digits === undefined ? null : Number(digits);
}
