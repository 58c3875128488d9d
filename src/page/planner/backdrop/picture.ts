// The pixels of the picture of the floor plan: at most one picture, fetched when the store names it.

import type { Changes } from "../changes";
import { say, text } from "../text";
import type { Drawing } from "./drawing";

/** Larger pictures are made smaller, because browsers keep 4 bytes for each pixel. */
const mostPixels = 40e6;
/** Pictures are halved until they are no larger than this, so that thin lines stay visible from afar. */
const fewPixels = 1e6;

type State =
  | { kind: "none" }
  | { kind: "loading" }
  | { kind: "failed"; why: string; isLost: boolean }
  /** The same picture in decreasing sizes. */
  | { kind: "shown"; levels: readonly ImageBitmap[] };

/** There is no picture to fetch; the message says why. */
class Unusable extends Error {}

async function levelsOf(blob: Blob, { file, size: [width, height] }: Drawing): Promise<ImageBitmap[]> {
  const factor = Math.sqrt(mostPixels / (width * height));
  const options: ImageBitmapOptions =
    factor < 1 ? { resizeWidth: Math.floor(factor * width), resizeQuality: "high" } : {};
  const levels = [
    await createImageBitmap(blob, options).catch(() => {
      throw new Unusable(say(text.picture.unreadable, file));
    }),
  ];
  for (let [last] = levels; last.width * last.height > fewPixels; levels.push(last))
    last = await createImageBitmap(last, { resizeWidth: Math.ceil(last.width / 2), resizeQuality: "medium" });
  return levels;
}

export class Picture {
  state: State = { kind: "none" };
  private file = "";

  /** `address`: of the page. */
  constructor(
    private readonly address: string,
    private readonly changes: Changes,
  ) {}

  /** Shows what the store names; true if that is another picture. One that a lost connection kept away is tried again. */
  follow(drawing: Drawing | null): boolean {
    const file = drawing?.file ?? "";
    const isOther = file !== this.file;
    if (!isOther && !(this.state.kind === "failed" && this.state.isLost)) return false;
    this.file = file;
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
    if (drawing.file === this.file) this.enter(state);
    else if (state.kind === "shown") close(state.levels);
  }

  private async fetched(drawing: Drawing): Promise<State> {
    const path = drawing.file.split("/").map(encodeURIComponent).join("/");
    const answer = await fetch(`${this.address}files/${path}`);
    if (!answer.ok) throw new Unusable(say(text.picture.missing, drawing.file));
    return { kind: "shown", levels: await levelsOf(await answer.blob(), drawing) };
  }

  private enter(state: State): void {
    if (this.state.kind === "shown") close(this.state.levels);
    this.state = state;
    this.changes.note("layers");
  }

  /** The smallest level with at least a number of pixels in a row. */
  level(width: number): ImageBitmap | null {
    if (this.state.kind !== "shown") return null;
    const { levels } = this.state;
    return levels.reduce((least, level) => (level.width >= width ? level : least));
  }
}

function close(levels: readonly ImageBitmap[]): void {
  for (const level of levels) level.close();
}
