// Draws the picture of the floor plan beneath the outlines.

import { element } from "../../panel/dom";
import type { Point } from "../document/messages";
import { boundsOf } from "../geometry/bounds";
import type { Planner } from "../planner";
import { coarsest } from "../sheet/detail";
import { matrixOf, placementOf, shownCorners, toPixel, type Matrix } from "./transform";

export class Backdrop {
  readonly root = element("canvas", { class: "backdrop", "aria-hidden": "true" });

  constructor(
    private readonly planner: Planner,
    private readonly plan: HTMLElement,
  ) {}

  update(): void {
    const { planner, root } = this;
    const { drawing, picture, look, isPlan } = planner;
    const isDrawn = drawing !== null && picture.state.kind === "shown" && look.now.isShown && isPlan;
    root.hidden = !isDrawn;
    this.plan.classList.toggle("traced", isDrawn); // the floor is transparent
    if (!isDrawn) return;
    root.classList.toggle("grey", look.now.isGrey);
    root.classList.toggle("inverted", look.now.isInverted);
    root.style.opacity = String(1 - look.now.fade);
    const { viewport, document } = planner;
    const ratio = devicePixelRatio;
    const [width, height] = [viewport.width, viewport.height].map((size) => Math.round(ratio * size));
    if (root.width !== width || root.height !== height) Object.assign(root, { width, height });
    const context = root.getContext("2d");
    if (!context) return;
    const placement = placementOf(drawing, document.unit);
    const matrix = matrixOf(placement, viewport);
    drawPicture(planner, context, matrix, ratio);
    const corners: Point[] = [
      [0, 0],
      [viewport.width, 0],
      [viewport.width, viewport.height],
      [0, viewport.height],
    ];
    const seen = boundsOf(corners.map((corner) => toPixel(placement, viewport.toWorld(corner))));
    if (!seen) return;
    const [left, upper] = seen.lower;
    const region = { left, upper, width: seen.upper[0] - left, height: seen.upper[1] - upper };
    picture.detail?.show(region, ratio * Math.hypot(matrix[0], matrix[1]));
  }
}

/** Draws the picture on an empty canvas. `matrix`: pixels of the picture to CSS pixels. */
export function drawPicture(
  { drawing, picture }: Planner,
  context: CanvasRenderingContext2D,
  matrix: Matrix,
  ratio: number,
): void {
  if (!drawing) return;
  const enlargement = ratio * Math.hypot(matrix[0], matrix[1]);
  const [width, height] = drawing.size;
  const level = picture.level(enlargement * width);
  context.resetTransform();
  context.clearRect(0, 0, context.canvas.width, context.canvas.height);
  if (!level) return;
  context.scale(ratio, ratio);
  context.transform(...matrix);
  context.imageSmoothingEnabled = enlargement < 3; // from near, single pixels are seen
  context.save();
  context.beginPath();
  for (const [x, y] of shownCorners(drawing)) context.lineTo(x, y);
  context.clip();
  context.drawImage(level, 0, 0, width, height);
  const detail = picture.detail?.now;
  if (detail && detail.scale > 0.6 * enlargement && detail.scale < coarsest * enlargement) {
    const { bitmap, region } = detail;
    context.clearRect(region.left, region.upper, region.width, region.height);
    context.drawImage(bitmap, region.left, region.upper, region.width, region.height);
  }
  context.restore();
}
