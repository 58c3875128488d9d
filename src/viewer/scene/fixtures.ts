// The store: floor, room, and the parts of fixtures as prisms, shaded by the direction of their faces.

import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  LineBasicMaterial,
  LineSegments,
  type Material,
  Mesh,
  MeshBasicMaterial,
  ShapeUtils,
  Vector2,
} from "three";

import { colourOf } from "./palette";
import type { Store } from "../data/store";

/** CSS variables of the colours of part_look, as report/viewer/page_store.cpp numbers them. */
const looks = ["--fx", "--fx-b", "--goods", "--fx-f"];
const goodsLook = 2;
const doorLook = 3;

class Faces {
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
function shadeOf(x: number, y: number, z: number): number {
  const size = Math.hypot(x, y, z) || 1;
  return 0.86 + 0.14 * Math.max(0, z / size) - 0.1 * Math.abs(x / size) - 0.22 * Math.max(0, -z / size);
}

/** Goods of one shelf differ slightly in colour, like products. */
function tint(x: number, y: number, z: number): number {
  const wave = Math.sin(x * 12.9898 + y * 78.233 + z * 37.719) * 43758.5453;
  return 0.9 + 0.1 * (wave - Math.floor(wave));
}

function addPrism(faces: Faces, edges: number[], outline: number[][], low: number, high: number, tone: number): void {
  const count = outline.length;
  for (let k = 0; k < count && count > 1; ++k) {
    const [a, b] = [outline[k], outline[(k + 1) % count]];
    const shade = tone * shadeOf(b[1] - a[1], a[0] - b[0], 0);
    faces.triangle([[a[0], a[1], low], [b[0], b[1], low], [b[0], b[1], high]], shade);
    faces.triangle([[a[0], a[1], low], [b[0], b[1], high], [a[0], a[1], high]], shade);
    edges.push(a[0], a[1], high, b[0], b[1], high, a[0], a[1], low, a[0], a[1], high);
    if (count === 2) break;
  }
  if (count < 3) return;
  const points = outline.map(([x, y]) => new Vector2(x, y));
  for (const corners of ShapeUtils.triangulateShape(points, [])) {
    faces.triangle(corners.map((k) => [outline[k][0], outline[k][1], high]), tone);
    faces.triangle(corners.map((k) => [outline[k][0], outline[k][1], low]), tone * shadeOf(0, 0, -1));
  }
}

function roomEdges(store: Store): number[] {
  const [a, b] = [store.lower, store.upper];
  const ring = [[a[0], a[1]], [b[0], a[1]], [b[0], b[1]], [a[0], b[1]]];
  return ring.flatMap(([x, y], k) => {
    const [u, v] = ring[(k + 1) % 4];
    return [x, y, a[2], u, v, a[2], x, y, b[2], u, v, b[2], x, y, a[2], x, y, b[2]];
  });
}

/** The distance between floor lines in metres. */
export const floorGrid = 5;

function gridEdges(store: Store): number[] {
  const [a, b] = [store.lower, store.upper];
  const z = a[2] + 0.005;
  const edges: number[] = [];
  for (let x = Math.ceil((a[0] + 0.01) / floorGrid) * floorGrid; x < b[0] - 0.01; x += floorGrid)
    edges.push(x, a[1], z, x, b[1], z);
  for (let y = Math.ceil((a[1] + 0.01) / floorGrid) * floorGrid; y < b[1] - 0.01; y += floorGrid)
    edges.push(a[0], y, z, b[0], y, z);
  return edges;
}

function lines(positions: number[]): LineSegments<BufferGeometry, LineBasicMaterial> {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  return new LineSegments(geometry, new LineBasicMaterial());
}

export class Fixtures {
  readonly group = new Group();
  readonly goods = new Group();
  private readonly coloured: { material: MeshBasicMaterial | LineBasicMaterial; variable: string }[] = [];

  constructor(store: Store) {
    const faces = looks.map(() => new Faces());
    const edges: number[] = [];
    const { look, corners, outline, height } = store.part;
    for (let part = 0, at = 0; part < look.length; ++part) {
      const points: number[][] = [];
      for (let k = 0; k < corners[part]; ++k, at += 2) points.push([outline[at], outline[at + 1]]);
      const [low, high] = [height[2 * part], height[2 * part + 1]];
      const isGoods = look[part] === goodsLook;
      const tone = isGoods ? tint(points[0][0], points[0][1], low) : 1;
      addPrism(faces[look[part]], isGoods ? [] : edges, points, low, high, tone);
    }
    this.addMesh(faces[0], store);

    const floor = new Faces();
    const [a, b] = [store.lower, store.upper];
    const z = a[2] - 0.01;
    floor.triangle([[a[0], a[1], z], [b[0], a[1], z], [b[0], b[1], z]], 1);
    floor.triangle([[a[0], a[1], z], [b[0], b[1], z], [a[0], b[1], z]], 1);
    this.add(this.group, floor, "--floor");
    faces.forEach((of, k) => this.add(k === goodsLook ? this.goods : this.group, of, looks[k], k === doorLook));
    this.group.add(this.goods);
    for (const [positions, variable] of [
      [edges, "--fx-line"],
      [gridEdges(store), "--line"],
      [roomEdges(store), "--fx-line"],
    ] as [number[], string][]) {
      const drawn = lines(positions);
      this.coloured.push({ material: drawn.material, variable });
      this.group.add(drawn);
    }
  }

  recolour(element: Element): void {
    for (const { material, variable } of this.coloured) material.color.copy(colourOf(element, variable));
  }

  materials(): Material[] {
    return this.coloured.map(({ material }) => material);
  }

  private addMesh(faces: Faces, store: Store): void {
    const { vertex, triangle } = store.mesh;
    const corner = (k: number) => Array.from(vertex.subarray(3 * triangle[k], 3 * triangle[k] + 3));
    for (let k = 0; k < triangle.length; k += 3) {
      const [a, b, c] = [corner(k), corner(k + 1), corner(k + 2)];
      const u = b.map((value, axis) => value - a[axis]);
      const v = c.map((value, axis) => value - a[axis]);
      faces.triangle(
        [a, b, c],
        shadeOf(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]),
      );
    }
  }

  private add(group: Group, faces: Faces, variable: string, isGlass = false): void {
    if (faces.positions.length === 0) return;
    const material = new MeshBasicMaterial({
      vertexColors: true,
      side: DoubleSide,
      transparent: isGlass,
      opacity: isGlass ? 0.35 : 1,
      depthWrite: !isGlass,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
    const mesh = new Mesh(faces.geometry(), material);
    this.coloured.push({ material, variable });
    group.add(mesh);
  }
}
