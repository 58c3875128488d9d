// PDF files: a module of its own, loaded with the first of them. Scripts, forms and attachments of a file are not read.

import * as reader from "pdfjs-dist/legacy/build/pdf.mjs";
import type { PDFDocumentProxy, PDFPageProxy } from "pdfjs-dist/legacy/build/pdf.mjs";

import type { Point } from "../document/messages";
import type { Matrix } from "../dxf/shape/matrix";
import { inTime, wholeOf, type Lines, type Region, type Sheet } from "../sheet/sheet";
import { linesOf, type Operations } from "./paths";

/** Why a file cannot be opened: a key of the texts. */
export type PdfFault = "password" | "broken" | "form" | "no_page" | "slow";

export class PdfError extends Error {
  constructor(readonly fault: PdfFault) {
    super(fault);
  }
}

const mostImagePixels = 100e6;

/** The result, or the fault that the reader names. */
async function within<Value>(work: Promise<Value>): Promise<Value> {
  try {
    return await inTime(work, () => new PdfError("slow"));
  } catch (error) {
    if (error instanceof PdfError) throw error;
    throw new PdfError(error instanceof Error && error.name === "PasswordException" ? "password" : "broken");
  }
}

class PdfSheet implements Sheet {
  readonly size: Point;
  readonly layers = [];
  private readonly frame;

  constructor(
    private readonly file: PdfFile,
    private readonly page: PDFPageProxy,
  ) {
    this.frame = page.getViewport({ scale: 1 });
    this.size = [this.frame.width, this.frame.height];
  }

  hide(): void {}

  async render({ left, upper, width, height }: Region, scale: number): Promise<ImageBitmap> {
    const canvas = document.createElement("canvas");
    canvas.width = Math.max(Math.round(scale * width), 1);
    canvas.height = Math.max(Math.round(scale * height), 1);
    const viewport = this.page.getViewport({ scale, offsetX: -scale * left, offsetY: -scale * upper });
    const task = this.page.render({ canvas, viewport, annotationMode: reader.AnnotationMode.DISABLE });
    try {
      await within(task.promise);
    } catch (error) {
      task.cancel();
      throw error;
    }
    return createImageBitmap(canvas);
  }

  async lines(): Promise<Lines> {
    const [list, layers] = await within(
      Promise.all([this.page.getOperatorList({ annotationMode: reader.AnnotationMode.DISABLE }), this.file.layers()]),
    );
    const frame = { page: this.frame.transform as unknown as Matrix, size: this.size };
    return linesOf(list, reader.OPS as unknown as Operations, frame, (layer) =>
      layers.isVisible(layer as Parameters<typeof layers.isVisible>[0]),
    );
  }

  close(): void {
    this.page.cleanup();
    this.file.close();
  }
}

export class PdfFile {
  constructor(private readonly document: PDFDocumentProxy) {}

  get pages(): number {
    return this.document.numPages;
  }

  layers() {
    return this.document.getOptionalContentConfig();
  }

  /** From 1. The sheet closes the file. */
  async page(number: number): Promise<Sheet> {
    if (number < 1 || number > this.pages) throw new PdfError("no_page");
    return new PdfSheet(this, await within(this.document.getPage(number)));
  }

  /** A small picture of a page, at most `side` pixels wide and high. */
  async thumbnail(number: number, side: number): Promise<ImageBitmap> {
    const page = await within(this.document.getPage(number));
    const sheet = new PdfSheet(this, page);
    const picture = await sheet.render(wholeOf(sheet.size), side / Math.max(...sheet.size));
    page.cleanup();
    return picture;
  }

  close(): void {
    void this.document.loadingTask.destroy();
  }
}

/** `address`: of the files of this module, with a slash at its end. Throws PdfError. */
export async function openPdf(data: Uint8Array, address: string): Promise<PdfFile> {
  reader.GlobalWorkerOptions.workerSrc = `${address}worker.js`;
  const task = reader.getDocument({
    data,
    wasmUrl: address,
    cMapUrl: address,
    standardFontDataUrl: address,
    enableXfa: false,
    stopAtErrors: false,
    maxImageSize: mostImagePixels,
    verbosity: reader.VerbosityLevel.ERRORS,
  });
  try {
    const file = new PdfFile(await within(task.promise));
    const { info } = await within((await task.promise).getMetadata());
    // Without scripts, such a form shows nothing but a request for another program.
    const { IsXFAPresent, IsAcroFormPresent } = info as Record<string, unknown>;
    if (IsXFAPresent === true && IsAcroFormPresent !== true) throw new PdfError("form");
    return file;
  } catch (error) {
    void task.destroy();
    throw error;
  }
}
