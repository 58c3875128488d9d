// What words of a file stand for: as a person has chosen, or by their likeness.

import type { Table } from "../table/table";
import { faceNamed } from "./face_words";
import { faces, type Mapping, type WordKind } from "./mapping";
import type { Shop } from "./shop";
import { squashed } from "./words";

export interface Word {
  word: string;
  lines: number;
  /** Undefined: unknown; null: left out. */
  meaning: string | null | undefined;
}

export type Words = Record<WordKind, Map<string, Word>>;

/** Kinds of fixtures, which other programs write before their names. */
const kind = new RegExp(
  `^(${[
    "regal|wandregal|gondel|gondelkopf|stirnregal|stirn|kopfgondel|kopf|mobel|moebel|truhe|tktruhe|tisch",
    "fixture|rack|shelving|shelf|gondola|endcap|freezer|table|meuble|gondole|tetedegondole|tete|mueble|estanteria",
    "gondola|cabecera|scaffale|mobile|testata|stelling|rek|kopstelling",
  ].join("|")})(?=.)`,
);

const withoutKind = (word: string): string => squashed(word).replace(kind, "");

/** The one of `known` that is like a word; none if two are. */
function finder(known: readonly string[]): (word: string) => string | undefined {
  const tables = [squashed, withoutKind].map((form) => {
    const found = new Map<string, string | null>();
    for (const one of known) found.set(form(one), found.has(form(one)) ? null : one);
    return { form, found };
  });
  return (word) => {
    if (known.includes(word)) return word;
    for (const { form, found } of tables) {
      const like = found.get(form(word));
      if (like) return like;
    }
    return undefined;
  };
}

function finders({ holders, types }: Shop): Record<WordKind, (word: string) => string | undefined> {
  return { fixture: finder([...holders.keys()]), face: faceNamed, type: finder(types) };
}

/** Whether the shop still has what a person once chose. */
function isThere(kind: WordKind, meaning: string, { holders, types }: Shop): boolean {
  if (kind === "fixture") return holders.has(meaning.split("\n")[0]);
  return kind === "type" ? types.includes(meaning) : (faces as readonly string[]).includes(meaning);
}

/** What stands on fixtures in a file of segments: a planogram, or one of its segments. */
export const holderName = (planogram: string, segment: string, { bySegment, columns }: Mapping): string =>
  [columns.planogram === undefined ? "" : planogram, bySegment ? segment : ""]
    .filter((part) => part !== "")
    .join(" / ");

/** The word of a line for a kind; undefined without a column. */
export function wordIn(fields: readonly string[], kind: WordKind, mapping: Mapping): string | undefined {
  const { form, columns } = mapping;
  const at = (column: number | undefined) => (column === undefined ? "" : fields[column]);
  if (kind === "fixture" && form === "segments") return holderName(at(columns.planogram), at(columns.segment), mapping);
  const column = columns[kind];
  return column === undefined || (kind === "face" && form === "segments") ? undefined : fields[column];
}

export function wordsOf({ rows }: Table, mapping: Mapping, shop: Shop): Words {
  const find = finders(shop);
  const words: Words = { fixture: new Map(), face: new Map(), type: new Map() };
  const meaningOf = (kind: WordKind, word: string): Word["meaning"] => {
    const chosen = Object.hasOwn(mapping.words[kind], word) ? mapping.words[kind][word] : undefined;
    return chosen === null || (chosen !== undefined && isThere(kind, chosen, shop)) ? chosen : find[kind](word);
  };
  for (const { fields, fault } of rows)
    for (const kind of fault ? [] : (Object.keys(words) as WordKind[])) {
      const word = wordIn(fields, kind, mapping);
      // Of a file with a single planogram, the empty name stands for all of it.
      if (word === undefined || (word === "" && !(kind === "fixture" && mapping.form === "segments"))) continue;
      const known = words[kind].get(word);
      if (known) ++known.lines;
      else words[kind].set(word, { word, lines: 1, meaning: meaningOf(kind, word) });
    }
  return words;
}
