// Opens drawings of lines by modules that are loaded with the first of them.

import { grouped } from "../../data/format";
import type { Drawing } from "../backdrop/drawing";
import type { DxfNote } from "../dxf/drawing";
import { DxfFault, DxfSheet } from "../dxf/show/sheet";
import { say, text } from "../text";
import type { Sheet } from "./sheet";

/** The file cannot be opened; the message says why. */
export class Unreadable extends Error {}

type PdfModule = typeof import("../pdf/pdf");
export type PdfFile = Awaited<ReturnType<PdfModule["openPdf"]>>;

export const noteText = ({ code, name, count }: DxfNote): string =>
  say(text.dxf.notes[code], name ?? text.dxf.others, count);

/** What the modules say, in words: throws Unreadable, or the error itself. */
export function worded(error: unknown): never {
  if (error instanceof DxfFault) {
    const { fault, values, notes } = error.given;
    if (notes && notes.length > 0) throw new Unreadable(say(text.dxf.faults[fault], notes.map(noteText).join(". ")));
    const shown = Object.values(values).map((value) => (typeof value === "number" ? grouped(value) : value));
    throw new Unreadable(say(text.dxf.faults[fault], ...shown));
  }
  const { fault } = error as { fault?: keyof typeof text.pdf.faults };
  throw fault === undefined ? error : new Unreadable(text.pdf.faults[fault]);
}

/** `address`: of the page. */
export async function openPdf(bytes: ArrayBuffer, address: string): Promise<PdfFile> {
  const module = (await import(`${address}pdf/pdf.js`)) as PdfModule;
  // The reader takes the bytes away.
  return module.openPdf(new Uint8Array(bytes.slice(0)), `${address}pdf/`).catch(worded);
}

export const pageOf = (file: PdfFile, page: number): Promise<Sheet> => file.page(page).catch(worded);

/** Keeps the bytes. */
export const openDxf = (bytes: ArrayBuffer, address: string): Promise<DxfSheet> =>
  DxfSheet.open(bytes.slice(0), address).catch(worded);

export async function openSheet(bytes: ArrayBuffer, { file, page = 1 }: Drawing, address: string): Promise<Sheet> {
  return /\.dxf$/i.test(file) ? openDxf(bytes, address) : pageOf(await openPdf(bytes, address), page);
}
