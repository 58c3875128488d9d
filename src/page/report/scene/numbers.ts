// The numbers of units as a texture: cell 0 is empty, cell 1 contains a plus, cell k + 1 the number k.

import { CanvasTexture, LinearFilter } from "three";

const cell = 64;
const mostCells = 1024;

export interface NumberTexture {
  texture: CanvasTexture;
  grid: [number, number];
  cellOf: (number: number) => number;
}

export const plusCell = 1;

export function numberTexture(most: number): NumberTexture {
  const cells = Math.min(most + 2, mostCells);
  const columns = Math.ceil(Math.sqrt(cells));
  const rows = Math.ceil(cells / columns);
  const canvas = document.createElement("canvas");
  canvas.width = columns * cell;
  canvas.height = rows * cell;
  const pen = canvas.getContext("2d");
  if (pen) {
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    for (let k = 1; k < cells; ++k) {
      const text = k === plusCell ? "+" : String(k - 1);
      pen.font = `700 ${text.length > 2 ? 28 : 36}px system-ui, "Liberation Sans", Arial, sans-serif`;
      pen.fillText(text, ((k % columns) + 0.5) * cell, (Math.floor(k / columns) + 0.54) * cell);
    }
  }
  const texture = new CanvasTexture(canvas);
  texture.flipY = false;
  texture.minFilter = LinearFilter;
  texture.generateMipmaps = false;
  return { texture, grid: [columns, rows], cellOf: (number) => (number + 1 < cells ? number + 1 : 0) };
}
