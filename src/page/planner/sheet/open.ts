// Opens drawings of lines by modules that are loaded with the first of them.

import { text } from "../text";
import type { Sheet } from "./sheet";

/** The file cannot be opened; the message says why. */
export class Unreadable extends Error {}

type PdfModule = typeof import("../pdf/pdf");
export type PdfFile = Awaited<ReturnType<PdfModule["openPdf"]>>;

/** What the module says, in words. */
const worded = (error: unknown): never => {
  const { fault } = error as { fault?: keyof typeof text.pdf };
  throw fault === undefined ? error : new Unreadable(text.pdf[fault]);
};

/** `address`: of the page. */
export async function openPdf(bytes: ArrayBuffer, address: string): Promise<PdfFile> {
  const module = (await import(`${address}pdf/pdf.js`)) as PdfModule;
  // The reader takes the bytes away.
  return module.openPdf(new Uint8Array(bytes.slice(0)), `${address}pdf/`).catch(worded);
}

export const pageOf = (file: PdfFile, page: number): Promise<Sheet> => file.page(page).catch(worded);

export const openSheet = async (bytes: ArrayBuffer, page: number, address: string): Promise<Sheet> =>
  pageOf(await openPdf(bytes, address), page);
