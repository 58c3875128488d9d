// The first rows of the file, and what its columns are.

import { element } from "../../panel/dom";
import { roles, type Mapping } from "../planogram/mapping";
import type { Table } from "../table/table";
import { columnName, roleName } from "./names";

const shown = 4;

export function preview(table: Table, { columns, form }: Mapping): HTMLElement {
  const roleAt = (column: number) => {
    const role = roles.find((one) => columns[one] === column);
    return role === undefined ? "" : roleName(form, role);
  };
  const { header, rows } = table;
  return element(
    "table",
    {},
    element(
      "thead",
      {},
      element("tr", {}, ...header.map((_, column) => element("th", { scope: "col", text: columnName(table, column) }))),
      element("tr", { class: "meant" }, ...header.map((_, column) => element("td", { text: roleAt(column) }))),
    ),
    element(
      "tbody",
      {},
      ...rows
        .filter(({ fault }) => !fault)
        .slice(0, shown)
        .map(({ fields }) => element("tr", {}, ...fields.map((field) => element("td", { text: field })))),
    ),
  );
}
