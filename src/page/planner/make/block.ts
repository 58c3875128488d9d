// Blocks and areas with traced outlines.

import type { EditBuilder } from "../document/edit";
import type { Json, JsonObject } from "../document/json";
import type { Point } from "../document/messages";
import { signedArea } from "../geometry/polygon";
import { directionOf, distance, dot, minus, wholeTurn } from "../geometry/vector";
import { freeId, inFile, pointInFile, type Site } from "./site";

/** The corners are those of a rectangle, in order. */
export function isRectangle(corners: readonly Point[]): boolean {
  if (corners.length !== 4) return false;
  return corners.every((corner, k) => {
    const [before, after] = [corners[(k + 3) % 4], corners[(k + 1) % 4]];
    const [a, b] = [minus(before, corner), minus(after, corner)];
    return Math.abs(dot(a, b)) < 1e-4 * Math.hypot(...a) * Math.hypot(...b) + 1e-12;
  });
}

const turnedLeft = (corners: readonly Point[]): Point[] =>
  signedArea(corners) < 0 ? [...corners].reverse() : [...corners];

/** A column, a counter or any other block from the floor. `height`: m, or "ceiling". */
export function addBlock(
  builder: EditBuilder,
  site: Site,
  outline: readonly Point[],
  height: number | "ceiling",
  material: string,
): string {
  const corners = turnedLeft(outline);
  const top: Json = height === "ceiling" ? height : inFile(site, height);
  if (!isRectangle(corners) || typeof top === "string")
    return builder.append("/fixtures", {
      type: "prism",
      id: freeId(site, height === "ceiling" ? "C" : "B"),
      polygon: corners.map((corner) => pointInFile(site, corner)),
      top,
      material,
    });
  // The corner with minimum x and y before a rotation of at most 45 degrees to either side.
  const turn = (k: number) => directionOf(minus(corners[(k + 1) % 4], corners[k]));
  const first = [0, 1, 2, 3].sort((a, b) => Math.abs(turn(a)) - Math.abs(turn(b)))[0];
  const rotation = Number(wholeTurn(turn(first)).toFixed(3));
  const [length, depth] = [
    distance(corners[first], corners[(first + 1) % 4]),
    distance(corners[(first + 1) % 4], corners[(first + 2) % 4]),
  ];
  const block: JsonObject = {
    type: "box",
    id: freeId(site, "B"),
    at: [...(pointInFile(site, corners[first]) as number[]), 0],
    size: [inFile(site, length), inFile(site, depth), top],
    ...(rotation === 0 || rotation === 360 ? {} : { rotation_deg: rotation }),
    material,
  };
  return builder.append("/fixtures", block);
}

/** An area without candidates. */
export function addKeepOut(builder: EditBuilder, site: Site, corners: readonly Point[]): string {
  return builder.append("/transceivers/keep_out", { polygon: corners.map((corner) => pointInFile(site, corner)) });
}

/** An area with candidates in a grid on the ceiling. */
export function addArea(
  builder: EditBuilder,
  site: Site,
  corners: readonly Point[],
  type: string,
  spacing: number,
): string {
  return builder.append("/transceivers/areas", {
    type,
    area: corners.map((corner) => pointInFile(site, corner)),
    spacing: inFile(site, spacing),
    below_ceiling: inFile(site, 0.02),
  });
}
