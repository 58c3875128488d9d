// Remembers how files of the same columns are meant, in the browser and for each project.

import { isObject, type Json } from "../document/json";
import type { Table } from "../table/table";
import { roles, wordKinds, type Mapping, type Meanings } from "./mapping";
import { squashed } from "./words";

const most = 20; // kinds of files

const keyOf = (project: string): string => `shelfbeam.tables.${project}`;

/** Files with the same columns are of the same kind. */
export const signatureOf = ({ header }: Table): string => header.map(squashed).join("|");

function stored(project: string): [string, Json][] {
  try {
    const all = JSON.parse(localStorage.getItem(keyOf(project)) ?? "[]") as Json;
    return Array.isArray(all)
      ? all.filter((one): one is [string, Json] => Array.isArray(one) && typeof one[0] === "string" && one.length === 2)
      : [];
  } catch {
    return [];
  }
}

const isColumn = (value: Json | undefined, { header }: Table): value is number =>
  typeof value === "number" && value in header;

const meaningsIn = (value: Json | undefined): Meanings =>
  isObject(value)
    ? Object.fromEntries(
        Object.entries(value).filter(
          (one): one is [string, string | null] => one[1] === null || typeof one[1] === "string",
        ),
      )
    : {};

/** The remembered mapping over the guessed one; null if the kind of file is new. */
export function recalled(project: string, table: Table, guessed: Mapping): Mapping | null {
  const found = stored(project).find(([signature]) => signature === signatureOf(table))?.[1];
  if (!isObject(found)) return null;
  const { columns, words } = found;
  const mapping: Record<string, unknown> = { ...guessed };
  for (const [key, value] of Object.entries(guessed))
    if (typeof value !== "object" && typeof found[key] === typeof value) mapping[key] = found[key];
  mapping.columns = Object.fromEntries(
    roles.flatMap((role) => {
      const column = isObject(columns) ? columns[role] : undefined;
      return isColumn(column, table) ? [[role, column]] : [];
    }),
  );
  mapping.words = Object.fromEntries(
    wordKinds.map((kind) => [kind, meaningsIn(isObject(words) ? words[kind] : undefined)]),
  );
  return mapping as unknown as Mapping;
}

export function remember(project: string, table: Table, mapping: Mapping): void {
  const signature = signatureOf(table);
  const others = stored(project).filter(([other]) => other !== signature);
  try {
    localStorage.setItem(keyOf(project), JSON.stringify([[signature, mapping], ...others].slice(0, most)));
  } catch {
    // Private windows may refuse to remember.
  }
}
