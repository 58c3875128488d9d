// Lists of labels and of candidates, as the program reads and writes them (docs/formats/store/csv.md).

import { factorOf } from "../geometry/units";
import { markOf, numberIn, unclear } from "../table/numbers";
import type { Row, Table } from "../table/table";
import { csvText, isPrintable, lineOf } from "../table/write";
import type { Reason } from "./check";

export type ListKind = "labels" | "units";

const columns: Record<ListKind, string[]> = {
  labels: ["id", "x", "y", "z", "nx", "ny", "nz", "type"],
  units: ["id", "x", "y", "z", "ax", "ay", "az", "roll_deg", "type"],
};

/** What continues them in files that `plan` writes, which are in m. */
const ours: Record<ListKind, string[]> = {
  labels: ["requirement", "signal", "margin_db"],
  units: ["cost", "installed", "reaches_alone"],
};

const descriptions = ["description", "name", "article_name", "product_name", "product", "article_description"];

const namesOf = ({ header }: Table): string[] => header.map((name) => name.toLowerCase().replaceAll(" ", "_"));

export function listKindOf(table: Table): ListKind | null {
  const names = namesOf(table);
  return (["labels", "units"] as const).find((kind) => columns[kind].every((name, k) => names[k] === name)) ?? null;
}

export interface CheckedList {
  file: string;
  count: number;
  bad: { row: Row; reason: Reason }[];
}

/** `types`: the known ones; `factor`: the unit of the store, m. */
export function checkList(table: Table, kind: ListKind, types: readonly string[], factor: number): CheckedList {
  const own = columns[kind];
  const names = namesOf(table);
  const mark = markOf(
    table,
    own.slice(1, -1).map((_, k) => k + 1),
  );
  const isOurs = ours[kind].every((name, k) => names[own.length + k] === name);
  const scale = isOurs ? 1 / factor : 1;
  const described =
    kind === "labels"
      ? (descriptions.map((name) => names.indexOf(name, own.length)).find((column) => column > 0) ?? -1)
      : -1;
  const farthest = 10_000 / factor;
  const seen = new Set<string>();
  const bad: CheckedList["bad"] = [];
  const rows: (string | number)[][] = [];

  /** Coordinates in the unit of the store, or of the program's own files in m; directions have none. */
  const read = (field: string, isLength: boolean): number | typeof unclear | null => {
    const number = numberIn(field, mark);
    if (number === null || number === unclear) return number;
    if (number.unit === undefined) return isLength ? number.value * scale : number.value;
    return isLength ? (number.value * factorOf(number.unit)) / factor : null;
  };
  const reasonFor = ({ fields, fault }: Row, numbers: ReturnType<typeof read>[]): Reason | null => {
    if (fault) return { code: fault };
    const [id, type] = [fields[0], fields[own.length - 1]];
    if (id === "") return { code: "no_id" };
    if (!isPrintable(id)) return { code: "article", value: lineOf(id) };
    const wrong = numbers.indexOf(null);
    if (wrong >= 0) return { code: "number", value: fields[wrong + 1] };
    const either = numbers.indexOf(unclear);
    if (either >= 0) return { code: "unclear", value: fields[either + 1] };
    if (numbers.slice(0, 3).some((value) => Math.abs(value as number) > farthest))
      return { code: "far", value: fields.slice(1, 4).join(" ") };
    if (numbers.slice(3, 6).every((value) => value === 0)) return { code: "direction" };
    if (!types.includes(type)) return { code: kind === "labels" ? "type" : "unit_type", value: type };
    return seen.has(id) ? { code: "same_id", value: id } : null;
  };

  for (const row of table.rows) {
    const { fields } = row;
    const numbers = own.slice(1, -1).map((_, k) => read(fields[k + 1] ?? "", k < 3));
    const reason = reasonFor(row, numbers);
    if (reason) {
      bad.push({ row, reason });
      continue;
    }
    seen.add(fields[0]);
    rows.push([
      fields[0],
      ...(numbers as number[]),
      fields[own.length - 1],
      ...(described < 0 ? [] : [lineOf(fields[described])]),
    ]);
  }
  const header = described < 0 ? own : [...own, "description"];
  return { file: csvText(header, rows, own.length), count: rows.length, bad };
}
