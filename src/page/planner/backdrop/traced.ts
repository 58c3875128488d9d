// The lines of the picture, which attract the pointer as those of the shop do.

import type { Point } from "../document/messages";
import { boundsOf, rectangle, type Bounds } from "../geometry/bounds";
import type { Planner } from "../planner";
import type { LineIndex } from "../sheet/line_index";
import type { LineSource } from "../snap/segment_index";
import type { Segment } from "../snap/segments";
import { placementOf, screenPixel, shownCorners, toPixel, toWorld, type Placement } from "./transform";

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
    const { index, placement } = seen;
    return found(index, placement).map(([from, to]) => ({
      from: toWorld(placement, from),
      to: toWorld(placement, to),
    }));
  }

  private seen(): { index: LineIndex; placement: Placement } | null {
    const { drawing, picture, look, document, viewport } = this.planner;
    const index = picture.lines;
    if (!drawing || !index || !look.now.isShown) return null;
    const placement = placementOf(drawing, document.unit);
    index.shown = drawing.crop ? boundsOf(shownCorners(drawing)) : null;
    index.least = leastLength * screenPixel(placement, viewport);
    return { index, placement };
  }
}
