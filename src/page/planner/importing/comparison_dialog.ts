// The dialog that compares measured signals with those of the newest plan of the project.

import { counted, grouped, percent } from "../../data/format";
import { say } from "../../data/text";
import { element } from "../../panel/dom";
import type { Table } from "../table/table";
import type { Host } from "./host";
import { text } from "./text";

/** As `shelfbeam compare --json` prints it; decibels are those of power. */
interface Summary {
  pairs: number;
  confidence: number;
  median_residual_db: number | null;
  ninety_residual_db: number | null;
  correlation: number | null;
  outliers: Pair[];
  worst: Pair[];
  plan: string;
  output: string;
}

interface Pair {
  label: string;
  transceiver: string | null;
  measured: number;
  expected: number;
  residual_db: number | null;
}

const columns = ["label", "transceiver", "signal", "error"];

/** Whether the table has measured signals, as `compare` reads them. */
export function hasMeasurements({ header }: Table): boolean {
  const names = header.map((name) => name.trim().toLowerCase());
  return names.includes("label") && names.includes("signal") && names.every((name) => columns.includes(name));
}

function pairTable(pairs: readonly Pair[]): HTMLElement {
  const cells = (row: readonly string[], tag: "th" | "td") => row.map((cell) => element(tag, { text: cell }));
  const number = (value: number) => Number(value.toPrecision(3)).toString();
  return element(
    "table",
    {},
    element("thead", {}, element("tr", {}, ...cells(text.comparison.columns, "th"))),
    element(
      "tbody",
      {},
      ...pairs.map(({ label, transceiver, measured, expected, residual_db }) => {
        const decibels = residual_db === null ? "–" : residual_db.toFixed(1);
        return element(
          "tr",
          {},
          ...cells(
            [label, transceiver ?? text.comparison.all_units, number(measured), number(expected), decibels],
            "td",
          ),
        );
      }),
    ),
  );
}

function resultOf(summary: Summary): HTMLElement[] {
  const { median_residual_db: median, ninety_residual_db: ninety, correlation, outliers, worst } = summary;
  const lines = [
    say(text.comparison.lead, counted(text.comparison.signals, summary.pairs), summary.plan),
    ...(median === null || ninety === null
      ? []
      : [say(text.comparison.agreement, median.toFixed(1), ninety.toFixed(1))]),
    ...(correlation === null ? [] : [say(text.comparison.correlation, correlation.toFixed(2))]),
    outliers.length === 0
      ? text.comparison.no_outliers
      : say(text.comparison.outliers, grouped(outliers.length), percent(summary.confidence)),
  ];
  const listed = outliers.length > 0 ? outliers : worst;
  return [
    ...lines.map((line) => element("p", { text: line })),
    ...(listed.length > 0 ? [pairTable(listed)] : []),
    element("p", { class: "note", text: say(text.comparison.files, summary.output) }),
  ];
}

/** A lost connection has no words of its own. */
const reasonOf = (error: unknown): string => (error instanceof Error && error.message) || text.notices.no_connection;

/** Keeps the table as it is, and shows the result when the program has it. */
export async function openComparison(host: Host, name: string, table: Table, content: string): Promise<void> {
  const kept = await host.keep(name, content);
  const ofPairs = table.header.some((column) => column.trim().toLowerCase() === "transceiver");
  const body = element("div", { class: "content", role: "status" }, element("p", { text: text.comparison.running }));
  host.openDialog(say(text.comparison.title, name), "comparison", body);
  void host.planner.document
    .request<{ comparison: Summary }>("compare", { file: kept, of_pairs: ofPairs })
    .then(({ comparison }) => resultOf(comparison))
    .catch((error: unknown) => [element("p", { class: "problem", text: reasonOf(error) })])
    .then((found) => body.replaceChildren(...found));
}
