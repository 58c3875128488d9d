// Classes of labels with a common mark, in the colours of the static plans.

import type { Coverage } from "./coverage";
import { percentage, plain } from "../../data/format";
import { verdicts, type Store } from "../data/store";
import { say, text } from "../data/text";

const modes = ["margin", "signal", "serving", "certificate"] as const;
export type Mode = (typeof modes)[number];

/** The modes for which the store has data. */
export function modesOf(store: Store): Mode[] {
  return modes.filter((mode) => mode !== "certificate" || store.certificate);
}

export interface LabelClass {
  name: string;
  /** CSS variable. */
  colour: string;
  /** The shape of all labels in the class; by default, missed labels are triangles and others discs. */
  shape?: "disc" | "triangle" | "square";
}

/** Classes, and the class of each label. */
export interface Classes {
  title: string;
  list: LabelClass[];
  of: (label: number) => number;
}

function marginClasses(store: Store, coverage: Coverage): Classes {
  const { margins } = store;
  return {
    title: store.redundant ? text.legend.margin_redundant : text.legend.margin,
    list: margins.map(({ name }, k) => ({ name, colour: `--m${k}`, shape: k < 2 ? "triangle" : "disc" })),
    of: (label) => {
      const margin = coverage.margin(label);
      let k = margins.length - 1;
      while (k > 0 && margin < margins[k].from) --k;
      return coverage.met[label] ? Math.max(k, 2) : Math.min(k, 1);
    },
  };
}

function signalClasses(store: Store, coverage: Coverage): Classes {
  const { signals: edges, unit } = store;
  const amount = (edge: number) => plain(edge / unit.factor);
  const list: LabelClass[] = [{ name: text.legend.no_signal, colour: "--floor" }];
  for (let k = 0; k + 1 < edges.length; ++k) {
    const upper = `${amount(edges[k + 1])}\u00a0${unit.name}`;
    const name = k === 0 ? say(text.legend.below, upper) : say(text.legend.between, amount(edges[k]), upper);
    list.push({ name, colour: `--g${k}` });
  }
  return {
    title: store.redundant ? text.legend.signal_redundant : text.legend.signal,
    list,
    of: (label) => {
      const signal = coverage.signal[label];
      if (!(signal > 0)) return 0;
      let k = 0;
      while (k + 2 < edges.length && signal >= edges[k + 1]) ++k;
      return k + 1;
    },
  };
}

function servingClasses(coverage: Coverage): Classes {
  const colours = ["--m2", "--m3", "--m4", "--m5", "--m6"];
  const names = [text.legend.no_unit, "1", "2", "3", say(text.legend.or_more, 4)];
  return {
    title: text.legend.serving,
    list: colours.map((colour, k) => ({ name: names[k], colour })),
    of: (label) => Math.min(coverage.serving[label], colours.length - 1),
  };
}

/** Verdicts apply only to the original plan. */
function certificateClasses(store: Store, isAsPlanned: boolean): Classes {
  if (!store.certificate || !isAsPlanned)
    return {
      title: text.legend.not_certified,
      list: [{ name: text.legend.no_verdict, colour: "--floor" }],
      of: () => 0,
    };
  return {
    title: say(text.legend.certified, percentage(store.certificate.confidence)),
    list: [
      { name: text.verdicts.reached, colour: "--m5", shape: "disc" },
      { name: text.verdicts.missed, colour: "--m0", shape: "triangle" },
      { name: text.verdicts.undecided, colour: "--m2", shape: "square" },
      ...(store.label.verdict.includes(verdicts.indexOf("unverified"))
        ? [{ name: text.verdicts.unverified, colour: "--floor", shape: "square" as const }]
        : []),
    ],
    of: (label) => store.label.verdict[label],
  };
}

export function classesOf(store: Store, coverage: Coverage, mode: Mode, isAsPlanned: boolean): Classes {
  if (mode === "margin") return marginClasses(store, coverage);
  if (mode === "certificate") return certificateClasses(store, isAsPlanned);
  return mode === "signal" ? signalClasses(store, coverage) : servingClasses(coverage);
}

/** The same classes and one of the labels that the plan misses in a state of the shop. */
export function withMissed({ title, list, of }: Classes, missed: Set<number>): Classes {
  return {
    title,
    list: [...list, { name: text.legend.missed_in_state, colour: "--m1", shape: "triangle" }],
    of: (label) => (missed.has(label) ? list.length : of(label)),
  };
}

/** The signal of a label from one unit, as a share of its requirement. */
export const reachClasses: LabelClass[] = [
  { name: text.legend.reach_classes.least, colour: "--m3", shape: "disc" },
  { name: text.legend.reach_classes.low, colour: "--m4", shape: "disc" },
  { name: text.legend.reach_classes.high, colour: "--m5", shape: "disc" },
  { name: text.legend.reach_classes.alone, colour: "--m6", shape: "disc" },
];

export function reachClass(share: number, alone: boolean): number {
  return alone ? 3 : share >= 0.1 ? 2 : share >= 0.01 ? 1 : 0;
}
