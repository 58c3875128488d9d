// Reads and draws a DXF file beside the page: a drawing of two million lines takes seconds.

import { indexOfLines } from "../../sheet/line_index";
import type { Lines } from "../../sheet/sheet";
import { drawDxf } from "./draw";
import type { DxfDrawing } from "../drawing";
import { DxfError } from "../error";
import { bulkOf } from "../extents";
import type { Answer, DxfFacts, Request } from "./messages";
import { readDxf } from "../reader";
import { proposedUnit } from "../unit";

interface Scope {
  onmessage: ((message: { data: Request }) => void) | null;
  postMessage(answer: Answer, transferred: Transferable[]): void;
}

const scope = globalThis as unknown as Scope;
let drawing: DxfDrawing | null = null;

function factsOf(read: DxfDrawing): DxfFacts {
  const bulk = bulkOf(read.segments);
  const { layers, size, origin, unit, notes } = read;
  return {
    layers,
    size,
    origin,
    bulk: bulk ? [bulk.upper[0] - bulk.lower[0], bulk.upper[1] - bulk.lower[1]] : size,
    proposal: proposedUnit(read),
    unit,
    notes,
  };
}

/** Lines of one layer one after the other, because a change of the colour takes time. */
function sorted(read: DxfDrawing): DxfDrawing {
  const { layers, layerOf, segments } = read;
  const next = new Uint32Array(layers.length + 1);
  for (const layer of layerOf) ++next[layer + 1];
  for (let layer = 0; layer < layers.length; ++layer) next[layer + 1] += next[layer];
  const placed = new Float32Array(segments.length);
  layerOf.forEach((layer, k) => placed.set(segments.subarray(4 * k, 4 * k + 4), 4 * next[layer]++));
  return { ...read, segments: placed, layerOf: layerOf.slice().sort() };
}

/** With y downwards. */
function linesOf({ segments, layerOf, outlines, size }: DxfDrawing): Lines {
  const flipped = (values: Float32Array) => values.map((value, k) => (k % 2 === 0 ? value : size[1] - value));
  const firsts = new Uint32Array(outlines.length + 1);
  outlines.forEach(({ points }, k) => {
    firsts[k + 1] = firsts[k] + points.length;
  });
  const corners = new Float32Array(2 * firsts[outlines.length]);
  outlines.forEach(({ points }, k) => corners.set(points.flat(), 2 * firsts[k]));
  const ends = flipped(segments);
  return {
    ends,
    corners: flipped(corners),
    firsts,
    layers: { ofLine: layerOf.slice(), ofOutline: Uint16Array.from(outlines, ({ layer }) => layer) },
    index: (indexOfLines(ends)?.data as ArrayBuffer | undefined) ?? null,
  };
}

function answerTo(request: Request): [Answer, Transferable[]] {
  if ("read" in request) {
    drawing = sorted(readDxf(new Uint8Array(request.read)));
    return [{ facts: factsOf(drawing) }, []];
  }
  if (!drawing) throw new Error("nothing is read");
  if ("lines" in request) {
    const lines = linesOf(drawing);
    const { ends, corners, firsts, layers, index } = lines;
    const buffers = [ends, corners, firsts, ...(layers ? [layers.ofLine, layers.ofOutline] : [])].map(
      ({ buffer }) => buffer as ArrayBuffer,
    );
    return [{ lines }, index ? [...buffers, index] : buffers];
  }
  const { render, scale, hidden } = request;
  const side = (length: number) => Math.max(Math.round(scale * length), 1);
  const canvas = new OffscreenCanvas(side(render.width), side(render.height));
  const context = canvas.getContext("2d");
  if (!context) throw new RangeError("no canvas");
  drawDxf(context, drawing, render, scale, new Set(hidden));
  const bitmap = canvas.transferToImageBitmap();
  return [{ bitmap }, [bitmap]];
}

scope.onmessage = ({ data }) => {
  try {
    scope.postMessage(...answerTo(data));
  } catch (error) {
    if (error instanceof DxfError) {
      const { code: fault, values, notes } = error;
      scope.postMessage({ fault, values, notes }, []);
    } else scope.postMessage({ fault: error instanceof RangeError ? "memory" : "stopped", values: {} }, []);
  }
};
