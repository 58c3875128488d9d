// What the values of light say about each label.

import type { Field } from "./field";

/** From the worst to the best. */
export const verdicts = ["missed", "undecided", "unknown", "reached"] as const;
export type Verdict = (typeof verdicts)[number];
export const [missed, undecided, unknown, reached] = [0, 1, 2, 3];

/** The classes of margins of the report begin at these, dB. The first two are those of missed labels. */
export const bands = [Number.NEGATIVE_INFINITY, -3, 0, 1, 3, 6, 10];
const ratios = bands.map((margin) => 10 ** (margin / 10));
const firstReached = 2;

/** A requirement that is within so many errors of the signal is undecided. */
const likely = 1.96;

/** `isLeast`: the signal is at least `total`. */
function verdictOf(total: number, variance: number, requirement: number, isLeast: boolean): number {
  if (requirement <= 0) return reached;
  const slack = total - requirement;
  if (variance > 0 && slack * slack <= likely * likely * variance) return undecided;
  return slack >= 0 ? reached : isLeast ? undecided : missed;
}

/** `edges`: `bands`, or what `value` is compared with instead. */
export function bandOf(value: number, edges: readonly number[] = bands): number {
  let band = edges.length - 1;
  while (band > 0 && value < edges[band]) --band;
  return band;
}

/** Of a label, by its signal in terms of its requirement. */
function bandOfLabel(ratio: number, verdict: number): number {
  const band = bandOf(ratio, ratios);
  return verdict === missed ? Math.min(band, firstReached - 1) : Math.max(band, firstReached);
}

export class Verdicts {
  /** By label, as numbers in `verdicts`. */
  verdict = new Uint8Array();
  /** The class of the margin of reached and missed labels. */
  band = new Uint8Array();
  /** Smaller values for weaker labels: first the worse verdicts, then the smaller margins. */
  strength = new Float32Array();
  readonly counts = new Uint32Array(verdicts.length);
  readonly bandCounts = new Uint32Array(bands.length);

  /** `field`: null without values. */
  update(field: Field | null, count: number, isLeast: boolean): void {
    if (this.verdict.length !== count) {
      this.verdict = new Uint8Array(count);
      this.band = new Uint8Array(count);
      this.strength = new Float32Array(count);
    }
    this.counts.fill(0);
    this.bandCounts.fill(0);
    if (!field?.requirement) {
      this.verdict.fill(unknown);
      this.counts[unknown] = count;
      return;
    }
    const { total, variance, requirement } = field;
    for (let label = 0; label < count; ++label) {
      const ratio = requirement[label] > 0 ? Math.max(total[label], 0) / requirement[label] : Infinity;
      const verdict = verdictOf(total[label], variance[label], requirement[label], isLeast);
      const band = bandOfLabel(ratio, verdict);
      this.verdict[label] = verdict;
      this.band[label] = band;
      this.strength[label] = 1000 * verdict + Math.min(ratio, 999);
      ++this.counts[verdict];
      if (verdict === missed || verdict === reached) ++this.bandCounts[band];
    }
  }

  of(label: number): Verdict {
    return verdicts[this.verdict[label] ?? unknown];
  }
}
