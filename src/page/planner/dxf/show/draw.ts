// Draws a DXF drawing on white paper.

import type { Region } from "../../sheet/sheet";
import type { DxfDrawing, DxfText } from "../drawing";

/** Longer paths take more than their share of time. */
const mostInPath = 10_000;
/** Pixels: smaller letters are not drawn. */
const leastLetter = 3;
/** Letters of a font of 1 pixel have capitals of this height. */
const capital = 0.72;
const lineSpacing = 1.6;

/** The places of the screen. `hidden`: layers that are not drawn. */
export function drawDxf(
  context: OffscreenCanvasRenderingContext2D,
  drawing: DxfDrawing,
  { left, upper, width, height }: Region,
  scale: number,
  hidden: ReadonlySet<number>,
): void {
  const top = drawing.size[1] - upper;
  const lower = top - height;
  context.resetTransform();
  context.fillStyle = "white";
  context.fillRect(0, 0, context.canvas.width, context.canvas.height);
  context.lineWidth = 1;
  const { segments, layerOf, layers, texts } = drawing;
  let [layer, inPath] = [-1, 0];
  const stroke = () => {
    if (inPath > 0) context.stroke();
    context.beginPath();
    inPath = 0;
  };
  stroke();
  for (let k = 0; k < layerOf.length; ++k) {
    if (hidden.has(layerOf[k])) continue;
    const [x, y, u, v] = [segments[4 * k], segments[4 * k + 1], segments[4 * k + 2], segments[4 * k + 3]];
    const isBeside = (x < left && u < left) || (x > left + width && u > left + width);
    if (isBeside || (y < lower && v < lower) || (y > top && v > top)) continue;
    if (layerOf[k] !== layer || inPath === mostInPath) {
      stroke();
      layer = layerOf[k];
      context.strokeStyle = layers[layer].colour;
    }
    context.moveTo(scale * (x - left), scale * (top - y));
    context.lineTo(scale * (u - left), scale * (top - v));
    ++inPath;
  }
  stroke();
  for (const text of texts) {
    if (hidden.has(text.layer) || scale * text.height < leastLetter) continue;
    context.fillStyle = layers[text.layer].colour;
    context.setTransform(1, 0, 0, 1, scale * (text.at[0] - left), scale * (top - text.at[1]));
    drawText(context, text, scale);
  }
}

/** At the origin of the context. */
function drawText(
  context: OffscreenCanvasRenderingContext2D,
  { text, height, turn, anchor }: DxfText,
  scale: number,
): void {
  const size = scale * height;
  context.rotate((-turn * Math.PI) / 180);
  context.font = `${size / capital}px sans-serif`;
  const rows = text.split("\n");
  const step = lineSpacing * size;
  const whole = size + (rows.length - 1) * step;
  rows.forEach((row, k) => {
    const x = -anchor[0] * context.measureText(row).width;
    // The baseline of the last row is the lower end of the box.
    context.fillText(row, x, anchor[1] * whole - (rows.length - 1 - k) * step);
  });
}
