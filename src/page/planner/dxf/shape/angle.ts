// Angles, in radians.

export const radians = (degrees: number): number => (degrees * Math.PI) / 180;

/** Counter-clockwise from one angle to another; equal angles are a whole turn. */
export function sweepOf(from: number, to: number): number {
  const turn = 2 * Math.PI;
  const sweep = (to - from) % turn;
  return sweep <= 1e-12 ? sweep + turn : sweep;
}
