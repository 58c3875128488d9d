// What closed outlines of a drawing become in the shop.

import type { Point } from "../document/messages";
import { distanceTo } from "../geometry/polygon";
import { between, distance, dot, minus } from "../geometry/vector";
import { isRectangle } from "./block";

/** m: corners nearer to the line between their neighbours are those of a curve, or of a careless hand. */
const tolerance = 0.002;

/** Without corners that change the outline by less than the tolerance (Ramer, Douglas and Peucker). */
export function simplified(outline: readonly Point[]): Point[] {
  const corners = outline.filter((corner, k) => distance(corner, outline[(k + 1) % outline.length]) > tolerance / 10);
  if (corners.length < 4) return corners;
  // Two corners that stay: one that is farthest from the first, and the one that is farthest from that.
  const begin = farthestFrom(corners, 0);
  const turned = [...corners.slice(begin), ...corners.slice(0, begin)];
  const far = farthestFrom(turned, 0);
  const halves = [turned.slice(0, far + 1), [...turned.slice(far), turned[0]]];
  return halves.flatMap((half) => reduced(half).slice(0, -1));
}

const farthestFrom = (corners: readonly Point[], from: number): number =>
  corners.reduce((best, corner, k) => {
    const away = distance(corner, corners[from]);
    return away > distance(corners[best], corners[from]) ? k : best;
  }, from);

function reduced(line: readonly Point[]): Point[] {
  const [from, to] = [line[0], line[line.length - 1]];
  let [farthest, at] = [tolerance, -1];
  for (let k = 1; k + 1 < line.length; ++k) {
    const away = distanceTo([from, to], line[k], true);
    if (away > farthest) [farthest, at] = [away, k];
  }
  if (at < 0) return [from, to];
  return [...reduced(line.slice(0, at + 1)).slice(0, -1), ...reduced(line.slice(at))];
}

export interface FixtureLine {
  line: [Point, Point];
  depth: number;
}

/**
 * Where a fixture with a rectangular outline stands: its middle line, or for one with a front alone its back, which is the
 * long side nearest to a wall. Null: the outline is not a rectangle. `walls`: their lines.
 */
export function fixtureLine(
  outline: readonly Point[],
  isSingle: boolean,
  walls: readonly { from: Point; to: Point }[],
): FixtureLine | null {
  if (!isRectangle(outline)) return null;
  const [a, b, c, d] = outline;
  const isLong = distance(a, b) >= distance(b, c);
  // Both long sides in the same direction.
  const sides: [Point, Point][] = isLong
    ? [
        [a, b],
        [d, c],
      ]
    : [
        [b, c],
        [a, d],
      ];
  const depth = distance(sides[0][0], sides[1][0]);
  const [first, second] = sides;
  if (!isSingle) {
    const [from, to] = [between(first[0], second[0]), between(first[1], second[1])];
    const [x, y] = minus(to, from);
    // To the right, or upwards: such a fixture is not turned around.
    return { line: x > 1e-6 || (x > -1e-6 && y > 0) ? [from, to] : [to, from], depth };
  }
  const away = ([from, to]: [Point, Point]) =>
    Math.min(Infinity, ...walls.map((wall) => distanceTo([wall.from, wall.to], between(from, to), true)));
  const isFirst = away(first) <= away(second);
  const [back, front] = isFirst ? [first, second] : [second, first];
  // The front is to the right of the line.
  const way = minus(back[1], back[0]);
  const right: Point = [way[1], -way[0]];
  const isRight = dot(minus(front[0], back[0]), right) > 0;
  return { line: isRight ? back : [back[1], back[0]], depth };
}
