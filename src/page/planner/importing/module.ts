// The entry of the module that imports tables, emission profiles and meshes, which the page loads with the first of them.

import { isColumnName } from "../planogram/guess";
import { listKindOf } from "../planogram/list";
import { shopOf } from "../planogram/shop";
import { textOf } from "../table/decode";
import { readTable, type Reading } from "../table/table";
import { hasMeasurements, openComparison } from "./comparison_dialog";
import type { Host } from "./host";
import { openList } from "./list_dialog";
import { openMesh, type MeshFacts } from "./mesh_dialog";
import { openPlanogram } from "./planogram_dialog";
import type { Photometry } from "./polar";
import { openProfile } from "./profile_dialog";
import { sourceRows } from "./source_form";
import { useTexts } from "./text";

export interface DeviceFacts {
  photometry?: Photometry;
  mesh?: MeshFacts;
}

/** A profile or a mesh, with what the program says of it. */
export function openDevice(host: Host, file: string, facts: DeviceFacts): void {
  useTexts(host.text);
  if (facts.photometry) openProfile(host, file, facts.photometry);
  else if (facts.mesh) openMesh(host, file, facts.mesh);
}

/** Throws NotATable. */
export async function openTable(host: Host, name: string, bytes: Uint8Array): Promise<void> {
  const shop = await shopOf(host.planner.document);
  const open = (reading: Reading): HTMLDialogElement | Promise<unknown> => {
    const table = readTable(bytes, isColumnName, reading);
    if (hasMeasurements(table)) return openComparison(host, name, table, textOf(bytes, table.encoding).text);
    const kind = listKindOf(table);
    const rows = sourceRows(table, reading, (other) => {
      dialog.close();
      open(other);
    });
    const dialog = kind ? openList(host, name, table, kind, rows) : openPlanogram(host, name, table, shop, rows);
    return dialog;
  };
  useTexts(host.text);
  await open({});
}
