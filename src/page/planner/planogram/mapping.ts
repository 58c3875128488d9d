// How the columns and words of a file are meant.

import type { Mark } from "../geometry/written_number";
import type { Row, Table } from "../table/table";

export const faces = ["front", "back", "left", "right", "top"] as const;
export type Face = (typeof faces)[number];

export const roles = [
  "article",
  "description",
  "planogram",
  "fixture",
  "face",
  "segment",
  "level",
  "place",
  "width",
  "facings",
  "type",
  "hook",
  "tilt",
] as const;
export type Role = (typeof roles)[number];

/** fixtures: lines name fixtures; segments: those of planogram programs name segments, shelves and sequences. */
export type Form = "fixtures" | "segments";

const common: Role[] = ["article", "description", "level", "place", "type", "hook", "tilt"];
const own: Record<Form, Role[]> = {
  fixtures: ["fixture", "face"],
  segments: ["planogram", "segment", "width", "facings"],
};
const required: Record<Form, Role[]> = {
  fixtures: ["article", "fixture", "level"],
  segments: ["article", "segment", "level", "place"],
};

export const rolesOf = (form: Form): Role[] =>
  roles.filter((role) => common.includes(role) || own[form].includes(role));
export const isRequired = (form: Form, role: Role): boolean => required[form].includes(role);

export const lengthUnits = ["m", "cm", "mm", "ft", "in"] as const;

/** position: 1, 2, 3, ...; otherwise a distance in this unit. */
export type Measure = "position" | (typeof lengthUnits)[number];

/** Words of the file that stand for something of the shop. */
export const wordKinds = ["fixture", "face", "type"] as const;
export type WordKind = (typeof wordKinds)[number];

/** What a word stands for: an id, a face or a type; null: its lines are left out. */
export type Meanings = Record<string, string | null>;

export interface Mapping {
  form: Form;
  columns: Partial<Record<Role, number>>;
  measure: Measure;
  /** Whether places count from the left of a person who stands before the face; otherwise along the fixture. */
  fromLeft: boolean;
  /** Whether the highest board is the first. */
  fromTop: boolean;
  /** The number of the first board. */
  first: number;
  /** The number of the first place on a board. */
  firstPlace: number;
  /** The decimal mark, where the numbers of the file do not show it; empty: not chosen. */
  mark: Mark | "";
  /** Whether empty cells mean the cell above, as merged cells are exported. */
  fillsDown: boolean;
  /** Of lines without one. */
  face: Face;
  type: string;
  /** Whether each segment stands on a fixture of its own; otherwise each planogram. */
  bySegment: boolean;
  /** Whether the fixtures lose the labels that they had before. */
  clears: boolean;
  words: Record<WordKind, Meanings>;
}

/** A face of a fixture, where lines name no face: an id has no line breaks. */
export const faceOfFixture = (id: string, face: Face): string => `${id}\n${face}`;

export function fixtureMeant(meaning: string): { id: string; face?: Face } {
  const [id, face] = meaning.split("\n");
  return face === undefined ? { id } : { id, face: face as Face };
}

export const missingRoles = ({ form, columns }: Mapping): Role[] =>
  rolesOf(form).filter((role) => isRequired(form, role) && columns[role] === undefined);

/** Columns that numbers are in. */
export const numericColumns = ({ columns }: Mapping): number[] =>
  (["place", "hook", "tilt", "width", "facings"] as const).flatMap((role) => columns[role] ?? []);

/** In the order of what they are parts of. */
const repeated = ["planogram", "fixture", "segment", "face", "level"] as const;
const repeatedColumns = ({ columns }: Mapping): number[] => repeated.flatMap((role) => columns[role] ?? []);

/** Whether some lines have empty cells in columns that others of the same kind have filled. */
export function hasMergedCells({ rows }: Table, mapping: Mapping): boolean {
  const columns = repeatedColumns(mapping);
  return rows.some(
    ({ fields, fault }, k) => k > 0 && !fault && columns.some((at) => fields[at] === "" && rows[0].fields[at] !== ""),
  );
}

/** The rows, with the cells above for empty ones where the mapping says so. */
export function meantRows({ rows }: Table, mapping: Mapping): readonly Row[] {
  if (!mapping.fillsDown) return rows;
  const above = new Map<number, string>();
  const columns = repeatedColumns(mapping);
  return rows.map((row) => {
    if (row.fault) return row;
    const fields = [...row.fields];
    columns.forEach((at, k) => {
      // Another fixture begins with its own face and board.
      if (fields[at] !== "" && fields[at] !== above.get(at))
        for (const part of columns.slice(k + 1)) above.delete(part);
      if (fields[at] === "") fields[at] = above.get(at) ?? "";
      above.set(at, fields[at]);
    });
    return { ...row, fields };
  });
}
