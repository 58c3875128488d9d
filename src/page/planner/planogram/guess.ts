// What the columns of a file probably mean, by their names and contents.

import { factorOf } from "../geometry/units";
import { countIn, markOf, numberIn, unclear } from "../table/numbers";
import { isArticleNumber, type Table } from "../table/table";
import { headerWords, unitInHeader } from "./header_words";
import { lengthUnits, rolesOf, type Form, type Mapping, type Measure, type Role } from "./mapping";
import { plain, squashed } from "./words";

const sampled = 2000; // lines

const withoutUnit = (name: string): string => plain(name).replace(/[\s([_]+(mm|cm|m|ft|in|deg|°|grad)\.?[)\]]?$/, "");

/** How well the name of a column fits a role: the earlier a word stands in its list, the better. */
function fitOf(name: string, role: Role): number {
  const own = squashed(withoutUnit(name));
  if (own === "") return 0;
  const known = headerWords[role].map(squashed);
  const exact = known.indexOf(own);
  if (exact >= 0) return 1000 - exact;
  // "EAN-Code Artikel", "Regal Nr.": one of the words, which are long enough not to stand in others by accident.
  const parts = withoutUnit(name)
    .split(/[^\p{L}\p{N}]+/u)
    .map(squashed);
  const part = known.findIndex((word) => word.length > 1 && parts.includes(word));
  if (part >= 0) return 500 - part;
  const within = known.findIndex((word) => word.length > 3 && own.includes(word));
  return within >= 0 ? 200 - within : 0;
}

export const valuesOf = ({ rows }: Table, column: number, most = sampled): string[] =>
  rows
    .slice(0, most)
    .filter(({ fault }) => !fault)
    .map(({ fields }) => fields[column])
    .filter((value) => value !== "");

const share = (values: readonly string[], is: (value: string) => boolean): number =>
  values.length === 0 ? 0 : values.filter(is).length / values.length;

function columnsOf(table: Table, form: Form): Mapping["columns"] {
  const columns: Mapping["columns"] = {};
  const taken = new Set<number>();
  const fits = rolesOf(form)
    .flatMap((role) => table.header.map((name, column) => ({ role, column, fit: fitOf(name, role) })))
    .filter(({ fit }) => fit > 0)
    .sort((a, b) => b.fit - a.fit);
  for (const { role, column } of fits) {
    if (columns[role] !== undefined || taken.has(column)) continue;
    columns[role] = column;
    taken.add(column);
  }
  if (columns.article === undefined) {
    const free = table.header.findIndex(
      (_, column) => !taken.has(column) && share(valuesOf(table, column), isArticleNumber) > 0.8,
    );
    if (free >= 0) columns.article = free;
  }
  return columns;
}

/** `longest`: of all faces, m. */
function measureOf(table: Table, column: number | undefined, unit: string, longest: number): Measure {
  if (column === undefined) return "position";
  const name = table.header[column];
  const stated = lengthUnits.find((known) => known === unitInHeader(name));
  if (stated) return stated;
  const mark = markOf(table, [column]) ?? ".";
  const read = valuesOf(table, column).map((value) => numberIn(value, mark));
  const found = read.flatMap((number) => (number === null || number === unclear ? [] : number));
  const named = found.find((number) => number.unit !== undefined)?.unit;
  if (named) return named;
  const numbers = found.map(({ value }) => value);
  const isDistance = /^x|abstand|dist|afstand|offset/.test(squashed(name)) || numbers.some((value) => value % 1 !== 0);
  if (!isDistance) return "position";
  if (numbers.length === 0) return unit as Measure;
  const sorted = [...numbers].sort((a, b) => a - b);
  const usual = sorted[Math.ceil(0.95 * (sorted.length - 1))];
  const metres: [Measure, number][] = [
    [unit as Measure, factorOf(unit)],
    ["cm", 0.01],
    ["mm", 0.001],
  ];
  return metres.find(([, factor]) => usual * factor <= longest)?.[0] ?? (unit as Measure);
}

/** Our own columns count along the fixture from its beginning. */
const isOurs = ({ header }: Table): boolean =>
  ["article", "fixture", "face", "level"].every((name) => header.some((own) => own.toLowerCase() === name));

export interface Setting {
  /** Of lengths in the store. */
  unit: string;
  /** m */
  longest: number;
  /** The label type of lines without one. */
  type: string;
}

/** 0 or 1. Single zeros are mistakes. */
function firstOf(table: Table, column: number | undefined): number {
  const counts = column === undefined ? [] : valuesOf(table, column).flatMap((value) => countIn(value) ?? []);
  return counts.filter((count) => count === 0).length > 0.02 * counts.length ? 0 : 1;
}

/** "Boden (von oben)". */
const countsFromTop = (name: string): boolean =>
  /von oben|from (the )?top|from above|top[ -]?down|haut|arriba|dall'?alto|van boven/.test(plain(name));

/** Whether a field of a first line is the name of a column. */
export const isColumnName = (field: string): boolean =>
  (Object.keys(headerWords) as Role[]).some((role) => fitOf(field, role) >= 500);

export function guessedMapping(table: Table, setting: Setting): Mapping {
  const bySegments = columnsOf(table, "segments");
  const byFixtures = columnsOf(table, "fixtures");
  const isOfSegments =
    byFixtures.fixture === undefined && bySegments.segment !== undefined && bySegments.level !== undefined;
  const form = isOfSegments ? "segments" : "fixtures";
  const columns = isOfSegments ? bySegments : byFixtures;
  return {
    form,
    columns,
    measure: measureOf(table, columns.place, setting.unit, setting.longest),
    fromLeft: !isOurs(table),
    fromTop: columns.level !== undefined && countsFromTop(table.header[columns.level]),
    first: firstOf(table, columns.level),
    firstPlace: firstOf(table, columns.place),
    mark: "",
    fillsDown: false,
    face: "front",
    type: setting.type,
    bySegment: false,
    clears: true,
    words: { fixture: {}, face: {}, type: {} },
  };
}

/** The columns for another form. */
export const inForm = (table: Table, mapping: Mapping, form: Form): Mapping => ({
  ...mapping,
  form,
  columns: { ...columnsOf(table, form), article: mapping.columns.article, description: mapping.columns.description },
});
