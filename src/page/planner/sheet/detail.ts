// The visible part of a drawing of lines, drawn anew as finely as the screen shows it: after the view has come to rest,
// because a page of many lines takes longer than a frame.

import { wholeOf, type Region, type Sheet } from "./sheet";

const rest = 160; // ms
const mostPixels = 16e6;
/** Larger pictures make thin lines faint where they are shown smaller. */
export const coarsest = 1.6;
/** A share of the view that is drawn beyond each of its sides, so that small moves need nothing new. */
const margin = 0.25;

export interface Detail {
  bitmap: ImageBitmap;
  region: Region;
  /** Pixels of the bitmap per pixel of the picture. */
  scale: number;
}

const right = ({ left, width }: Region) => left + width;
const lower = ({ upper, height }: Region) => upper + height;

function common(a: Region, b: Region): Region | null {
  const left = Math.max(a.left, b.left);
  const upper = Math.max(a.upper, b.upper);
  const width = Math.min(right(a), right(b)) - left;
  const height = Math.min(lower(a), lower(b)) - upper;
  return width > 0 && height > 0 ? { left, upper, width, height } : null;
}

const holds = (a: Region, b: Region): boolean =>
  a.left <= b.left && a.upper <= b.upper && right(a) >= right(b) && lower(a) >= lower(b);

export class DetailView {
  now: Detail | null = null;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private isBusy = false;
  private isClosed = false;
  private edition = 0;

  /** `onDrawn`: there is a new part. */
  constructor(
    private readonly sheet: Sheet,
    private readonly onDrawn: () => void,
  ) {}

  /** The view shows a region, and `scale` of its pixels for each pixel of the picture. */
  show(view: Region, scale: number): void {
    clearTimeout(this.timer);
    const whole = wholeOf(this.sheet.size);
    const seen = common(view, whole);
    if (!seen || this.isClosed) return;
    const [u, v] = [margin * view.width, margin * view.height];
    const wide = { left: view.left - u, upper: view.upper - v, width: view.width + 2 * u, height: view.height + 2 * v };
    const region = common(wide, whole) ?? seen;
    const finest = Math.min(scale, Math.sqrt(mostPixels / (region.width * region.height)));
    const { now } = this;
    if (now && holds(now.region, seen) && now.scale >= 0.9 * finest && now.scale <= coarsest * scale) return;
    this.timer = setTimeout(() => {
      if (this.isBusy) this.show(view, scale);
      else void this.draw(region, finest);
    }, rest);
  }

  private async draw(region: Region, scale: number): Promise<void> {
    const { edition } = this;
    this.isBusy = true;
    try {
      const bitmap = await this.sheet.render(region, scale);
      if (this.isClosed || edition !== this.edition) {
        bitmap.close();
        return;
      }
      this.now?.bitmap.close();
      this.now = { bitmap, region, scale };
      this.onDrawn();
    } catch {
      // The whole page stays as it is.
    } finally {
      this.isBusy = false;
    }
  }

  /** The drawing has changed. */
  forget(): void {
    ++this.edition;
    clearTimeout(this.timer);
    this.now?.bitmap.close();
    this.now = null;
  }

  close(): void {
    this.isClosed = true;
    this.forget();
  }
}
