// The tool that measures: both ends of a line are places that attract the pointer.

import type { Point } from "../document/messages";
import type { Planner } from "../planner";
import type { Keys } from "./drags";
import type { Scope } from "./scope";

export type Measuring = Extract<Scope, { kind: "measuring" }>;

export const unmeasured: Measuring = { kind: "measuring", from: null, to: { at: [0, 0], kind: null, guides: [] } };

export function aimMeasure(planner: Planner, scope: Measuring, pointer: Point, { shift, alt }: Keys): Measuring {
  const { from, to } = scope;
  const drawn = from ? [from] : [];
  return { ...scope, to: planner.snapping.at(pointer, { drawn, isOrtho: shift, isFree: alt, held: to }) };
}

/** Sets an end of the line where it is aimed. `done` receives finished lines. */
export function setMeasure({ from, to }: Measuring, done: (line: [Point, Point]) => void): Measuring {
  if (from) done([from, to.at]);
  return { kind: "measuring", from: from ? null : to.at, to };
}
