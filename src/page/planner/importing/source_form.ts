// How the file is read: its encoding, if it does not show it, and the line with the names of its columns.

import { say } from "../../data/text";
import { element } from "../../panel/dom";
import { encodings, type Encoding } from "../table/decode";
import type { Reading, Table } from "../table/table";
import { text } from "./text";

/** A choice; `isMissing`: without a value yet. */
export function choiceRow(
  key: string,
  name: string,
  options: readonly (readonly [string, string])[],
  value: string,
  chosen: (value: string) => void,
  isMissing = false,
): HTMLElement {
  const id = `table-${key}`;
  const select = element("select", {
    id,
    "data-key": id,
    "aria-invalid": isMissing ? "true" : undefined,
    on: { change: () => chosen(select.value) },
  });
  for (const [own, words] of options) select.append(element("option", { value: own, text: words }));
  select.value = value;
  return element("div", { class: "row" }, element("label", { for: id, text: name }), select);
}

const longest = 60; // characters of a line

/** `again`: reads the file in another way. */
export function sourceRows(table: Table, reading: Reading, again: (reading: Reading) => void): HTMLElement[] {
  const { encoding, first, headerAt } = table;
  const lines = first.map(({ line, fields }, at): [string, string] => {
    const content = fields.filter((field) => field !== "").join(", ");
    return [String(at), say(text.planogram.header_line, line, content.slice(0, longest))];
  });
  const header = choiceRow(
    "header",
    text.planogram.header,
    [["-1", text.planogram.no_header], ...lines],
    String(headerAt),
    (at) => again({ ...reading, headerAt: Number(at) }),
  );
  if (!encoding) return [header];
  const choose = (chosen: string) => again({ ...reading, encoding: chosen as Encoding });
  return [choiceRow("encoding", text.planogram.encoding, Object.entries(encodings), encoding, choose), header];
}
