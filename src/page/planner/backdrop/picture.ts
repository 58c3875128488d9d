// The pixels of the picture of the floor plan: at most one picture, fetched when the store names it.

import type { Changes } from "../changes";
import { DetailView } from "../sheet/detail";
import { LineIndex } from "../sheet/line_index";
import { openSheet, Unreadable, worded } from "../sheet/open";
import { wholeOf, type Sheet } from "../sheet/sheet";
import type { Point } from "../document/messages";
import { say, text } from "../text";
import { hasLines, type Drawing } from "./drawing";
import type { Look } from "./look";

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

/** Relative difference of sizes that are the same. */
const slack = 0.001;

/** The same picture in decreasing sizes. */
type Levels = readonly ImageBitmap[];

/** What a drawing of lines has besides. */
interface Page {
  sheet: Sheet;
  detail: DetailView;
  lines: LineIndex | null;
  hidden: ReadonlySet<number>;
}

/** There is no picture to fetch; the message says why. */
class Unusable extends Error {}

/**
 * The store's size gives the scale: a file that has changed since then must not be stretched to it. `step`: to which the
 * size is known. Throws Unusable.
 */
function requireSize({ file, size }: Drawing, found: Point, step = 0): void {
  if (found.every((length, axis) => Math.abs(length - size[axis]) <= Math.max(slack * size[axis], step))) return;
  const [width, height] = found.map((length) => Number(length.toPrecision(6)));
  throw new Unusable(say(text.picture.changed, file, width, height, ...size));
}

async function decoded(blob: Blob, drawing: Drawing): Promise<ImageBitmap> {
  const [width, height] = drawing.size;
  const factor = Math.sqrt(mostPixels / (width * height));
  const options: ImageBitmapOptions =
    factor < 1 ? { resizeWidth: Math.floor(factor * width), resizeQuality: "high" } : {};
  const bitmap = await createImageBitmap(blob, options).catch(() => {
    throw new Unusable(say(text.picture.unreadable, drawing.file));
  });
  const step = width / (options.resizeWidth ?? width);
  requireSize(drawing, [step * bitmap.width, step * bitmap.height], step === 1 ? 0 : step);
  return bitmap;
}

async function levelsOf(finest: ImageBitmap): Promise<Levels> {
  const levels = [finest];
  for (let last = finest; last.width * last.height > fewPixels; levels.push(last))
    last = await createImageBitmap(last, { resizeWidth: Math.ceil(last.width / 2), resizeQuality: "medium" });
  return levels;
}

export class Picture {
  state: State = { kind: "none" };
  /** What the store names. */
  private wanted: Drawing | null = null;
  private offered: { key: string; sheet: Sheet } | null = null;

  /** `address`: of the page. */
  constructor(
    private readonly address: string,
    private readonly changes: Changes,
    private readonly look: Look,
  ) {}

  /** Shows what the store names; true if that is another picture. One that a lost connection kept away is tried again. */
  follow(drawing: Drawing | null): boolean {
    const isOther = keyOf(drawing) !== keyOf(this.wanted);
    if (!isOther && !(this.state.kind === "failed" && this.state.isLost)) return false;
    this.wanted = drawing;
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
    if (keyOf(drawing) === keyOf(this.wanted)) this.enter(state);
    else close(state);
  }

  private async fetched(drawing: Drawing): Promise<State> {
    const sheet = this.offered?.key === keyOf(drawing) ? this.offered.sheet : null;
    this.offered = sheet ? null : this.offered;
    return (sheet ? this.opened(sheet) : this.read(drawing)).catch((error: unknown) => {
      throw error instanceof Unreadable ? new Unusable(`${drawing.file}: ${error.message}`) : error;
    });
  }

  private async read(drawing: Drawing): Promise<State> {
    const path = drawing.file.split("/").map(encodeURIComponent).join("/");
    const answer = await fetch(`${this.address}files/${path}`);
    if (!answer.ok) throw new Unusable(say(text.picture.missing, drawing.file));
    if (!hasLines(drawing.file))
      return { kind: "shown", levels: await levelsOf(await decoded(await answer.blob(), drawing)), page: null };
    const sheet = await openSheet(await answer.arrayBuffer(), drawing, this.address);
    try {
      requireSize(drawing, sheet.size);
    } catch (error) {
      sheet.close();
      throw error;
    }
    return this.opened(sheet);
  }

  private async opened(sheet: Sheet): Promise<State> {
    const hidden = this.hiddenOf(sheet);
    sheet.hide(hidden);
    const detail = new DetailView(sheet, () => this.changes.note("picture"));
    const page: Page = { sheet, detail, lines: null, hidden };
    const levels = await drawn(sheet).catch((error: unknown) => {
      sheet.close();
      return worded(error);
    });
    void sheet.lines().then(
      (lines) => {
        page.lines = new LineIndex(lines);
        page.lines.hidden = page.hidden;
      },
      () => {}, // the page can still be traced by eye
    );
    return { kind: "shown", levels, page };
  }

  private hiddenOf({ layers }: Sheet): ReadonlySet<number> {
    const decided = this.look.layersOf(this.wanted?.file ?? "");
    return new Set([...layers.keys()].filter((k) => !(decided[layers[k].name] ?? layers[k].isOn)));
  }

  /** A drawing that is open already, before the store names it. */
  offer(drawing: Pick<Drawing, "file" | "page" | "size">, sheet: Sheet): void {
    this.offered?.sheet.close();
    this.offered = { key: keyOf(drawing), sheet };
  }

  /** Draws the layers that are shown now. */
  async followLayers(): Promise<void> {
    const { state } = this;
    if (state.kind !== "shown" || !state.page) return;
    const { page } = state;
    const hidden = this.hiddenOf(page.sheet);
    if (hidden.size === page.hidden.size && [...hidden].every((layer) => page.hidden.has(layer))) return;
    page.hidden = hidden;
    page.sheet.hide(hidden);
    if (page.lines) page.lines.hidden = hidden;
    page.detail.forget();
    const levels = await drawn(page.sheet).catch(() => null);
    if (!levels) return;
    if (this.state !== state || page.hidden !== hidden) closeAll(levels);
    else this.enter({ ...state, levels }, true);
  }

  /** `isSame`: only the levels are others. */
  private enter(state: State, isSame = false): void {
    if (!isSame) close(this.state);
    else if (this.state.kind === "shown") closeAll(this.state.levels);
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
  private get page(): Page | null {
    return this.state.kind === "shown" ? this.state.page : null;
  }

  get detail(): DetailView | null {
    return this.page?.detail ?? null;
  }

  get sheet(): Sheet | null {
    return this.page?.sheet ?? null;
  }

  /** Numbers of the layers that are not shown. */
  get hidden(): ReadonlySet<number> {
    return this.page?.hidden ?? new Set();
  }

  get lines(): LineIndex | null {
    return this.page?.lines ?? null;
  }
}

const keyOf = (drawing: Pick<Drawing, "file" | "page" | "size"> | null): string =>
  drawing ? [drawing.file, drawing.page ?? 1, ...drawing.size].join("#") : "";

function drawn(sheet: Sheet): Promise<Levels> {
  const [width, height] = sheet.size;
  return sheet.render(wholeOf(sheet.size), Math.sqrt(pagePixels / (width * height))).then(levelsOf);
}

function closeAll(levels: Levels): void {
  for (const level of levels) level.close();
}

function close(state: State): void {
  if (state.kind !== "shown") return;
  closeAll(state.levels);
  state.page?.detail.close();
  state.page?.sheet.close();
}
