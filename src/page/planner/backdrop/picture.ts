// The pixels of the picture of the floor plan: at most one picture, fetched when the store names it.

import type { Changes } from "../changes";
import { DetailView } from "../sheet/detail";
import { LineIndex } from "../sheet/line_index";
import { openSheet, Unreadable } from "../sheet/open";
import { wholeOf, type Sheet } from "../sheet/sheet";
import { say, text } from "../text";
import { hasLines, type Drawing } from "./drawing";

/** Larger pictures are made smaller, because browsers keep 4 bytes for each pixel. */
const mostPixels = 40e6;
/** Pictures are halved until they are no larger than this, so that thin lines stay visible from afar. */
const fewPixels = 1e6;
/** A page is drawn in about this many pixels; its visible part follows as finely as the screen shows it. */
const pagePixels = 8e6;

type State =
  | { kind: "none" }
  | { kind: "loading" }
  | { kind: "failed"; why: string; isLost: boolean }
  | { kind: "shown"; levels: Levels; page: Page | null };

/** The same picture in decreasing sizes. */
type Levels = readonly ImageBitmap[];

/** What a drawing of lines has besides. */
interface Page {
  sheet: Sheet;
  detail: DetailView;
  lines: LineIndex | null;
}

/** There is no picture to fetch; the message says why. */
class Unusable extends Error {}

function decoded(blob: Blob, { file, size: [width, height] }: Drawing): Promise<ImageBitmap> {
  const factor = Math.sqrt(mostPixels / (width * height));
  const options: ImageBitmapOptions =
    factor < 1 ? { resizeWidth: Math.floor(factor * width), resizeQuality: "high" } : {};
  return createImageBitmap(blob, options).catch(() => {
    throw new Unusable(say(text.picture.unreadable, file));
  });
}

async function levelsOf(finest: ImageBitmap): Promise<Levels> {
  const levels = [finest];
  for (let last = finest; last.width * last.height > fewPixels; levels.push(last))
    last = await createImageBitmap(last, { resizeWidth: Math.ceil(last.width / 2), resizeQuality: "medium" });
  return levels;
}

export class Picture {
  state: State = { kind: "none" };
  /** The file and the page. */
  private shown = "";

  /** `address`: of the page. */
  constructor(
    private readonly address: string,
    private readonly changes: Changes,
  ) {}

  /** Shows what the store names; true if that is another picture. One that a lost connection kept away is tried again. */
  follow(drawing: Drawing | null): boolean {
    const shown = keyOf(drawing);
    const isOther = shown !== this.shown;
    if (!isOther && !(this.state.kind === "failed" && this.state.isLost)) return false;
    this.shown = shown;
    if (!drawing) this.enter({ kind: "none" });
    else void this.load(drawing);
    return isOther;
  }

  private async load(drawing: Drawing): Promise<void> {
    this.enter({ kind: "loading" });
    const state = await this.fetched(drawing).catch((error: unknown): State => {
      const isLost = !(error instanceof Unusable);
      return { kind: "failed", why: isLost ? text.picture.lost : error.message, isLost };
    });
    if (keyOf(drawing) === this.shown) this.enter(state);
    else close(state);
  }

  private async fetched(drawing: Drawing): Promise<State> {
    const path = drawing.file.split("/").map(encodeURIComponent).join("/");
    const answer = await fetch(`${this.address}files/${path}`);
    if (!answer.ok) throw new Unusable(say(text.picture.missing, drawing.file));
    if (!hasLines(drawing.file))
      return { kind: "shown", levels: await levelsOf(await decoded(await answer.blob(), drawing)), page: null };
    return this.opened(await answer.arrayBuffer(), drawing).catch((error: unknown) => {
      throw error instanceof Unreadable ? new Unusable(`${drawing.file}: ${error.message}`) : error;
    });
  }

  private async opened(bytes: ArrayBuffer, { page: number = 1 }: Drawing): Promise<State> {
    const sheet = await openSheet(bytes, number, this.address);
    const [width, height] = sheet.size;
    const finest = await sheet.render(wholeOf(sheet.size), Math.sqrt(pagePixels / (width * height)));
    const page: Page = { sheet, detail: new DetailView(sheet, () => this.changes.note("picture")), lines: null };
    void sheet.lines().then(
      (lines) => {
        page.lines = new LineIndex(lines);
      },
      () => {}, // the page can still be traced by eye
    );
    return { kind: "shown", levels: await levelsOf(finest), page };
  }

  private enter(state: State): void {
    close(this.state);
    this.state = state;
    this.changes.note("layers");
  }

  /** The smallest level with at least a number of pixels in a row. */
  level(width: number): ImageBitmap | null {
    if (this.state.kind !== "shown") return null;
    const { levels } = this.state;
    return levels.reduce((least, level) => (level.width >= width ? level : least));
  }

  /** Of a drawing of lines. */
  get detail(): DetailView | null {
    return this.state.kind === "shown" ? (this.state.page?.detail ?? null) : null;
  }

  get lines(): LineIndex | null {
    return this.state.kind === "shown" ? (this.state.page?.lines ?? null) : null;
  }
}

const keyOf = (drawing: Drawing | null): string => (drawing ? `${drawing.file}#${drawing.page ?? 1}` : "");

function close(state: State): void {
  if (state.kind !== "shown") return;
  for (const level of state.levels) level.close();
  state.page?.detail.close();
  state.page?.sheet.close();
}
