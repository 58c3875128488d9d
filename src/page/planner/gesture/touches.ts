// Two fingers move the plan and change its scale.

import type { Point } from "../document/messages";
import { between, distance, minus } from "../geometry/vector";
import type { Viewport } from "../view/viewport";

export class Touches {
  private readonly fingers = new Map<number, Point>();

  constructor(private readonly viewport: Viewport) {}

  /** True if it is the second finger. */
  press({ pointerId }: PointerEvent, screen: Point): boolean {
    this.fingers.set(pointerId, screen);
    return this.fingers.size === 2;
  }

  release({ pointerId }: PointerEvent): void {
    this.fingers.delete(pointerId);
  }

  move({ pointerId }: PointerEvent, screen: Point): void {
    if (!this.fingers.has(pointerId) || this.fingers.size !== 2) return;
    const before = [...this.fingers.values()];
    this.fingers.set(pointerId, screen);
    const after = [...this.fingers.values()];
    const [x, y] = minus(between(after[0], after[1]), between(before[0], before[1]));
    this.viewport.pan(x, y);
    const factor = distance(after[0], after[1]) / Math.max(distance(before[0], before[1]), 1);
    this.viewport.zoom(factor, between(after[0], after[1]));
  }
}
