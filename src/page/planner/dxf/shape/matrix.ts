// Affine maps of the plan.

/** (x, y) becomes (a x + c y + e, b x + d y + f). */
export type Matrix = readonly [a: number, b: number, c: number, d: number, e: number, f: number];

export const identity: Matrix = [1, 0, 0, 1, 0, 0];

/** First `inner`, then `outer`. */
export const combined = (outer: Matrix, inner: Matrix): Matrix => [
  outer[0] * inner[0] + outer[2] * inner[1],
  outer[1] * inner[0] + outer[3] * inner[1],
  outer[0] * inner[2] + outer[2] * inner[3],
  outer[1] * inner[2] + outer[3] * inner[3],
  outer[0] * inner[4] + outer[2] * inner[5] + outer[4],
  outer[1] * inner[4] + outer[3] * inner[5] + outer[5],
];

export const mapped = (at: Matrix, [x, y]: readonly [number, number]): [number, number] => [
  at[0] * x + at[2] * y + at[4],
  at[1] * x + at[3] * y + at[5],
];

/** Without the translation. */
export const directed = (at: Matrix, [x, y]: readonly [number, number]): [number, number] => [
  at[0] * x + at[2] * y,
  at[1] * x + at[3] * y,
];

/** Turned by an angle, and moved. */
export function placed([x, y]: readonly [number, number], degrees: number): Matrix {
  const angle = (degrees * Math.PI) / 180;
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return [c, s, -s, c, x, y];
}

/** The plane of an entity with the given normal, seen from above: AutoCAD's arbitrary axis algorithm. */
export function ocsMatrix(x: number, y: number, z: number, elevation: number): Matrix {
  const length = Math.hypot(x, y, z);
  if (length === 0) return identity;
  const [nx, ny, nz] = [x / length, y / length, z / length];
  const isSteep = Math.abs(nx) < 1 / 64 && Math.abs(ny) < 1 / 64;
  const [ax, ay, az] = isSteep ? [nz, 0, -nx] : [-ny, nx, 0];
  const size = Math.hypot(ax, ay, az);
  const [ux, uy, uz] = [ax / size, ay / size, az / size];
  return [ux, uy, ny * uz - nz * uy, nz * ux - nx * uz, nx * elevation, ny * elevation];
}
