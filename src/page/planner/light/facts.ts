// What the page says of the light at one label.

import { decibelText, percent, significant } from "../../data/format";
import type { Item } from "../view/selection";
import type { Planner } from "../planner";
import { say, text } from "../text";
import { marginOf } from "./histogram";

export type Fact = [term: string, words: string];

/** Metric prefixes of W/m². */
const prefixes: [number, string][] = [
  [1e3, "k"],
  [1, ""],
  [1e-3, "m"],
  [1e-6, "µ"],
  [1e-9, "n"],
  [1e-12, "p"],
];

/** Signals in the unit of measure that suits a reference. */
function signalText(value: number, reference: number, digits = 3): string {
  const [factor, prefix] = prefixes.find(([least]) => reference >= least) ?? [1, ""];
  return `${significant(value / factor, digits)}\u00a0${prefix}W/m²`;
}

/** The number of the label that an item is; undefined if it is none. */
export function labelOf({ document }: Pick<Planner, "document">, item: Item | null): number | undefined {
  if (item?.kind === "device") return item.device === "label" ? item.index : undefined;
  return item?.kind === "element" && item.path.startsWith("/labels/") ? document.labels.withPath(item.path) : undefined;
}

/** The selected label, if nothing else is selected. */
export function selectedLabel(planner: Planner): number | undefined {
  const { items } = planner.selection;
  return items.length === 1 ? labelOf(planner, items[0]) : undefined;
}

/** The description, or else the id; a number until the server has answered, which is not disturbed during a drag. */
export function labelName({ answers, light }: Planner, label: number): string {
  const answer = light.dragged ? answers.known("label", label) : answers.now("label", label);
  return answer?.description || answer?.id || say(text.light.label, label + 1);
}

export function marginText(planner: Planner, label: number): string {
  const { field } = planner.light;
  if (!field) return text.light.verdicts.unknown;
  const margin = marginOf(field, label);
  if (margin === Number.POSITIVE_INFINITY) return text.light.no_requirement;
  return margin === Number.NEGATIVE_INFINITY ? text.light.no_signal : decibelText(margin);
}

/** Where the values come from. */
export function sourceText({ light }: Planner): string {
  const { stage } = light;
  if (stage === null) return text.light.verdicts.unknown;
  return light.isStale ? say(text.light.stale, text.light.stages[stage]) : text.light.stages[stage];
}

function doubtText(doubts: number): string {
  const { near_surface, mirrors, unexplored, skewed, narrow } = text.light.doubts;
  const names = [near_surface, mirrors, unexplored, skewed, narrow];
  return names.filter((_, bit) => doubts & (1 << bit)).join(", ");
}

export function lightFacts(planner: Planner, label: number): Fact[] {
  const { light, document } = planner;
  const availability = planner.plans.availability[label] ?? null;
  const level: Fact[] = [
    [text.light.facts.level, String(document.labels.state[label] + 1)],
    ...(availability === null ? [] : [[text.light.facts.availability, percent(availability)] as Fact]),
  ];
  const { field } = light;
  if (!field?.requirement) return [...level, [text.light.facts.verdict, text.light.verdicts.unknown]];
  const requirement = field.requirement[label];
  const signal = Math.max(field.total[label], 0);
  const reference = requirement > 0 ? requirement : signal;
  const error = Math.sqrt(Math.max(field.variance[label], 0));
  const doubts = doubtText(light.doubts(label));
  return [
    ...level,
    [text.light.facts.verdict, text.light.verdicts[light.verdicts.of(label)]],
    [text.light.facts.signal, signalText(signal, reference)],
    [text.light.facts.error, `±\u00a0${signalText(error, reference, 2)}`],
    [text.light.facts.requirement, signalText(requirement, reference)],
    [text.light.facts.margin, marginText(planner, label)],
    [text.light.facts.source, sourceText(planner)],
    ...(doubts === "" ? [] : [[text.light.facts.doubts, doubts] as Fact]),
  ];
}
