// The direction of a unit's axis: its angle from straight down, and where it leans by the compass. North is +y.

import { movedAxis, movedRoll } from "../elements/axis";
import { turnAbout } from "../geometry/rigid";
import { wholeTurn } from "../geometry/vector";

export type Vector = readonly number[];

/** Less than this, in degrees, is straight up or down. */
const upright = 0.01;

const degrees = (radians: number) => (radians * 180) / Math.PI;
const digits = (value: number, count: number) => Number(value.toFixed(count)) + 0;

/** Degrees from straight down, 0 to 180. */
export const tiltOf = ([x, y, z]: Vector): number => digits(degrees(Math.atan2(Math.hypot(x, y), -z)), 3);

/** Clockwise from north, 0 to below 360; null if it leans nowhere. */
export function headingOf(axis: Vector): number | null {
  const tilt = tiltOf(axis);
  if (tilt < upright || tilt > 180 - upright) return null;
  return wholeTurn(digits(degrees(Math.atan2(axis[0], axis[1])), 3));
}

/** `heading` is of no account for a tilt of 0. */
export function axisOf(tilt: number, heading: number): number[] {
  const [t, h] = [tilt, heading].map((angle) => (angle * Math.PI) / 180);
  const across = Math.sin(t);
  return [across * Math.sin(h), across * Math.cos(h), -Math.cos(t)].map((value) => digits(value, 6));
}

export interface Aim {
  axis: number[];
  roll_deg: number;
}

/** After a turn about the vertical, counter-clockwise in the plan. */
export function turned({ axis, roll_deg }: Aim, angle: number): Aim {
  const motion = turnAbout(angle, [0, 0]);
  return {
    axis: movedAxis(axis, motion).map((value) => digits(value, 6)),
    roll_deg: wholeTurn(digits(movedRoll(axis, roll_deg, motion), 3)),
  };
}

/** Leaning by another angle to the same side, at first to the north. */
export const tilted = ({ axis, roll_deg }: Aim, tilt: number): Aim => ({
  axis: axisOf(tilt, headingOf(axis) ?? 0),
  roll_deg,
});

/** Leaning to another side: turned as a whole. */
export function headed(aim: Aim, heading: number): Aim {
  const before = headingOf(aim.axis);
  return before === null ? aim : turned(aim, before - heading);
}

/** In front of a face, downwards by an angle from the horizontal. */
export function lowered(axis: Vector, tilt: number): number[] {
  const heading = headingOf(axis);
  return heading === null ? [...axis] : axisOf(90 - tilt, heading);
}
