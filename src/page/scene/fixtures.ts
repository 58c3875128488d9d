// The store: the room, and the parts of fixtures as prisms, shaded by the direction of their faces.

import {
  BackSide,
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
  type Side,
  Vector2,
} from "three";

import { Faces, shadeOf, shadeOfTriangle } from "./faces";
import { colourOf } from "./palette";
import { roomOf } from "./room";
import type { Scenery } from "../data/scenery";

/** CSS variables of the colours of part_look, as report/viewer/page_store.cpp numbers them. */
const looks = ["--fx", "--fx-b", "--goods", "--fx-f"];
const goodsLook = 2;
const doorLook = 3;

interface Finish {
  opacity: number;
  side: Side;
}
const solid: Finish = { opacity: 1, side: DoubleSide };
const glass: Finish = { opacity: 0.35, side: DoubleSide };
/** Visible from the inside of the room only, so that walls near the viewer hide nothing. */
const farWall: Finish = { opacity: 0.55, side: BackSide };

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
    faces.triangle(
      [
        [a[0], a[1], low],
        [b[0], b[1], low],
        [b[0], b[1], high],
      ],
      shade,
    );
    faces.triangle(
      [
        [a[0], a[1], low],
        [b[0], b[1], high],
        [a[0], a[1], high],
      ],
      shade,
    );
    edges.push(a[0], a[1], high, b[0], b[1], high, a[0], a[1], low, a[0], a[1], high);
    if (count === 2) break;
  }
  if (count < 3) return;
  const points = outline.map(([x, y]) => new Vector2(x, y));
  for (const corners of ShapeUtils.triangulateShape(points, [])) {
    faces.triangle(
      corners.map((k) => [outline[k][0], outline[k][1], high]),
      tone,
    );
    faces.triangle(
      corners.map((k) => [outline[k][0], outline[k][1], low]),
      tone * shadeOf(0, 0, -1),
    );
  }
}

function lines(positions: number[]): LineSegments<BufferGeometry, LineBasicMaterial> {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  return new LineSegments(geometry, new LineBasicMaterial());
}

export class Fixtures {
  readonly group = new Group();
  readonly goods = new Group();
  /** Doors, people and objects: of the shop as in the store file, then of its states. */
  private readonly shops: Group[] = [];
  private readonly coloured: { material: MeshBasicMaterial | LineBasicMaterial; variable: string }[] = [];

  constructor(scenery: Scenery) {
    const faces = looks.map(() => new Faces());
    const edges: number[] = [];
    const doors = [{ open: [] }, ...scenery.states].map(({ open }) => ({
      faces: new Faces(),
      open: new Set<number>(open),
    }));
    let door = 0;
    const { look, corners, outline, height } = scenery.part;
    for (let part = 0, at = 0; part < look.length; ++part) {
      const points: number[][] = [];
      for (let k = 0; k < corners[part]; ++k, at += 2) points.push([outline[at], outline[at + 1]]);
      const [low, high] = [height[2 * part], height[2 * part + 1]];
      const isGoods = look[part] === goodsLook;
      const tone = isGoods ? tint(points[0][0], points[0][1], low) : 1;
      let into = [faces[look[part]]];
      if (look[part] === doorLook) {
        const fixture = scenery.door.fixture?.[door++] ?? -1;
        into = doors.filter(({ open }) => !open.has(fixture)).map((shop) => shop.faces);
      }
      into.forEach((of, k) => addPrism(of, isGoods || k > 0 ? [] : edges, points, low, high, tone));
    }
    this.addMesh(faces[0], scenery.mesh);

    const room = roomOf(scenery);
    this.add(this.group, room.floor, "--floor");
    this.add(this.group, room.innerWalls, "--fx-b");
    faces.forEach((of, k) => this.add(k === goodsLook ? this.goods : this.group, of, looks[k]));
    for (const { faces: of } of doors) {
      const shop = new Group();
      this.add(shop, of, looks[doorLook], glass);
      this.shops.push(shop);
    }
    this.addBlocks(scenery);
    this.group.add(this.goods, ...this.shops);
    this.add(this.group, room.farWalls, "--fx", farWall);
    this.add(this.group, room.glass, "--fx-f", glass);
    for (const [positions, variable] of [
      [edges, "--fx-line"],
      [room.grid, "--line"],
      [room.edges, "--fx-line"],
    ] as [number[], string][])
      this.addLines(this.group, positions, variable);
  }

  /** The shop as in the store file (null) or in a state. */
  showShop(state: number | null): void {
    this.shops.forEach((shop, k) => (shop.visible = k === (state ?? -1) + 1));
  }

  recolour(element: Element): void {
    for (const { material, variable } of this.coloured) material.color.copy(colourOf(element, variable));
  }

  materials(): Material[] {
    return this.coloured.map(({ material }) => material);
  }

  dispose(): void {
    this.group.traverse((object) => {
      if (object instanceof Mesh || object instanceof LineSegments) object.geometry.dispose();
    });
    for (const material of this.materials()) material.dispose();
  }

  private addMesh(faces: Faces, { vertex, triangle }: Scenery["mesh"]): void {
    const corner = (k: number) => Array.from(vertex.subarray(3 * triangle[k], 3 * triangle[k] + 3));
    for (let k = 0; k < triangle.length; k += 3) {
      const corners = [corner(k), corner(k + 1), corner(k + 2)];
      faces.triangle(corners, shadeOfTriangle(corners));
    }
  }

  private addBlocks({ block: { outline, height }, states }: Scenery): void {
    let block = 0;
    states.forEach(({ blocks }, state) => {
      const faces = new Faces();
      const edges: number[] = [];
      for (const end = block + blocks; block < end; ++block) {
        const points = [0, 2, 4, 6].map((at) => Array.from(outline.subarray(8 * block + at, 8 * block + at + 2)));
        addPrism(faces, edges, points, height[2 * block], height[2 * block + 1], 1);
      }
      this.add(this.shops[state + 1], faces, "--people");
      this.addLines(this.shops[state + 1], edges, "--people-line");
    });
  }

  private addLines(group: Group, positions: number[], variable: string): void {
    const drawn = lines(positions);
    this.coloured.push({ material: drawn.material, variable });
    group.add(drawn);
  }

  private add(group: Group, faces: Faces, variable: string, { opacity, side }: Finish = solid): void {
    if (faces.positions.length === 0) return;
    const material = new MeshBasicMaterial({
      vertexColors: true,
      side,
      transparent: opacity < 1,
      opacity,
      depthWrite: opacity === 1,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
    const mesh = new Mesh(faces.geometry(), material);
    this.coloured.push({ material, variable });
    group.add(mesh);
  }
}
