// The surfaces along which units move: where a ray of the 3-D view meets them, and ways along faces.

import type { Part, Point } from "../document/messages";
import { distanceTo as awayFrom } from "../geometry/polygon";
import { distanceTo, type Ray } from "../space/prisms";
import type { Mount } from "./mount";

const farthest = 0.4; // m from a unit to the fixture or wall that carries it

/** The distance along a ray to a plane; infinite if it does not meet it. */
function toPlane({ from, way }: Ray, at: readonly number[], normal: readonly number[]): number {
  const dot = (a: readonly number[], b: readonly number[]) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const slope = dot(way, normal);
  const away =
    dot(
      [0, 1, 2].map((axis) => at[axis] - from[axis]),
      normal,
    ) / slope;
  return Math.abs(slope) > 1e-6 && away > 0 ? away : Infinity;
}

/** The fixture or wall itself, around whose corners the unit goes; otherwise the plane of the face. */
function toFace(ray: Ray, { position, axis }: Mount, parts: readonly Part[]): number {
  const place: Point = [position[0], position[1]];
  const carriers = parts.filter(
    ({ kind, outline }) =>
      (kind === "fixture" || kind === "wall") && outline.length > 2 && awayFrom(outline, place) < farthest,
  );
  const away = Math.min(Infinity, ...carriers.map((part) => distanceTo(part, ray)));
  return away < Infinity ? away : toPlane(ray, position, [axis[0], axis[1], 0]);
}

/** The place on the surface of a unit at which a ray points, m; null if it points past it. */
export function meets(ray: Ray, mount: Mount, parts: readonly Part[]): number[] | null {
  const away = mount.on === "face" ? toFace(ray, mount, parts) : toPlane(ray, mount.position, [0, 0, 1]);
  return away < Infinity ? ray.from.map((value, axis) => value + away * ray.way[axis]) : null;
}

/** The way along a face, to the right and upwards for somebody who looks at it. */
export function alongFace([x, y]: Iterable<number>, [right, up]: Point): number[] {
  const size = Math.hypot(x, y) || 1;
  return [(-y / size) * right, (x / size) * right, up];
}
