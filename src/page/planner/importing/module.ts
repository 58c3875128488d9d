// The entry of the module that imports tables, which the page loads with the first of them.

import { listKindOf } from "../planogram/list";
import { shopOf } from "../planogram/shop";
import { readTable } from "../table/table";
import type { Host } from "./host";
import { openList } from "./list_dialog";
import { openPlanogram } from "./planogram_dialog";
import { useTexts } from "./text";

/** Throws NotATable. */
export async function openTable(host: Host, name: string, bytes: Uint8Array): Promise<void> {
  const table = readTable(bytes);
  useTexts(host.text);
  const kind = listKindOf(table);
  if (kind) openList(host, name, table, kind);
  else openPlanogram(host, name, table, await shopOf(host.planner.document));
}
