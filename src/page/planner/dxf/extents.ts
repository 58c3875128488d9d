// Where most of the lines are.

import type { Bounds } from "../geometry/bounds";

/** Of the weight of all ends of lines, so much is left out on each side. */
const tail = 0.025;
const mostSamples = 20_000;

/** Where the sum of the weights reaches a share of the whole. */
function quantile(values: Float64Array, weights: Float64Array, order: Uint32Array, share: number): number {
  let rest = share * weights.reduce((sum, weight) => sum + weight, 0);
  for (const k of order) {
    rest -= weights[k];
    if (rest >= 0) continue;
    return values[k];
  }
  return values[order[order.length - 1]];
}

/**
 * The rectangle that holds the central 95 % of the ends of lines. Long lines count for more, but not those that are far
 * longer than most. `positions`: x0, y0, x1, y1 of each line. Null without lines.
 */
export function bulkOf(positions: Float32Array | Float64Array): Bounds | null {
  const count = positions.length / 4;
  if (count === 0) return null;
  const stride = Math.ceil(count / mostSamples);
  const samples = Math.floor((count - 1) / stride) + 1;
  const [x, y] = [new Float64Array(2 * samples), new Float64Array(2 * samples)];
  const lengths = new Float64Array(samples);
  for (let k = 0; k < samples; ++k) {
    const [x0, y0, x1, y1] = positions.subarray(4 * k * stride, 4 * k * stride + 4);
    lengths[k] = Math.hypot(x1 - x0, y1 - y0);
    x.set([x0, x1], 2 * k);
    y.set([y0, y1], 2 * k);
  }
  const mostWeight = 20 * lengths.slice().sort()[samples >> 1];
  const weights = Float64Array.from(x, (_, k) => Math.min(lengths[k >> 1], mostWeight));
  const [lower, upper] = [
    [0, 0],
    [0, 0],
  ] as [[number, number], [number, number]];
  for (const [axis, values] of [x, y].entries()) {
    const order = Uint32Array.from(values.keys()).sort((a, b) => values[a] - values[b]);
    lower[axis] = quantile(values, weights, order, tail);
    upper[axis] = quantile(values, weights, order, 1 - tail);
  }
  return { lower, upper };
}
