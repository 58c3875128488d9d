// The store and its signals as the page carries them (report/page_store.cpp, report/page_signals.cpp).

import { readPageData } from "./page_data";

export interface StoreAbout {
  lower: number[];
  upper: number[];
  cooperative: boolean;
  redundant: boolean;
  tolerance: number;
  unit: { factor: number; name: string };
  margins: { from: number; name: string }[];
  signals: number[];
  levels: { heights: string; labels: number }[];
  fixtures: { id: string; at: number[] }[];
  labels: { ids: string[]; kinds: { type: string; requirement: number }[] };
  units: { ids: string[]; types: string[]; installed: number[]; mounts: number[][]; selected: number[] };
}

export interface Store extends StoreAbout {
  label: { position: Float32Array; normal: Float32Array; kind: Uint16Array; level: Uint16Array };
  candidate: { position: Float32Array; axis: Float32Array };
  part: { look: Uint8Array; corners: Uint8Array; outline: Float32Array; height: Float32Array };
  mesh: { vertex: Float32Array; triangle: Uint32Array };
}

/** Entries of the matrix row by row: of label i those from begin[i] to begin[i + 1]. */
export interface Signals {
  begin: Uint32Array;
  column: Uint32Array;
  mean: Float32Array;
  /** Standard errors; empty where they are not known. */
  error: Float64Array;
  /** The part without any reflection, 0 to 1; empty where it is not known. */
  directShare: Float64Array;
  /** To be added to a label's signal while the whole plan is on; empty where no entry is left out. */
  rest: Float64Array;
  leftOut: number;
}

interface SignalsAbout {
  leastError: number;
  errorStep: number;
  leftOut: number;
}

export async function readStore(base64: string): Promise<Store> {
  const page = await readPageData<StoreAbout>(base64);
  return {
    ...page.about,
    label: {
      position: page.get("label_position", Float32Array),
      normal: page.get("label_normal", Float32Array),
      kind: page.get("label_kind", Uint16Array),
      level: page.get("label_level", Uint16Array),
    },
    candidate: {
      position: page.get("unit_position", Float32Array),
      axis: page.get("unit_axis", Float32Array),
    },
    part: {
      look: page.get("part_look", Uint8Array),
      corners: page.get("part_corners", Uint8Array),
      outline: page.get("part_outline", Float32Array),
      height: page.get("part_height", Float32Array),
    },
    mesh: {
      vertex: page.get("mesh_vertex", Float32Array),
      triangle: page.get("mesh_triangle", Uint32Array),
    },
  };
}

export async function readSignals(base64: string): Promise<Signals> {
  const page = await readPageData<SignalsAbout>(base64);
  const { leastError, errorStep, leftOut } = page.about;
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
  return {
    begin,
    column,
    mean: page.get("mean", Float32Array),
    error: Float64Array.from(page.get("error", Uint16Array), (code) =>
      code === 0 ? 0 : leastError * Math.exp((code - 1) * errorStep),
    ),
    directShare: Float64Array.from(page.get("direct", Uint16Array), (code) => code / 65535),
    rest: page.get("rest", Float64Array),
    leftOut,
  };
}
