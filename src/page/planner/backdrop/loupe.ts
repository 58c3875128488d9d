// A round window beside the cross of a line of known length, which shows the picture around it enlarged.

import { element } from "../../panel/dom";
import type { Gestures } from "../gesture/gestures";
import type { Planner } from "../planner";
import { drawPicture } from "./backdrop";
import { worldAt } from "./strokes";
import { matrixOf, placementOf, type Matrix } from "./transform";

const size = 136; // pixels
const distance = 22; // pixels from the cross
const enlargement = 8;
/** A pixel of the picture is not drawn larger than this by the enlargement. */
const largest = 8;

export class Loupe {
  readonly root = element("canvas", { class: "loupe", "aria-hidden": "true", hidden: true });

  constructor(
    private readonly planner: Planner,
    private readonly gestures: Gestures,
  ) {}

  update(): void {
    const { planner, root } = this;
    const { scope } = this.gestures;
    const { drawing, viewport, look } = planner;
    const isShown = scope.kind === "scaling" && scope.at !== null && scope.to === null;
    root.hidden = !isShown || !drawing || !look.now.isShown;
    const context = root.getContext("2d");
    if (root.hidden || !isShown || !scope.at || !drawing || !context) return;
    const [x, y] = viewport.toScreen(worldAt(planner, scope.at));
    const beside = (at: number, room: number) => (at + distance + size > room ? at - distance - size : at + distance);
    root.style.left = `${beside(x, viewport.width)}px`;
    root.style.top = `${y - distance - size < 0 ? y + distance : y - distance - size}px`;
    const ratio = devicePixelRatio;
    root.width = root.height = Math.round(ratio * size);
    const [a, b, c, d, e, f] = matrixOf(placementOf(drawing, planner.document.unit), viewport);
    const present = Math.hypot(a, b);
    const factor = Math.max(Math.min(enlargement, largest / present), 1);
    const around = (value: number, centre: number) => 0.5 * size + factor * (value - centre);
    const matrix: Matrix = [factor * a, factor * b, factor * c, factor * d, around(e, x), around(f, y)];
    drawPicture(planner, context, matrix, ratio);
    this.drawCross(context);
  }

  private drawCross(context: CanvasRenderingContext2D): void {
    const { width, height } = context.canvas;
    context.resetTransform();
    context.strokeStyle = getComputedStyle(this.root).color;
    context.beginPath();
    context.moveTo(0.5 * width, 0);
    context.lineTo(0.5 * width, height);
    context.moveTo(0, 0.5 * height);
    context.lineTo(width, 0.5 * height);
    context.stroke();
  }
}
