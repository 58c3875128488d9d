// Writes tables as the program reads them (docs/formats/store/csv.md).

/** Spreadsheets take these for formulas; an apostrophe prevents it, and the program removes it. */
const isFormula = (text: string): boolean => /^'*[=+\-@\t\r]/.test(text);

export function csvField(text: string): string {
  const field = isFormula(text) ? `'${text}` : text;
  return /[,"\r\n]/.test(field) || field.trim() !== field ? `"${field.replaceAll('"', '""')}"` : field;
}

type Cell = string | number | null | undefined;

const cellText = (cell: Cell): string =>
  typeof cell === "number"
    ? String(Number(cell.toFixed(6)))
    : cell === null || cell === undefined
      ? ""
      : csvField(cell);

/** Columns without any value are left out unless they are among the first `required`. */
export function csvText(header: readonly string[], rows: readonly (readonly Cell[])[], required: number): string {
  const kept = header.flatMap((_, k) =>
    k < required || rows.some((row) => row[k] !== undefined && row[k] !== null && row[k] !== "") ? [k] : [],
  );
  const lines = [kept.map((k) => header[k]), ...rows.map((row) => kept.map((k) => cellText(row[k])))];
  return `${lines.map((cells) => cells.join(",")).join("\n")}\n`;
}

/** The characters that the program refuses in ids (is_printable in src/shelfbeam/base/text.cpp). */
const unprintable = /[\p{Cc}\xad\u061c\u200b\u200e\u200f\u2028-\u202e\u2060-\u206f\ufeff\u{e0000}-\u{e007f}]/u;

export const isPrintable = (text: string): boolean => !unprintable.test(text);

/** In one line, without characters that the program refuses. */
export const lineOf = (text: string): string =>
  text.replace(new RegExp(unprintable, "gu"), " ").replace(/\s+/g, " ").trim();
