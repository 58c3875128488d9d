// How many labels have which margin.

import type { Field } from "./field";

export interface Histogram {
  /** The lower edge of the first bin and the width of all, dB. The outer bins contain everything beyond. */
  from: number;
  width: number;
  counts: Uint32Array;
  /** dB */
  weakest: number;
  /** dB, to a tenth, within the bins. */
  median: number;
}

const [lowest, highest, width] = [-12, 24, 1]; // dB
const finer = 10; // parts of a bin, from which the median is taken: sorting takes long

/** 10 log10(signal / requirement). */
export const marginOf = ({ total, requirement }: Field, label: number): number =>
  requirement && requirement[label] > 0
    ? 10 * Math.log10(Math.max(total[label], 0) / requirement[label])
    : Number.POSITIVE_INFINITY;

/** Of the labels that have a requirement; null if none has. */
export function histogramOf(field: Field): Histogram | null {
  const parts = new Uint32Array((finer * (highest - lowest)) / width);
  let [found, weakest] = [0, Number.POSITIVE_INFINITY];
  for (let label = 0; label < field.count; ++label) {
    const margin = marginOf(field, label);
    if (margin === Number.POSITIVE_INFINITY) continue;
    ++found;
    if (margin < weakest) weakest = margin;
    const part = Math.floor(((margin - lowest) * finer) / width);
    ++parts[Math.min(Math.max(part, 0), parts.length - 1)];
  }
  if (found === 0) return null;
  const counts = new Uint32Array(parts.length / finer);
  let [below, middle] = [0, 0];
  parts.forEach((count, part) => {
    counts[Math.floor(part / finer)] += count;
    if (below <= found / 2 && count > 0) middle = part;
    below += count;
  });
  return { from: lowest, width, counts, weakest, median: lowest + ((middle + 0.5) * width) / finer };
}
