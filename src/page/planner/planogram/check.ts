// Checks the lines of a planogram by the rules of the program (src/shelfbeam/scene/planogram).

import { factorOf } from "../geometry/units";
import type { Mark } from "../geometry/written_number";
import { countIn, markOf, numberIn, ordinalIn, unclear } from "../table/numbers";
import type { LineFault, Row, Table } from "../table/table";
import { isPrintable, lineOf } from "../table/write";
import { fixtureMeant, meantRows, numericColumns, type Face, type Mapping, type Role } from "./mapping";
import { wordIn, wordsOf, type Words } from "./meanings";
import { boardsOf, lengthOf, type Holder, type Shop } from "./shop";

/** Why a line is left out; `value` and `most` complete the sentence. */
export interface Reason {
  code:
    | LineFault
    | "no_article"
    | "article"
    | "changed"
    | "no_fixture"
    | "fixture"
    | "left_out"
    | "no_face"
    | "face"
    | "not_face"
    | "type"
    | "unit_type"
    | "no_level"
    | "level"
    | "no_place"
    | "position"
    | "distance"
    | "number"
    | "unclear"
    | "hook"
    | "tilt"
    | "no_planogram"
    | "segment"
    | "duplicate"
    | "same_id"
    | "no_id"
    | "far"
    | "direction";
  value?: string;
  most?: string;
}

export interface BadLine {
  row: Row;
  reason: Reason;
}

export interface Place {
  line: number;
  article: string;
  description: string;
  holder: Holder;
  face: Face;
  /** From 1 for the lowest; of a planogram program, as in the file. */
  level: number;
  /** A position, m from the beginning, or a sequence. */
  place: number;
  type?: string;
  /** m */
  hook?: number;
  /** degrees */
  tilt?: number;
  planogram: string;
  segment: number;
  width?: number;
  facings?: number;
}

export interface Checked {
  good: Place[];
  bad: BadLine[];
  words: Words;
}

class Bad extends Error {
  constructor(readonly reason: Reason) {
    super(reason.code);
  }
}

const fail = (code: Reason["code"], value?: string, most?: string): never => {
  throw new Bad({ code, value, most });
};

const mostPositions = 1000;
const mostSegment = 1_000_000;
const rounding = 1e-6; // m

/** As spreadsheets shorten long numbers. */
const isShortened = (article: string): boolean => /^\d([.,]\d+)?E\+?\d{2}$/i.test(article) || /^#/.test(article);

class Check {
  readonly words: Words;
  private readonly mark: Mark | null;
  private readonly orders = new Map<string, number>();

  constructor(
    table: Table,
    private readonly mapping: Mapping,
    private readonly shop: Shop,
  ) {
    this.mark = mapping.mark === "" ? markOf(table, numericColumns(mapping)) : mapping.mark;
    this.words = wordsOf(table, mapping, shop);
  }

  /** Throws Bad. */
  place({ line, fields, fault }: Row): Place {
    const { form, columns } = this.mapping;
    if (fault) fail(fault);
    const text = (role: Role) => (columns[role] === undefined ? "" : fields[columns[role]]);
    const article = text("article");
    if (article === "") fail("no_article");
    if (!isPrintable(article)) fail("article", lineOf(article));
    if (isShortened(article)) fail("changed", article);
    const { holder, face } = this.side(fields);
    const type = this.meaning(fields, "type", "type");
    const isOfSegments = form === "segments";
    const level = this.level(text("level"), holder, face);
    const tilt = this.plainNumber(text("tilt").replace(/\s*(°|deg\.?|grad)$/i, ""), "tilt");
    if (tilt !== undefined && Math.abs(tilt) > 89) fail("tilt", text("tilt"));
    const planogram = lineOf(text("planogram"));
    if (isOfSegments && columns.planogram !== undefined && planogram === "") fail("no_planogram");
    return {
      line,
      article,
      description: lineOf(text("description")),
      holder,
      face,
      level,
      place: isOfSegments ? this.amount(text("place"), "no_place") : this.along(text("place"), holder, face, level),
      type,
      hook: face === "top" ? undefined : this.hook(text("hook")),
      tilt,
      planogram,
      segment: isOfSegments ? this.segment(text("segment")) : 0,
      width: text("width") === "" ? undefined : this.amount(text("width")),
      facings: text("facings") === "" ? undefined : this.amount(text("facings")),
    };
  }

  private meaning(fields: readonly string[], kind: "face" | "type", unknown: "face" | "type"): string | undefined {
    const word = wordIn(fields, kind, this.mapping);
    if (word === undefined || word === "") return undefined;
    const meaning = this.words[kind].get(word)?.meaning;
    if (meaning === null) fail("left_out", word);
    return meaning ?? fail(unknown, word);
  }

  private side(fields: readonly string[]): { holder: Holder; face: Face } {
    const { mapping, shop } = this;
    const word = wordIn(fields, "fixture", mapping) ?? "";
    if (word === "" && mapping.form === "fixtures") fail("no_fixture");
    const meaning = this.words.fixture.get(word)?.meaning;
    if (meaning === null) fail("left_out", word);
    const meant = fixtureMeant(meaning ?? fail("fixture", word));
    const holder = shop.holders.get(meant.id) ?? fail("fixture", word);
    const stated = this.meaning(fields, "face", "face");
    if (wordIn(fields, "face", mapping) === "") fail("no_face");
    const face = (stated ?? meant.face ?? mapping.face) as Face;
    if (!holder.faces.includes(face)) fail("not_face", face, holder.id);
    return { holder, face };
  }

  private level(text: string, holder: Holder, face: Face): number {
    const { form, first, fromTop } = this.mapping;
    if (text === "") fail("no_level");
    const level = ordinalIn(text) ?? fail("number", text);
    const boards = boardsOf(holder, face);
    const index = level - first;
    if (index < 0 || index >= boards) fail("level", text, String(boards));
    return form === "segments" ? level : fromTop ? boards - index : index + 1;
  }

  private along(text: string, holder: Holder, face: Face, level: number): number {
    const { columns, measure } = this.mapping;
    if (columns.place === undefined) {
      const edge = [holder.id, face, level].join("\n");
      const next = (this.orders.get(edge) ?? 0) + 1;
      if (next > mostPositions) fail("position", String(next));
      this.orders.set(edge, next);
      return next;
    }
    if (text === "") fail("no_place");
    if (measure === "position") {
      const position = (countIn(text) ?? fail("number", text)) - this.mapping.firstPlace + 1;
      if (position < 1 || position > mostPositions) fail("position", text);
      return position;
    }
    const metres = this.metres(text, "number", factorOf(measure)) as number;
    const length = lengthOf(holder, face);
    if (metres < 0 || metres > length + rounding) fail("distance", text, (length / factorOf(measure)).toFixed(2));
    return Math.min(metres, length);
  }

  private number(text: string, code: "number" | "tilt" | "hook"): ReturnType<typeof numberIn> & object {
    const number = numberIn(text, this.mark) ?? fail(code, text);
    return number === unclear ? fail("unclear", text) : number;
  }

  /** Undefined for an empty field. */
  private plainNumber(text: string, code: "number" | "tilt"): number | undefined {
    if (text === "") return undefined;
    const { value, unit } = this.number(text, code);
    return unit === undefined ? value : fail(code, text);
  }

  /** A length; undefined for an empty field. `factor`: of numbers without a unit. */
  private metres(text: string, code: "number" | "hook", factor: number): number | undefined {
    if (text === "") return undefined;
    const { value, unit } = this.number(text, code);
    return value * (unit === undefined ? factor : factorOf(unit));
  }

  private amount(text: string, missing: "no_place" | "number" = "number"): number {
    if (text === "") fail(missing);
    const value = numberIn(text, this.mark) === null ? countIn(text) : this.plainNumber(text, "number");
    return value !== null && value !== undefined && value >= 0 ? value : fail("number", text);
  }

  /** In the unit of the distances, or of the store. */
  private hook(text: string): number | undefined {
    const { measure } = this.mapping;
    const metres = this.metres(text, "hook", measure === "position" ? this.shop.unit.factor : factorOf(measure));
    if (metres === undefined || metres === 0) return undefined;
    return metres >= 1e-3 && metres <= 1e3 ? metres : fail("hook", text);
  }

  private segment(text: string): number {
    const segment = ordinalIn(text) ?? fail("segment", text);
    return segment >= 0 && segment <= mostSegment ? segment : fail("segment", text);
  }
}

/** Ids of labels are articles, from their second place on with /2, /3, ...: another article may have that name. */
function sameIds(places: readonly Place[]): Set<Place> {
  const articles = new Set(places.map(({ article }) => article));
  const times = new Map<string, number>();
  const found = new Set<string>();
  for (const { article } of places) {
    const time = (times.get(article) ?? 0) + 1;
    times.set(article, time);
    if (time > 1 && articles.has(`${article}/${time}`)) found.add(`${article}/${time}`);
  }
  return new Set(found.size === 0 ? [] : places.filter(({ article }) => found.has(article)));
}

/** Planogram programs have an article once at a sequence of a shelf. */
function duplicates(places: readonly Place[]): Set<Place> {
  const seen = new Set<string>();
  return new Set(
    places.filter(({ planogram, segment, level, place, article }) => {
      const key = [planogram, segment, level, place, article].join("\n");
      return seen.has(key) || !seen.add(key);
    }),
  );
}

/** Lines that can be planned, and the others with the reasons. All required columns are known. */
export function checkPlanogram(table: Table, mapping: Mapping, shop: Shop): Checked {
  const meant = { ...table, rows: [...meantRows(table, mapping)] };
  const check = new Check(meant, mapping, shop);
  const rows = new Map<Place, Row>();
  const bad: BadLine[] = [];
  for (const row of meant.rows)
    try {
      rows.set(check.place(row), row);
    } catch (error) {
      if (!(error instanceof Bad)) throw error;
      bad.push({ row, reason: error.reason });
    }
  let good = [...rows.keys()];
  const leaveOut = (code: "duplicate" | "same_id", found: Set<Place>) => {
    good = good.filter((place) => !found.has(place));
    for (const place of found) bad.push({ row: rows.get(place) as Row, reason: { code, value: place.article } });
  };
  if (mapping.form === "segments") leaveOut("duplicate", duplicates(good));
  leaveOut("same_id", sameIds(good));
  bad.sort((a, b) => a.row.line - b.row.line);
  return { good, bad, words: check.words };
}
