// The entry of the module that imports tables, emission profiles and meshes, which the page loads with the first of them.

import { listKindOf } from "../planogram/list";
import { shopOf } from "../planogram/shop";
import { textOf } from "../table/decode";
import { readTable } from "../table/table";
import { hasMeasurements, openComparison } from "./comparison_dialog";
import type { Host } from "./host";
import { openList } from "./list_dialog";
import { openMesh, type MeshFacts } from "./mesh_dialog";
import { openPlanogram } from "./planogram_dialog";
import type { Photometry } from "./polar";
import { openProfile } from "./profile_dialog";
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
  const table = readTable(bytes);
  useTexts(host.text);
  if (hasMeasurements(table)) {
    await openComparison(host, name, table, textOf(bytes));
    return;
  }
  const kind = listKindOf(table);
  if (kind) openList(host, name, table, kind);
  else openPlanogram(host, name, table, await shopOf(host.planner.document));
}
