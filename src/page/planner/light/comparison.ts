// The labels that the units on the plan gain and lose: compared with a plan, or with the state before a drag.

import { missed, reached } from "./verdicts";

export interface Difference {
  gained: number;
  lost: number;
}

function count(now: Uint8Array, was: (label: number) => number): Difference {
  const difference = { gained: 0, lost: 0 };
  for (let label = 0; label < now.length; ++label) {
    const before = was(label);
    if (before === missed && now[label] === reached) ++difference.gained;
    if (before === reached && now[label] === missed) ++difference.lost;
  }
  return difference;
}

/** Verdicts in numbers. Labels that are or were undecided are neither gained nor lost. */
export const sinceBefore = (before: Uint8Array, now: Uint8Array): Difference => count(now, (label) => before[label]);

/** `plan`: for each label 1, 0, or - if it is unknown. Null if the plan has other labels. */
export function sincePlan(plan: string, now: Uint8Array): Difference | null {
  if (plan.length !== now.length) return null;
  return count(now, (label) => (plan[label] === "1" ? reached : plan[label] === "0" ? missed : -1));
}
