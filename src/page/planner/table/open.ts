// Opens tables by a module that is loaded with the first of them.

import { openDialog } from "../access/dialog";
import { NotAccepted, upload, type Given } from "../backdrop/files";
import type { Planner } from "../planner";
import { say, text } from "../text";
import type { Fault } from "./fault";

type TableModule = typeof import("../importing/module");

const moduleAt = async (address: string) => (await import(`${address}table/table.js`)) as TableModule;

/** Keeps an emission profile or a mesh, and asks what it is for. Throws NotAccepted. */
export async function openDevice(planner: Planner, given: Given, address: string): Promise<void> {
  const stored = await upload(address, given);
  const { openDevice } = await moduleAt(address);
  const keep = () => Promise.resolve(stored.file);
  openDevice({ planner, text, openDialog, keep }, stored.file, stored);
}

/** `address`: of the page. Throws NotAccepted. */
export async function openTable(planner: Planner, given: Given, address: string): Promise<void> {
  const { openTable } = await moduleAt(address);
  const keep = async (name: string, content: string) => {
    const bytes = new TextEncoder().encode(content).buffer;
    return (await upload(address, { name, kind: "csv", bytes })).file;
  };
  try {
    await openTable({ planner, text, openDialog, keep }, given.name, new Uint8Array(given.bytes));
  } catch (error) {
    const { fault } = error as { fault?: Fault };
    throw fault === undefined ? error : new NotAccepted(say(text.planogram.faults[fault], given.name));
  }
}
