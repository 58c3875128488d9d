// A table as people export it from spreadsheets and other programs.

import { textOf, type Encoding } from "./decode";
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
  /** Undefined for UTF-8 and UTF-16, which files show. */
  encoding?: Encoding;
  /** The first lines, and the one of them that names the columns; -1 if none does. */
  first: Line[];
  headerAt: number;
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
function widthOf(lines: readonly Line[], header: Line): number {
  let { length } = header.fields;
  while (length > 0 && lines.every(({ fields, isBroken }) => isBroken || (fields[length - 1] ?? "") === "")) --length;
  return length;
}

/** Programs leave out the name of a first column that numbers the lines: each has one field more. */
const isShorter = ({ fields }: Line, below: readonly Line[]): boolean =>
  below.length > 1 &&
  below.every(
    (line, k) => line.fields.length > fields.length && line.fields[0] === String(k + Number(below[0].fields[0])),
  );

export interface Reading {
  encoding?: Encoding;
  /** The line with the names of the columns, by its place in `first`; -1 for none. */
  headerAt?: number;
}

const mostAbove = 20; // lines above the names of the columns

/** `isName`: of a column. Of the first lines, the one with the most names has those of the columns. */
function guessedHeader(lines: readonly Line[], isName: (field: string) => boolean): number {
  const names = lines.slice(0, mostAbove).map(({ fields }) => fields.filter(isName).length);
  const most = Math.max(...names);
  const at = most > 1 ? names.indexOf(most) : Math.max(headerIn(lines), 0);
  return hasHeader(lines[at]) ? at : -1;
}

/** Throws NotATable. */
export function readTable(
  bytes: Uint8Array,
  isName: (field: string) => boolean = () => false,
  reading: Reading = {},
): Table {
  if (bytes.byteLength > mostBytes) throw new NotATable("large");
  const { text, encoding } = textOf(bytes, reading.encoding);
  if (text.trim() === "") throw new NotATable("empty");
  const found = separatorOf(text);
  if (!found) throw new NotATable("column");
  const { separator, from } = found;
  // Line numbers count the line of the separator.
  const shift = from > 0 ? 1 : 0;
  const all = splitLines(text.slice(from), separator, mostLines + 2).map((line) => ({
    ...line,
    line: line.line + shift,
  }));
  if (all.length > mostLines + 1) throw new NotATable("long");
  if (all.length === 0) throw new NotATable("column");
  const headerAt = reading.headerAt ?? guessedHeader(all, isName);
  const top = headerAt < 0 ? Math.max(headerIn(all), 0) : headerAt;
  const below = all.slice(headerAt < 0 ? top : top + 1);
  const names =
    headerAt >= 0 && isShorter(all[top], below) ? { ...all[top], fields: ["", ...all[top].fields] } : all[top];
  const width = widthOf([names, ...below], names);
  if (width < 2) throw new NotATable("column");
  const header = headerAt < 0 ? Array<string>(width).fill("") : names.fields.slice(0, width).map(unprotected);
  const rows = below.map((line) => rowOf(line, width));
  if (rows.length === 0) throw new NotATable("empty");
  return { separator, encoding, first: all.slice(0, mostAbove), headerAt, header, rows };
}
