// The store and its signals as the page carries them (report/viewer/page_store.cpp, page_signals.cpp).

import { readPageData } from "../../data/page_data";
import { sceneryOf, type Scenery } from "../../data/scenery";

/** The verdicts of a certificate, numbered as in plan/answer/certificate.hpp. */
export const verdicts = ["reached", "missed", "undecided", "unverified"] as const;

/** A state of a shop that changes, in which the original plan was examined. */
export interface ShopState {
  number: number;
  /** The number of its people and objects. */
  blocks: number;
  /** Fixtures with open doors. */
  open: number[];
  /** Labels that the plan does not reach in it. */
  missed: number[];
}

export interface StoreAbout {
  lower: number[];
  upper: number[];
  cooperative: boolean;
  redundant: boolean;
  tolerance: number;
  unit: { factor: number; name: string };
  margins: { from: number; name: string }[];
  signals: number[];
  /** `from` and `to`: heights in m, as text. */
  levels: { from: string; to: string; labels: number }[];
  /** Fixtures and ceiling zones with the places of their names. */
  fixtures: { id: string; at: number[] }[];
  /** `names`: articles with their places; missing if they are the ids. */
  labels: { ids: string[]; names?: string[]; kinds: { type: string; requirement: number }[] };
  /** The certificate of the original plan; null without one. */
  certificate: { confidence: number } | null;
  /** Missing if the shop does not change. */
  states?: ShopState[];
  units: {
    ids: string[];
    types: string[];
    /** In the shop ("above G3"); may be empty. */
    places: string[];
    /** Order numbers by type; a type without one is missing. */
    orders: Record<string, string>;
    installed: number[];
    mounts: number[][];
    selected: number[];
    /** For each of `selected`, the number of labels that are met only because of it. */
    neededBy: number[];
  };
}

export interface Store extends Omit<StoreAbout, "states" | "labels">, Scenery {
  states: ShopState[];
  labels: Required<StoreAbout["labels"]>;
  label: {
    position: Float32Array;
    normal: Float32Array;
    kind: Uint16Array;
    level: Uint16Array;
    /** Index in `verdicts`; empty without a certificate. */
    verdict: Uint8Array;
  };
  candidate: { position: Float32Array; axis: Float32Array };
}

/** Entries of the matrix row by row; label i has the entries from begin[i] to begin[i + 1]. */
export interface Signals {
  begin: Uint32Array;
  column: Uint32Array;
  mean: Float32Array;
  /** Standard errors; empty without errors, NaN for entries without an error in the page. */
  error: Float32Array;
  /** The share without reflection, 0 to 1; empty or NaN as above. */
  directShare: Float32Array;
  /** The signal of the plan minus the sum of its rounded entries, per label; empty without rounding. */
  rest: Float64Array;
}

interface SignalsAbout {
  /** Rounding of the entries as a share of the requirement; 0: no rounding. */
  grain: number;
  /** Entries with fewer grains have neither standard error nor direct share. */
  detailsFrom: number;
  leastError: number;
  errorStep: number;
  directStep: number;
}

export async function readStore(base64: string): Promise<Store> {
  const page = await readPageData<StoreAbout>(base64);
  return {
    ...page.about,
    ...sceneryOf(page),
    states: page.about.states ?? [],
    labels: { names: page.about.labels.ids, ...page.about.labels },
    label: page.group<Store["label"]>("label"),
    candidate: page.group<Store["candidate"]>("unit"),
  };
}

/** The unit of measure for the entries of each label, as in report/viewer/page_signals.cpp. */
function needsOf({ label, labels }: Store): Float64Array {
  const any = labels.kinds.reduce((most, { requirement }) => Math.max(most, requirement), 0) || 1;
  return Float64Array.from(label.kind, (kind) => labels.kinds[kind].requirement || any);
}

/** Rounded entries lie in the middle between two grains. */
function meansOf(grains: Uint32Array, grain: number, begin: Uint32Array, store: Store): Float32Array {
  const mean = new Float32Array(grains.length);
  needsOf(store).forEach((need, label) => {
    for (let at = begin[label]; at < begin[label + 1]; ++at) mean[at] = (grains[at] + 0.5) * grain * need;
  });
  return mean;
}

export async function readSignals(base64: string, store: Store): Promise<Signals> {
  const page = await readPageData<SignalsAbout>(base64);
  const { grain, detailsFrom, leastError, errorStep, directStep } = page.about;
  const rowSize = page.get("row_size", Uint32Array);
  const gap = page.get("gap", Uint32Array);
  const begin = new Uint32Array(rowSize.length + 1);
  const column = new Uint32Array(gap.length);
  for (let i = 0, at = 0; i < rowSize.length; ++i) {
    for (let next = 0; at < begin[i] + rowSize[i]; ++at) {
      column[at] = next + gap[at];
      next = column[at] + 1;
    }
    begin[i + 1] = at;
  }
  const grains = grain > 0 ? page.get("grains", Uint32Array) : null;
  const mean = grains ? meansOf(grains, grain, begin, store) : page.get("mean", Float32Array);
  const details = (codes: Uint16Array, toValue: (code: number, at: number) => number) => {
    const values = new Float32Array(codes.length === 0 ? 0 : mean.length);
    for (let at = 0, next = 0; at < values.length; ++at)
      values[at] = grains && grains[at] < detailsFrom ? NaN : toValue(codes[next++], at);
    return values;
  };
  return {
    begin,
    column,
    mean,
    // For rounded entries, errors are relative to the entry.
    error: details(page.get("error", Uint16Array), (code, at) =>
      code === 0 ? 0 : leastError * Math.exp((code - 1) * errorStep) * (grains ? mean[at] : 1),
    ),
    directShare: details(page.get("direct", Uint16Array), (code) => code * directStep),
    rest: page.get("rest", Float64Array),
  };
}
