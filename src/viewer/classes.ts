// Classes of labels that are drawn alike, with the colours of the static plans.

import { plain } from "./format";
import type { Store } from "./store";

export type Mode = "margin" | "signal" | "serving";
export const modes: { mode: Mode; name: string }[] = [
  { mode: "margin", name: "Margin" },
  { mode: "signal", name: "Signal" },
  { mode: "serving", name: "Serving units" },
];

export interface LabelClass {
  name: string;
  /** CSS variable. */
  colour: string;
  /** Drawn as a triangle whatever the label, as the class holds labels that are not met. */
  unmet?: boolean;
}

/** Which of the classes a label belongs to. */
export interface Classes {
  title: string;
  list: LabelClass[];
  of: (signal: number, margin: number, met: boolean, serving: number) => number;
}

const failed = (store: Store) => (store.redundant ? ", its strongest unit failed" : "");

function marginClasses(store: Store): Classes {
  const { margins } = store;
  return {
    title: `Signal above what a label needs${failed(store)}:`,
    list: margins.map(({ name }, k) => ({ name, colour: `--m${k}`, unmet: k < 2 })),
    of: (_signal, margin, met) => {
      let k = margins.length - 1;
      while (k > 0 && margin < margins[k].from) --k;
      return met ? Math.max(k, 2) : Math.min(k, 1);
    },
  };
}

function signalClasses(store: Store): Classes {
  const { signals: edges, unit } = store;
  const text = (edge: number) => plain(edge / unit.factor);
  const list: LabelClass[] = [{ name: "none", colour: "--floor" }];
  for (let k = 0; k + 1 < edges.length; ++k) {
    const upper = `${text(edges[k + 1])}\u00a0${unit.name}`;
    list.push({ name: k === 0 ? `below ${upper}` : `${text(edges[k])} to ${upper}`, colour: `--g${k}` });
  }
  return {
    title: `Signal${failed(store)}:`,
    list,
    of: (signal) => {
      if (!(signal > 0)) return 0;
      let k = 0;
      while (k + 2 < edges.length && signal >= edges[k + 1]) ++k;
      return k + 1;
    },
  };
}

function servingClasses(): Classes {
  const colours = ["--m2", "--m3", "--m4", "--m5", "--m6"];
  const names = ["none", "1", "2", "3", "4 or more"];
  return {
    title: "Units that reach a label alone:",
    list: colours.map((colour, k) => ({ name: names[k], colour })),
    of: (_signal, _margin, _met, serving) => Math.min(serving, colours.length - 1),
  };
}

export function classesOf(store: Store, mode: Mode): Classes {
  if (mode === "margin") return marginClasses(store);
  return mode === "signal" ? signalClasses(store) : servingClasses();
}

/** What one unit gives to a label, in proportion to what the label needs. */
export const reachClasses: LabelClass[] = [
  { name: "below 1 %", colour: "--m3" },
  { name: "1 to 10 %", colour: "--m4" },
  { name: "10 to 100 %", colour: "--m5" },
  { name: "all, alone", colour: "--m6" },
];

export function reachClass(share: number, alone: boolean): number {
  return alone ? 3 : share >= 0.1 ? 2 : share >= 0.01 ? 1 : 0;
}
