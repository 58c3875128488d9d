// The axis of a unit and the angle about it, after a movement of the plan (docs/formats/store/transceiver_types.md).

import { movedVector, type Motion } from "../geometry/rigid";
import type { Point } from "../document/messages";
import { wholeTurn } from "../geometry/vector";

type Vector = [number, number, number];

const dot3 = (a: Vector, b: Vector) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross3 = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const scaled = (a: Vector, factor: number): Vector => [a[0] * factor, a[1] * factor, a[2] * factor];
const unit3 = (a: Vector): Vector => scaled(a, 1 / (Math.hypot(...a) || 1));

/** The x direction of a unit at roll 0: the part of +x (or +y, if the axis is x) perpendicular to the axis. */
function firstDirection(axis: Vector): Vector {
  const along: Vector = Math.abs(dot3(axis, [1, 0, 0])) > Math.cos((0.08 * Math.PI) / 180) ? [0, 1, 0] : [1, 0, 0];
  const part = scaled(axis, dot3(along, axis));
  return unit3([along[0] - part[0], along[1] - part[1], along[2] - part[2]]);
}

export function movedAxis(axis: readonly number[], motion: Motion): Vector {
  const [x, y] = movedVector([axis[0], axis[1]] as Point, motion);
  return [x, y, axis[2]];
}

/** The angle in degrees that keeps the directions of a unit after a movement that also moves its axis. */
export function movedRoll(axis: readonly number[], roll: number, motion: Motion): number {
  const before = unit3(axis as Vector);
  const x = firstDirection(before);
  const y = cross3(before, x);
  const angle = (roll * Math.PI) / 180;
  const turned = [0, 1, 2].map((k) => Math.cos(angle) * x[k] + Math.sin(angle) * y[k]);
  const after = unit3(movedAxis(before, motion));
  const seen = movedAxis(turned, motion);
  const first = firstDirection(after);
  const result = (Math.atan2(dot3(seen, cross3(after, first)), dot3(seen, first)) * 180) / Math.PI;
  return wholeTurn(result);
}
