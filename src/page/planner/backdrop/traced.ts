// The lines of the picture, which attract the pointer as those of the shop do.

import type { Point } from "../document/messages";
import { boundsOf, rectangle, type Bounds } from "../geometry/bounds";
import { distance } from "../geometry/vector";
import type { Planner } from "../planner";
import type { LineIndex } from "../sheet/line_index";
import type { LineSource } from "../snap/segment_index";
import type { Segment } from "../snap/segments";
import { placementOf, shownCorners, toPixel, toWorld, type Placement } from "./transform";

/** Pixels of the screen: shorter lines are of letters and hatches. */
const leastLength = 5;

export class Traced implements LineSource {
  constructor(private readonly planner: Planner) {}

  near(point: Point, reach: number, most: number): Segment[] {
    return this.take((index, placement) => index.near(toPixel(placement, point), reach / placement.step, most));
  }

  within(bounds: Bounds, most: number): Segment[] {
    return this.take((index, placement) => {
      const around = boundsOf(rectangle(bounds).map((corner) => toPixel(placement, corner)));
      return around ? index.within(around, most) : [];
    });
  }

  /** The smallest closed outline around a place. */
  outlineAt(point: Point): Point[] | null {
    const seen = this.seen();
    if (!seen) return null;
    const found = seen.index.outlineAt(toPixel(seen.placement, point));
    return found?.map((corner) => toWorld(seen.placement, corner)) ?? null;
  }

  /** The closed outlines of a layer. */
  outlinesOf(layer: number): Point[][] {
    const seen = this.seen();
    if (!seen) return [];
    return seen.index.outlinesOf(layer).map((outline) => outline.map((corner) => toWorld(seen.placement, corner)));
  }

  private take(found: (index: LineIndex, placement: Placement) => [Point, Point][]): Segment[] {
    const seen = this.seen();
    if (!seen) return [];
    const { index, placement, shown } = seen;
    const isShown = ([x, y]: Point) =>
      x >= shown.lower[0] && x <= shown.upper[0] && y >= shown.lower[1] && y <= shown.upper[1];
    const least = leastLength / (placement.step * this.planner.viewport.scale);
    return found(index, placement)
      .filter(([from, to]) => distance(from, to) >= least && (isShown(from) || isShown(to)))
      .map(([from, to]) => ({ from: toWorld(placement, from), to: toWorld(placement, to) }));
  }

  private seen(): { index: LineIndex; placement: Placement; shown: Bounds } | null {
    const { drawing, picture, look, document } = this.planner;
    const index = picture.lines;
    const shown = drawing && boundsOf(shownCorners(drawing));
    if (!drawing || !index || !shown || !look.now.isShown) return null;
    return { index, shown, placement: placementOf(drawing, document.unit) };
  }
}
