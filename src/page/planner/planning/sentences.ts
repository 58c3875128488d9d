// What the page says of a plan that runs, and of one that has ended.

import { counted, grouped, percent, plain, significant } from "../../data/format";
import type { PlanAlternative, PlanDetails, PlanRequest, PlanResult, PlanRun } from "../document/messages";
import { say, text } from "../text";

/** "2 min 10 s". */
export function duration(seconds: number): string {
  const whole = Math.max(1, Math.round(seconds));
  if (whole < 60) return say(text.plans.seconds, String(whole));
  if (whole < 3600) return say(text.plans.minutes, String(Math.floor(whole / 60)), String(whole % 60));
  return say(text.plans.hours, String(Math.floor(whole / 3600)), String(Math.floor((whole % 3600) / 60)));
}

/** The question of a plan in a few words. */
export function questionText(plan: PlanRequest | null): string {
  if (plan === null) return text.plans.question.elsewhere;
  const { problem = {}, at_most, reach, states, constraints = {} } = plan;
  const parts = [
    at_most !== undefined
      ? counted(text.plans.question.said_few, at_most)
      : reach !== undefined
        ? say(text.plans.question.said_part, percent(reach, 0))
        : text.plans.question.said_all,
    ...(problem.survives_failure ? [text.plans.question.said_failure] : []),
    ...(problem.model ? [text.plans.question.said_alone] : []),
    ...(states === 0 ? [text.plans.question.said_drawn] : []),
    ...(constraints.min_spacing ? [say(text.plans.question.said_spacing, plain(constraints.min_spacing))] : []),
  ];
  return parts.join(", ");
}

/** "Between 9 and 11 units." Empty: nothing is known yet. */
export function boundsText({ plan, progress, state }: PlanRun): string {
  if (state === "previewing" || !progress || progress.incumbent === null || progress.count === 0) return "";
  const { incumbent, bound, count } = progress;
  const rounding = 1e-6;
  if (plan?.at_most !== undefined) {
    const most = Math.floor((bound ?? incumbent) + rounding);
    return most > incumbent
      ? say(text.plans.between_labels, grouped(incumbent), grouped(most))
      : counted(text.plans.exactly_labels, incumbent);
  }
  if (Math.abs(incumbent - count) > rounding)
    return say(text.plans.between_prices, plain(bound ?? 0), plain(incumbent));
  const least = Math.ceil((bound ?? 0) - rounding);
  return least < count
    ? say(text.plans.between_units, grouped(least), grouped(count))
    : counted(text.plans.exactly_units, count);
}

export function phaseText({ state, progress, continued }: PlanRun): string {
  if (state === "waiting") return text.plans.states.waiting;
  if (state === "previewing") return text.plans.states.previewing;
  const tasks: Record<string, string> = text.plans.tasks;
  const name = tasks[(progress?.task ?? "").replaceAll(" ", "_")] ?? text.plans.tasks.planning;
  const selection = Number(/^plan (\d+)$/.exec(progress?.detail ?? "")?.[1] ?? 1);
  const task = selection > 1 ? `${name} ${say(text.plans.another_selection, String(selection))}` : name;
  return continued ? `${text.plans.states.continued} ${task}` : task;
}

const priceText = (price: PlanAlternative["price"]): string =>
  price ? say(text.plans.price, plain(price.new), price.currency ?? "").trim() : "";

/** An answer to "what if". */
interface WhatIf {
  question: string;
  answer: string;
  /** The selection that it is about. */
  key: "one_fewer" | "one_more" | "survives_failure" | null;
}

export function alternativesOf({ details }: PlanDetails): WhatIf[] {
  const { alternatives = {}, labels, count, values = [] } = details;
  const { one_fewer, one_more, survives_failure, cannot_survive } = alternatives;
  const rows: WhatIf[] = [];
  const withPrice = (sentence: string, of: PlanAlternative) =>
    of.price ? `${sentence} ${say(text.plans.costs, priceText(of.price))}` : sentence;
  if (one_fewer) {
    const lost = labels - one_fewer.reached;
    const least = labels - one_fewer.reached_upper_bound;
    const sentence =
      lost === 0
        ? text.plans.fewer_none
        : one_fewer.proven || least === lost
          ? counted(text.plans.fewer_lost, lost)
          : say(text.plans.fewer_between, grouped(least), grouped(lost));
    rows.push({ question: text.plans.one_fewer, answer: withPrice(sentence, one_fewer), key: "one_fewer" });
  }
  if (one_more) {
    const margin = one_more.smallest_margin === null ? "–" : significant(one_more.smallest_margin);
    const secure = [grouped(one_more.secure), grouped(labels)];
    // A multiple of an assumed threshold says nothing about the reserve.
    const isAssumed = values.some(({ value, state }) => value === "threshold" && state === "assumed");
    const sentence = isAssumed ? say(text.plans.more_safe, ...secure) : say(text.plans.more_gain, margin, ...secure);
    rows.push({ question: text.plans.one_more, answer: withPrice(sentence, one_more), key: "one_more" });
  }
  if (survives_failure) {
    const added = survives_failure.count - count;
    const sentence =
      added > 0 ? counted(text.plans.failure_units, survives_failure.count, String(added)) : text.plans.failure_now;
    rows.push({
      question: text.plans.any_failure,
      answer: withPrice(sentence, survives_failure),
      key: "survives_failure",
    });
  } else if (cannot_survive)
    rows.push({ question: text.plans.any_failure, answer: text.plans.failure_never, key: null });
  return rows;
}

/** "10 units, at least 9 needed, 253 EUR". */
export function summaryOf({ units, lower_bound, price, currency }: PlanResult): string {
  if (units === null) return text.plans.no_units;
  const count = counted(text.plans.units, units);
  const isOpen = lower_bound !== null && lower_bound > 0 && lower_bound < units;
  return [
    isOpen ? say(text.plans.at_least, count, grouped(lower_bound)) : count,
    ...(price === null ? [] : [priceText({ new: price, currency })]),
  ].join(", ");
}

/** One line for the list. */
export const lineOf = ({ state, result }: PlanRun): string =>
  result?.event === "result" ? summaryOf(result) : text.plans.states[state];
