// Triangles that are collected for one mesh, with the brightness of each.

import { BufferAttribute, BufferGeometry } from "three";

export class Faces {
  readonly positions: number[] = [];
  readonly shades: number[] = [];

  triangle(corners: number[][], shade: number): void {
    for (const corner of corners) {
      this.positions.push(corner[0], corner[1], corner[2]);
      this.shades.push(shade, shade, shade);
    }
  }

  geometry(): BufferGeometry {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(this.positions), 3));
    geometry.setAttribute("color", new BufferAttribute(new Float32Array(this.shades), 3));
    return geometry;
  }
}

/** The brightness of a face with this normal: bright on top, different on the sides. */
export function shadeOf(x: number, y: number, z: number): number {
  const size = Math.hypot(x, y, z) || 1;
  return 0.86 + 0.14 * Math.max(0, z / size) - 0.1 * Math.abs(x / size) - 0.22 * Math.max(0, -z / size);
}

/** The brightness of a triangle. */
export function shadeOfTriangle([a, b, c]: number[][]): number {
  const u = b.map((value, axis) => value - a[axis]);
  const v = c.map((value, axis) => value - a[axis]);
  return shadeOf(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
}
