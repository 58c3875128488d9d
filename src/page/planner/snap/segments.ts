// The lines that attract the pointer: edges of outlines.

import type { Part, PartKind, Point } from "../document/messages";
import { edgesOf } from "../geometry/polygon";
import { directionOf, distance, minus, wholeTurn } from "../geometry/vector";
import { isOpenLine } from "../view/hit";

export interface Segment {
  from: Point;
  to: Point;
  /** The key of its part; that of a drawing in progress has none. */
  key?: string;
  /** The part of the plan beside which people need room; undefined: it is none. */
  body?: string;
}

const unseen: ReadonlySet<PartKind> = new Set<PartKind>(["grid", "area"]);
const bodies: ReadonlySet<PartKind> = new Set<PartKind>(["fixture", "wall"]);

/** Each outer wall is a body of its own. */
function bodyOf({ kind, key }: Part, edge: number): string | undefined {
  if (kind === "room") return `${key}/${edge}`;
  return bodies.has(kind) ? key : undefined;
}

/** `without`: keys of parts that move themselves. */
export function segmentsOf(parts: readonly Part[], without: ReadonlySet<string> = new Set()): Segment[] {
  return parts
    .filter(({ kind, key }) => !unseen.has(kind) && !without.has(key))
    .flatMap((part) =>
      [part.outline, ...(part.holes ?? [])].flatMap((outline) =>
        edgesOf(outline, isOpenLine(part))
          .filter(([from, to]) => distance(from, to) > 0)
          .map(([from, to], k) => ({ from, to, key: part.key, body: bodyOf(part, k) })),
      ),
    );
}

/** The direction of most of the room's walls, degrees from 0 to below 90. */
export function mainDirection(parts: readonly Part[]): number {
  const lengths = new Map<number, number>();
  for (const { kind, outline } of parts)
    if (kind === "room")
      for (const [a, b] of edgesOf(outline)) {
        const direction = Number(wholeTurn(directionOf(minus(b, a))).toFixed(6)) % 90;
        lengths.set(direction, (lengths.get(direction) ?? 0) + distance(a, b));
      }
  return [...lengths].reduce((best, one) => (one[1] > best[1] ? one : best), [0, 0])[0];
}
