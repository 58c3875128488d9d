// The part of the plan that is on the screen. Screen coordinates are CSS pixels from the upper left corner of the plan.

import type { Changes } from "../changes";
import type { Point } from "../document/messages";
import { middleOf, type Bounds } from "../geometry/bounds";

/** 1 cm is at most this many pixels. */
const mostPixelsOfCentimetre = 60;
const leastScale = 0.5; // pixels per m
const margin = 48; // pixels around everything

export class Viewport {
  width = 1;
  height = 1;
  /** Pixels per m. */
  scale = 40;
  centre: Point = [0, 0];

  constructor(private readonly changes: Changes) {}

  toScreen([x, y]: Point): Point {
    return [
      0.5 * this.width + (x - this.centre[0]) * this.scale,
      0.5 * this.height - (y - this.centre[1]) * this.scale,
    ];
  }

  toWorld([x, y]: Point): Point {
    return [
      this.centre[0] + (x - 0.5 * this.width) / this.scale,
      this.centre[1] - (y - 0.5 * this.height) / this.scale,
    ];
  }

  resize(width: number, height: number): void {
    this.width = Math.max(width, 1);
    this.height = Math.max(height, 1);
    this.changes.note("viewport");
  }

  /** Shows what is `way` farther, m. */
  shift(way: Point): void {
    this.centre = [this.centre[0] + way[0], this.centre[1] + way[1]];
    this.changes.note("viewport");
  }

  /** Moves the picture by pixels. */
  pan(x: number, y: number): void {
    this.centre = [this.centre[0] - x / this.scale, this.centre[1] + y / this.scale];
    this.changes.note("viewport");
  }

  /** The point under `at` stays there. */
  zoom(factor: number, at: Point = [0.5 * this.width, 0.5 * this.height]): void {
    const fixed = this.toWorld(at);
    this.scale = Math.min(Math.max(this.scale * factor, leastScale), mostPixelsOfCentimetre * 100);
    const now = this.toWorld(at);
    this.centre = [this.centre[0] + fixed[0] - now[0], this.centre[1] + fixed[1] - now[1]];
    this.changes.note("viewport");
  }

  /** A turn of the wheel at a place of the screen. `pans`: it moves the plan, as on trackpads. */
  turnWheel(event: WheelEvent, at: Point, pans: boolean): void {
    const unit = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 24 : 1;
    // A pinch on a trackpad arrives as a wheel with Ctrl.
    if (pans && !event.ctrlKey) this.pan(-event.deltaX * unit, -event.deltaY * unit);
    else this.zoom(Math.exp(-event.deltaY * unit * (event.ctrlKey ? 0.01 : 0.0018)), at);
  }

  fit(bounds: Bounds | null, largest = mostPixelsOfCentimetre * 100): void {
    if (!bounds) return;
    const [width, height] = [bounds.upper[0] - bounds.lower[0], bounds.upper[1] - bounds.lower[1]];
    const free = (size: number) => Math.max(size - 2 * margin, 0.5 * size);
    const scale = Math.min(free(this.width) / Math.max(width, 0.01), free(this.height) / Math.max(height, 0.01));
    this.scale = Math.min(Math.max(scale, leastScale), largest);
    this.centre = middleOf(bounds);
    this.changes.note("viewport");
  }
}
