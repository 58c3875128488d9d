// The drawing of a file: all copies of its blocks, with one origin.

import { boundsOf, type Bounds } from "../geometry/bounds";
import { type Block, type Shown, visitBlocks } from "./blocks";
import type { DxfDrawing, DxfLimits, DxfOutline, DxfText } from "./drawing";
import { bulkOf } from "./extents";
import type { Layers } from "./layers";
import type { Notes } from "./notes";
import type { Lines } from "./shape/lines";
import { directed, identity, mapped, type Matrix } from "./shape/matrix";

/** Lines so many times as far from most lines as these are apart are strays, which would cost all precision. */
const farthest = 200;
const mostSamples = 20_000;

/** As far as 32 bits reach, with room to spare for differences. */
const everywhere: Bounds = { lower: [-1e30, -1e30], upper: [1e30, 1e30] };

/** Also false for NaN. */
const isWithin = ({ lower, upper }: Bounds, x: number, y: number): boolean =>
  x >= lower[0] && x <= upper[0] && y >= lower[1] && y <= upper[1];

function wider({ lower, upper }: Bounds): Bounds {
  const size = Math.max(upper[0] - lower[0], upper[1] - lower[1]);
  if (size === 0) return everywhere;
  const margin = farthest * size;
  return { lower: [lower[0] - margin, lower[1] - margin], upper: [upper[0] + margin, upper[1] + margin] };
}

/** The ends of a line where a copy of its block stands. */
function endsOf(positions: Float64Array, line: number, at: Matrix, ends: Float64Array): void {
  for (let k = 0; k < 4; k += 2) {
    const [x, y] = [positions[4 * line + k], positions[4 * line + k + 1]];
    ends[k] = at[0] * x + at[2] * y + at[4];
    ends[k + 1] = at[1] * x + at[3] * y + at[5];
  }
}

const layerIn = ({ layer, forced }: Shown, own: number): number => {
  if (forced >= 0) return forced;
  return own === 0 ? layer : own;
};

interface Source {
  model: Block;
  lines: Lines;
  layers: Layers;
}

function visitAll({ model, layers }: Source, visit: (shown: Shown) => void): void {
  visitBlocks({ block: model, at: identity, layer: 0, forced: -1 }, (layer) => layers.all[layer].isFrozen, visit);
}

interface Measured {
  /** Null without lines. */
  bounds: Bounds | null;
  lines: number;
  outside: number;
  samples: Float64Array;
}

/** Of the lines within a box. */
function measure(source: Source, box: Bounds): Measured {
  const { positions } = source.lines;
  let total = 0;
  visitAll(source, ({ block }) => {
    total += block.lines[1] - block.lines[0];
  });
  const stride = Math.max(1, Math.ceil(total / mostSamples));
  const samples = new Float64Array(4 * Math.ceil(total / stride));
  const ends = new Float64Array(4);
  let [lines, outside, sampled] = [0, 0, 0];
  let [left, right, lower, upper] = [Infinity, -Infinity, Infinity, -Infinity];
  visitAll(source, ({ block, at }) => {
    for (let line = block.lines[0]; line < block.lines[1]; ++line) {
      endsOf(positions, line, at, ends);
      const [x0, y0, x1, y1] = ends;
      if (!isWithin(box, x0, y0) || !isWithin(box, x1, y1)) {
        ++outside;
        continue;
      }
      if (lines++ % stride === 0) samples.set(ends, 4 * sampled++);
      left = Math.min(left, x0, x1);
      right = Math.max(right, x0, x1);
      lower = Math.min(lower, y0, y1);
      upper = Math.max(upper, y0, y1);
    }
  });
  const bounds: Bounds | null = lines > 0 ? { lower: [left, lower], upper: [right, upper] } : null;
  return { bounds, lines, outside, samples: samples.subarray(0, 4 * sampled) };
}

function placesOfTexts(source: Source): Bounds | null {
  const places: [number, number][] = [];
  visitAll(source, ({ block, at }) => {
    for (const text of block.texts) places.push(mapped(at, text.at));
  });
  return boundsOf(places.filter(([x, y]) => isWithin(everywhere, x, y)));
}

/** Lines and texts with their layers, and the lines of each outline. */
class Copy {
  readonly segments: Float32Array;
  readonly layerOf: Uint16Array;
  readonly texts: DxfText[] = [];
  /** First line and line after the last of each outline. */
  readonly outlines: [number, number][] = [];
  strays = 0;
  count = 0;
  private readonly ends = new Float64Array(4);

  constructor(
    private readonly lines: Lines,
    private readonly box: Bounds,
    private readonly origin: readonly [number, number],
    size: number,
    private readonly limits: DxfLimits,
    private readonly notes: Notes,
  ) {
    this.segments = new Float32Array(4 * size);
    this.layerOf = new Uint16Array(size);
  }

  add(shown: Shown): void {
    const { block } = shown;
    const { outlines } = this.lines;
    let line = block.lines[0];
    for (let k = block.outlines[0]; k < block.outlines[1]; k += 2) {
      this.addLines(shown, line, outlines[k]);
      const first = this.count;
      this.addLines(shown, outlines[k], outlines[k + 1]);
      // Without an outline that is in part a stray.
      if (this.count - first === outlines[k + 1] - outlines[k]) this.outlines.push([first, this.count]);
      line = outlines[k + 1];
    }
    this.addLines(shown, line, block.lines[1]);
    for (const text of block.texts) this.addText(shown, text);
  }

  private addLines(shown: Shown, from: number, to: number): void {
    const { ends, box, segments, origin } = this;
    for (let line = from; line < to; ++line) {
      endsOf(this.lines.positions, line, shown.at, ends);
      if (!isWithin(box, ends[0], ends[1]) || !isWithin(box, ends[2], ends[3])) {
        ++this.strays;
        continue;
      }
      for (let k = 0; k < 4; ++k) segments[4 * this.count + k] = ends[k] - origin[k & 1];
      this.layerOf[this.count++] = layerIn(shown, this.lines.layers[line]);
    }
  }

  private addText(shown: Shown, { layer, at, anchor, along, up, text }: Block["texts"][number]): void {
    const [x, y] = mapped(shown.at, at);
    const [dx, dy] = directed(shown.at, along);
    const [ux, uy] = directed(shown.at, up);
    const height = Math.abs(dx * uy - dy * ux) / (Math.hypot(dx, dy) || 1);
    if (!isWithin(this.box, x, y) || !Number.isFinite(height)) ++this.strays;
    else if (this.texts.length >= this.limits.texts) this.notes.add("texts_left_out");
    else
      this.texts.push({
        layer: layerIn(shown, layer),
        at: [x - this.origin[0], y - this.origin[1]],
        anchor,
        height,
        turn: (Math.atan2(dy, dx) * 180) / Math.PI,
        text,
      });
  }
}

/** The corners of outlines, as far as there may be as many. */
function outlinesOf({ outlines, segments, layerOf }: Copy, limits: DxfLimits, notes: Notes): DxfOutline[] {
  const found: DxfOutline[] = [];
  let corners = 0;
  for (const [first, end] of outlines) {
    if (found.length === limits.outlines || corners + end - first > limits.corners) {
      notes.add("outlines_left_out");
      continue;
    }
    corners += end - first;
    const points: [number, number][] = [];
    for (let line = first; line < end; ++line) points.push([segments[4 * line], segments[4 * line + 1]]);
    found.push({ layer: layerOf[first], points });
  }
  return found;
}

type Assembled = Pick<DxfDrawing, "layers" | "segments" | "layerOf" | "outlines" | "texts" | "origin" | "size">;

export function assemble(model: Block, lines: Lines, layers: Layers, limits: DxfLimits, notes: Notes): Assembled {
  const source = { model, lines, layers };
  let box = everywhere;
  let measured = measure(source, box);
  const bulk = bulkOf(measured.samples);
  if (bulk) {
    box = wider(bulk);
    const { lower, upper } = measured.bounds ?? bulk;
    if (!isWithin(box, ...lower) || !isWithin(box, ...upper)) measured = measure(source, box);
  }
  const { lower, upper } = measured.bounds ?? placesOfTexts(source) ?? { lower: [0, 0], upper: [0, 0] };
  const copy = new Copy(lines, box, lower, measured.lines, limits, notes);
  visitAll(source, (shown) => copy.add(shown));
  if (copy.strays > 0) notes.add("stray", null, copy.strays);
  const outlines = outlinesOf(copy, limits, notes);
  const { segments, layerOf, texts } = copy;
  return {
    segments,
    layerOf,
    texts,
    outlines,
    layers: layers.used(layerOf, texts, outlines),
    origin: lower,
    size: [upper[0] - lower[0], upper[1] - lower[1]],
  };
}
