// What the 3-D picture shows of a store besides labels and units (report/viewer/page_store.cpp).

import type { PageData } from "./page_data";

/** Positions and lengths in m. */
export interface Scenery {
  lower: number[];
  upper: number[];
  part: { look: Uint8Array; corners: Uint8Array; outline: Float32Array; height: Float32Array };
  mesh: { vertex: Float32Array; triangle: Uint32Array };
  /** The surfaces of a room that is not a plain box; null for a box. */
  room: Room | null;
  /** The states of a shop that changes: the number of people and objects, and the fixtures with open doors. */
  states: { blocks: number; open: number[] }[];
  /** The people and objects of all states, with four corners each. */
  block: { outline: Float32Array; height: Float32Array };
  /** The fixture of each door; only with states. */
  door: { fixture?: Uint32Array };
}

/** `surface`: per triangle, the index in `surfaces`. */
export interface Room {
  vertex: Float32Array;
  triangle: Uint32Array;
  surface: Uint8Array;
}

/** As report/viewer/page_store.cpp numbers them. The shell (walls, ceilings, steps between them) faces outwards. */
export const surfaces = ["floor", "shell", "innerWall", "glass"] as const;

interface SceneryAbout {
  lower: number[];
  upper: number[];
  states?: Scenery["states"];
}

export function sceneryOf(page: PageData<SceneryAbout>): Scenery {
  const { lower, upper, states = [] } = page.about;
  return {
    lower,
    upper,
    states,
    part: page.group<Scenery["part"]>("part"),
    mesh: page.group<Scenery["mesh"]>("mesh"),
    block: page.group<Scenery["block"]>("block"),
    door: page.group<Scenery["door"]>("door"),
    room: page.has("room_surface") ? page.group<Room>("room") : null,
  };
}
