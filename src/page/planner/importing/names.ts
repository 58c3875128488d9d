// What people call the columns of a file and their meanings.

import { say } from "../../data/text";
import type { Form, Role } from "../planogram/mapping";
import type { Table } from "../table/table";
import { text } from "./text";

export const columnName = ({ header }: Table, column: number): string =>
  header[column] || say(text.planogram.column, column + 1);

/** Planogram programs have names of their own. */
export function roleName(form: Form, role: Role): string {
  if (form === "segments" && role === "level") return text.planogram.roles.shelf;
  return form === "segments" && role === "place" ? text.planogram.roles.sequence : text.planogram.roles[role];
}
