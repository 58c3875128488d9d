// The room: floor, walls as seen from the inside, inner walls, and lines along the edges of all surfaces.

import { BufferAttribute, BufferGeometry, EdgesGeometry } from "three";

import { Faces, shadeOfTriangle } from "./faces";
import { surfaces, type Room, type Scenery } from "../data/scenery";

/** The distance between floor lines in metres. */
export const floorGrid = 5;
const below = 0.01; // m, of the drawn floor, so that nothing at height 0 flickers
const above = 0.005; // m, of the lines on it

export interface RoomFaces {
  floor: Faces;
  /** The walls, ceilings and steps between them, which face outwards. */
  farWalls: Faces;
  innerWalls: Faces;
  glass: Faces;
  edges: number[];
  grid: number[];
}

/** The triangles of a room by surface. */
function trianglesOf({ vertex, triangle, surface }: Room): Record<(typeof surfaces)[number], number[][][]> {
  const found = { floor: [], shell: [], innerWall: [], glass: [] } as Record<(typeof surfaces)[number], number[][][]>;
  surface.forEach((kind, t) => {
    const corners = [0, 1, 2].map((k) => {
      const at = 3 * triangle[3 * t + k];
      return Array.from(vertex.subarray(at, at + 3));
    });
    found[surfaces[kind]].push(corners);
  });
  return found;
}

/** The edges of surfaces without those between two triangles of one plane. */
function creasesOf(triangles: number[][][]): number[] {
  if (triangles.length === 0) return [];
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(triangles.flat(2)), 3));
  return Array.from(new EdgesGeometry(geometry, 1).getAttribute("position").array);
}

/** The parts of floor lines at multiples of `floorGrid` along an axis that lie on a triangle. */
function gridOn(corners: number[][], axis: number): number[] {
  const values = corners.map((corner) => corner[axis]);
  const lines: number[] = [];
  for (
    let at = Math.ceil((Math.min(...values) + 1e-6) / floorGrid) * floorGrid;
    at < Math.max(...values);
    at += floorGrid
  )
    corners.forEach((a, k) => {
      const b = corners[(k + 1) % 3];
      if (a[axis] > at === b[axis] > at) return;
      const share = (at - a[axis]) / (b[axis] - a[axis]);
      const other = a[1 - axis] + share * (b[1 - axis] - a[1 - axis]);
      lines.push(...(axis === 0 ? [at, other] : [other, at]), a[2] + above);
    });
  return lines;
}

function boxOf({ lower: a, upper: b }: Scenery): { floor: number[][][]; edges: number[] } {
  const ring = [
    [a[0], a[1]],
    [b[0], a[1]],
    [b[0], b[1]],
    [a[0], b[1]],
  ];
  const corners = ring.map(([x, y]) => [x, y, a[2]]);
  const edges = ring.flatMap(([x, y], k) => {
    const [u, v] = ring[(k + 1) % 4];
    return [x, y, a[2], u, v, a[2], x, y, b[2], u, v, b[2], x, y, a[2], x, y, b[2]];
  });
  return {
    floor: [
      [corners[0], corners[1], corners[2]],
      [corners[0], corners[2], corners[3]],
    ],
    edges,
  };
}

export function roomOf(scenery: Scenery): RoomFaces {
  const faces = (triangles: number[][][], lift = 0, isShaded = true) => {
    const result = new Faces();
    for (const corners of triangles)
      result.triangle(
        corners.map(([x, y, z]) => [x, y, z + lift]),
        isShaded ? shadeOfTriangle(corners) : 1,
      );
    return result;
  };
  const box = boxOf(scenery);
  const { floor, shell, innerWall, glass } = scenery.room
    ? trianglesOf(scenery.room)
    : { floor: box.floor, shell: [], innerWall: [], glass: [] };
  return {
    floor: faces(floor, -below, false),
    farWalls: faces(shell),
    innerWalls: faces(innerWall),
    glass: faces(glass),
    edges: scenery.room ? [floor, shell, innerWall, glass].flatMap(creasesOf) : box.edges,
    grid: [0, 1].flatMap((axis) => floor.flatMap((corners) => gridOn(corners, axis))),
  };
}
