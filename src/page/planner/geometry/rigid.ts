// Movements of the plan: shifts, turns and mirror images.

import type { Part, Point } from "../document/messages";
import { minus, plus, unitAt, wholeTurn } from "./vector";

/** p -> (p, turned by `turn`, after a change of sign of its y if `mirrors`) + shift. */
export interface Motion {
  /** Degrees, counter-clockwise. */
  turn: number;
  /** Whether the plan is mirrored at the x axis before it turns. */
  mirrors: boolean;
  shift: Point;
}

export const rest: Motion = { turn: 0, mirrors: false, shift: [0, 0] };

export const shiftBy = (shift: Point): Motion => ({ turn: 0, mirrors: false, shift });

function about(turn: number, mirrors: boolean, fixed: Point): Motion {
  const motion = { turn, mirrors, shift: [0, 0] as Point };
  return { ...motion, shift: minus(fixed, moved(fixed, motion)) };
}

export const turnAbout = (degrees: number, fixed: Point): Motion => about(degrees, false, fixed);

/** Left and right change places (`axis` 0), or front and back (1). */
export const mirrorAt = (axis: 0 | 1, fixed: Point): Motion => about(axis === 0 ? 180 : 0, true, fixed);

export function movedVector([x, y]: Point, { turn, mirrors }: Motion): Point {
  const [c, s] = unitAt(turn);
  const v = mirrors ? -y : y;
  return [c * x - s * v, s * x + c * v];
}

export const moved = (point: Point, motion: Motion): Point => plus(movedVector(point, motion), motion.shift);

/** The shift from the corner of a rectangle to its middle. */
export function toMiddle({ rotation, length, depth }: NonNullable<Part["footing"]>): Point {
  const [c, s] = unitAt(rotation);
  return [0.5 * (c * length - s * depth), 0.5 * (s * length + c * depth)];
}

/**
 * A rectangle after a movement. A mirrored fixture keeps its left and right, because fixtures are symmetric along their
 * length, and turns so that its front faces where the mirror shows it.
 */
export function movedFooting(footing: NonNullable<Part["footing"]>, motion: Motion): NonNullable<Part["footing"]> {
  const middle = moved(plus(footing.at, toMiddle(footing)), motion);
  const rotation = motion.mirrors
    ? wholeTurn(motion.turn - footing.rotation + 180)
    : wholeTurn(footing.rotation + motion.turn);
  const turned = { ...footing, rotation };
  return { ...turned, at: minus(middle, toMiddle(turned)) };
}

export function outlineOf({ at, rotation, length, depth }: NonNullable<Part["footing"]>): Point[] {
  const [c, s] = unitAt(rotation);
  return (
    [
      [0, 0],
      [length, 0],
      [length, depth],
      [0, depth],
    ] as Point[]
  ).map(([x, y]) => [at[0] + c * x - s * y, at[1] + s * x + c * y]);
}

export function movedPart(part: Part, motion: Motion): Part {
  return {
    ...part,
    outline: part.outline.map((point) => moved(point, motion)),
    holes: part.holes?.map((hole) => hole.map((point) => moved(point, motion))),
    footing: part.footing && movedFooting(part.footing, motion),
  };
}
