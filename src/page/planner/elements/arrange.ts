// Aligns and distributes elements by their bounds.

import type { Point } from "../document/messages";
import { joined, middleOf, type Bounds } from "../geometry/bounds";

export const alignments = ["left", "centre", "right", "top", "middle", "bottom"] as const;
export type Alignment = (typeof alignments)[number];

/** The shift of each element. */
export function aligned(all: readonly Bounds[], how: Alignment): Point[] {
  const whole = joined(all);
  if (!whole) return [];
  const middle = middleOf(whole);
  return all.map((bounds) => {
    const own = middleOf(bounds);
    switch (how) {
      case "left":
        return [whole.lower[0] - bounds.lower[0], 0];
      case "centre":
        return [middle[0] - own[0], 0];
      case "right":
        return [whole.upper[0] - bounds.upper[0], 0];
      case "top":
        return [0, whole.upper[1] - bounds.upper[1]];
      case "middle":
        return [0, middle[1] - own[1]];
      case "bottom":
        return [0, whole.lower[1] - bounds.lower[1]];
    }
  });
}

/** The shifts that make the gaps between neighbours equal; the first and the last element stay. */
export function distributed(all: readonly Bounds[], axis: 0 | 1): Point[] {
  const order = all.map((_, k) => k).sort((a, b) => middleOf(all[a])[axis] - middleOf(all[b])[axis]);
  const size = ({ lower, upper }: Bounds) => upper[axis] - lower[axis];
  const [first, last] = [all[order[0]], all[order[order.length - 1]]];
  const total = all.reduce((sum, bounds) => sum + size(bounds), 0);
  const gap = (last.upper[axis] - first.lower[axis] - total) / Math.max(all.length - 1, 1);
  const shifts: Point[] = all.map(() => [0, 0]);
  let at = first.lower[axis];
  for (const k of order) {
    shifts[k][axis] = at - all[k].lower[axis];
    at += size(all[k]) + gap;
  }
  return shifts;
}
