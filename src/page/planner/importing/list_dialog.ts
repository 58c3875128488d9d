// The dialog that imports a list of labels or of candidates.

import { counted } from "../../data/format";
import { say } from "../../data/text";
import { button, element } from "../../panel/dom";
import { EditBuilder } from "../document/edit";
import { isObject, valueAt, type Json } from "../document/json";
import { checkList, type ListKind } from "../planogram/list";
import type { Table } from "../table/table";
import { BadLines } from "./bad_lines";
import type { Host } from "./host";
import { text } from "./text";

const places: Record<
  ListKind,
  { path: string; types: "label_types" | "transceiver_types"; counted: "label" | "unit" }
> = {
  labels: { path: "/labels", types: "label_types", counted: "label" },
  units: { path: "/transceivers/list", types: "transceiver_types", counted: "unit" },
};

/** What the list takes the place of; empty if there is nothing. */
function presentText(present: Json | undefined, kind: "label" | "unit"): string {
  if (Array.isArray(present)) return present.length === 0 ? "" : counted(text.counted[kind], present.length);
  return isObject(present) ? String(present.csv) : "";
}

/** `source`: rows about the file itself. */
export function openList(
  host: Host,
  name: string,
  table: Table,
  kind: ListKind,
  source: readonly HTMLElement[],
): HTMLDialogElement {
  const { planner } = host;
  const { document } = planner;
  const { path, types, counted: what } = places[kind];
  const own = valueAt(document.json, `/${types}`);
  const known = [...(isObject(own) ? Object.keys(own) : []), ...(document.shared[types] ?? [])];
  const { file, count, bad } = checkList(table, kind, known, document.unit.factor);
  const present = presentText(valueAt(document.json, path), what);
  const says = element("p", { class: "says", role: "status", text: counted(text.planogram.left_out, bad.length) });
  const words = counted(text.counted[what], count);

  const finish = async () => {
    add.disabled = true;
    try {
      const kept = await host.keep(name, file);
      const builder = new EditBuilder(document.json);
      builder.set(path, { csv: kept });
      dialog.close();
      const label = text.edits[kind === "labels" ? "add_labels" : "add_units"];
      if (builder.ops.length > 0 && !(await document.edit({ label, ops: builder.ops }))) return;
      planner.say(say(text.planogram.added, words, kept, String(bad.length)));
    } catch (error) {
      says.textContent = error instanceof Error ? error.message : String(error);
      add.disabled = false;
    }
  };
  const add = button(
    say(present === "" ? text.planogram.add_list : text.planogram.replace_list, words, present),
    () => void finish(),
    { class: "primary", "data-key": "add-list", disabled: count === 0, autofocus: true },
  );
  const badLines = new BadLines();
  const dialog = host.openDialog(
    say(text.planogram.list_titles[kind], name),
    "planogram list",
    element("p", { class: "lead", text: present === "" ? words : say(text.planogram.replaces_list, words, present) }),
    element("div", { class: "content" }, ...source, badLines.root),
    element("footer", {}, says, add),
  );
  badLines.show(bad);
  return dialog;
}
