// Which of the places near the pointer it means.

import type { Point } from "../document/messages";
import { distance } from "../geometry/vector";
import { nearestOf, passes, tolerance, type Line } from "./lines";

export type SnapKind =
  | "end"
  | "close"
  | "crossing"
  | "middle"
  | "line"
  | "perpendicular"
  | "parallel"
  | "extension"
  | "align"
  | "gap"
  | "length"
  | "angle";

/** Why the pointer is where it is: a line that is not in the drawing. */
export interface Guide {
  from: Point;
  to: Point;
  kind: SnapKind;
  /** m; is written on it. */
  distance?: number;
}

export interface Snapped {
  at: Point;
  /** Null: nothing attracts the pointer. */
  kind: SnapKind | null;
  guides: readonly Guide[];
}

/** Something that keeps the pointer on a line. */
export interface Pull {
  line: Line;
  kind: SnapKind;
  /** m from the pointer. */
  reach: number;
  guides: (at: Point) => Guide[];
}

export interface Candidate extends Snapped {
  kind: SnapKind;
  /** Lower ones win. */
  rank: number;
  /** How far the pointer is away: 1 at the end of the reach. */
  strain: number;
  /** The line along which it slides with the pointer; null: it is one place. */
  slide: Line | null;
}

/** Two lines together say more than one of them: `both` of them are before the latter. */
export const ranks = {
  point: { end: 0, close: 0, crossing: 1, middle: 2 },
  both: { drawn: 3, inferred: 5 },
  slide: { line: 4, perpendicular: 6, parallel: 6, extension: 6, align: 7, gap: 8, angle: 9 } as Record<
    SnapKind,
    number
  >,
};

/**
 * m from which lines attract that have nothing at the pointer. Where a pixel is many centimetres, people would not notice
 * that a remote corner moves what they trace.
 */
export const faintReach = (reach: number): number => Math.min(0.4 * reach, 0.1);
/** m: ends that are nearer always join. */
export const joining = 0.01;
/** The part of the reach that a snap is kept beyond it, and that another one must be inside of it to replace it. */
export const hysteresis = 0.4;

/** How far a place is away. Beyond the usual reach, a place with a longer one is kept just as far as others. */
export const strainOf = (away: number, own: number, usual: number): number =>
  own >= usual ? Math.max(away - own + usual, 0) / usual : away / own;

const isSame = ({ kind, at, slide }: Candidate, held: Snapped): boolean =>
  kind === held.kind && (slide ? passes(slide, held.at) : distance(at, held.at) <= tolerance);

/** The candidate of the lowest rank; among equals the nearest. */
function first(candidates: readonly Candidate[], pointer: Point): Candidate | null {
  const away = ({ at }: Candidate) => distance(at, pointer);
  return candidates.reduce<Candidate | null>(
    (best, one) => (!best || one.rank < best.rank || (one.rank === best.rank && away(one) < away(best)) ? one : best),
    null,
  );
}

/**
 * A held snap stays until the pointer is clearly out of its reach, clearly nearer to another one of its rank, or clearly
 * in the reach of one of a higher rank. The latter need not be the nearer one: no end of a line is nearer than the line.
 * A pointer at the held place means it, although the lines that led there may be out of reach from it.
 */
export function choose(
  candidates: readonly Candidate[],
  pointer: Point,
  reach: number,
  held?: Snapped,
): Snapped | null {
  if (held?.kind && distance(pointer, held.at) <= tolerance) return held;
  const ofHeld = held?.kind ? candidates.filter((one) => isSame(one, held) && one.strain <= 1 + hysteresis) : [];
  const kept = first(ofHeld, pointer);
  const joined = candidates.filter(
    ({ kind, at }) => (kind === "end" || kind === "close") && distance(at, pointer) <= joining,
  );
  if (joined.length > 0) return first(joined, pointer);
  const away = kept ? distance(kept.at, pointer) : 0;
  const replaces = ({ rank, strain, at }: Candidate) =>
    kept === null ||
    (rank < kept.rank && strain <= 1 - hysteresis) ||
    (rank === kept.rank && distance(at, pointer) < away - hysteresis * reach);
  return (
    first(
      candidates.filter((one) => one.strain <= 1 && replaces(one)),
      pointer,
    ) ?? kept
  );
}

export function slideOf({ line, kind, reach, guides }: Pull, pointer: Point, usual: number): Candidate {
  const at = nearestOf(line, pointer);
  return {
    at,
    kind,
    guides: guides(at),
    rank: ranks.slide[kind],
    strain: strainOf(distance(at, pointer), reach, usual),
    slide: line,
  };
}
