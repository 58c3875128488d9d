// A table as people export it from spreadsheets and other programs.

import { textOf } from "./decode";
import { mostBytes, mostLines, NotATable } from "./fault";
import { headerIn, separatorOf } from "./separator";
import { splitLines, type Line } from "./split";

/** few, many: fields, compared with the header; quote: one is not closed. */
export type LineFault = "few" | "many" | "quote";

export interface Row {
  line: number;
  fields: string[];
  fault?: LineFault;
}

export interface Table {
  separator: string;
  /** Names of the columns; empty ones without a name. */
  header: string[];
  rows: Row[];
}

export const isArticleNumber = (text: string): boolean => /^(\d{8}|\d{12,14})$/.test(text);

/** ="4006381333931", as spreadsheets protect digits, and an apostrophe before a formula. */
const unprotected = (field: string): string => (/^="(.*)"$/s.exec(field)?.[1] ?? field).replace(/^'(?='*[=+\-@])/, "");

function rowOf({ line, fields, isBroken }: Line, width: number): Row {
  if (isBroken) return { line, fields, fault: "quote" };
  const end = fields.length;
  const own = fields.slice(0, width).map(unprotected);
  if (end < width) return { line, fields: own, fault: "few" };
  if (fields.slice(width).some((field) => field !== "")) return { line, fields, fault: "many" };
  return { line, fields: own };
}

/** Without a header, if its place has an article number. */
const hasHeader = ({ fields }: Line): boolean => !fields.some(isArticleNumber);

/** The width without empty columns at the end. */
function widthOf(lines: readonly Line[]): number {
  let { length } = lines[0].fields;
  while (length > 0 && lines.every(({ fields, isBroken }) => isBroken || (fields[length - 1] ?? "") === "")) --length;
  return length;
}

/** Throws NotATable. */
export function readTable(bytes: Uint8Array): Table {
  if (bytes.byteLength > mostBytes) throw new NotATable("large");
  const text = textOf(bytes);
  if (text.trim() === "") throw new NotATable("empty");
  const found = separatorOf(text);
  if (!found) throw new NotATable("column");
  const { separator, from } = found;
  // Line numbers count the line of the separator.
  const shift = from > 0 ? 1 : 0;
  const all = splitLines(text.slice(from), separator, mostLines + 2);
  if (all.length > mostLines + 1) throw new NotATable("long");
  const lines = all.slice(Math.max(headerIn(all), 0)).map((line) => ({ ...line, line: line.line + shift }));
  const width = lines.length === 0 ? 0 : widthOf(lines);
  if (width < 2) throw new NotATable("column");
  const isNamed = hasHeader(lines[0]);
  const header = isNamed ? lines[0].fields.slice(0, width).map(unprotected) : Array<string>(width).fill("");
  const rows = lines.slice(isNamed ? 1 : 0).map((line) => rowOf(line, width));
  if (rows.length === 0) throw new NotATable("empty");
  return { separator, header, rows };
}
