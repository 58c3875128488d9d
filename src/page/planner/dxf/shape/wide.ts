// Polylines with a width: areas, drawn by their edges. As drawing programs do, straight edges meet in a mitre, and all
// others end at right angles where they do not run into one another.

import { centreOf, type Lines } from "./lines";

type Point = readonly [number, number];

export interface WideEdge {
  from: Point;
  to: Point;
  bulge: number;
  /** At its beginning, and at its end. */
  widths: Point;
  /** Its place among all edges of the polyline. */
  index: number;
}

/** Longer mitres are cut off, in widths. */
const longestMitre = 2;
/** A step between the sides of two edges that is none, in widths. */
const smallestStep = 1e-3;

/** The left and the right side of an edge, from its beginning to its end. */
interface Strip {
  edge: WideEdge;
  sides: [Point[], Point[]];
}

/** Where the left and the right sides of an edge and of the next one meet. */
type Join = [Point, Point];

const isStraight = ({ bulge }: WideEdge): boolean => Math.abs(bulge) <= 1e-6;
const apart = ([x, y]: Point, [u, v]: Point): number => Math.hypot(u - x, v - y);

function stripOf(edge: WideEdge, lines: Lines): Strip {
  const { from, to, bulge, widths } = edge;
  const sides: Strip["sides"] = [[], []];
  const add = ([x, y]: Point, [nx, ny]: Point, width: number) => {
    sides[0].push([x + 0.5 * width * nx, y + 0.5 * width * ny]);
    sides[1].push([x - 0.5 * width * nx, y - 0.5 * width * ny]);
  };
  if (isStraight(edge)) {
    const length = apart(from, to);
    const left: Point = [(from[1] - to[1]) / length, (to[0] - from[0]) / length];
    add(from, left, widths[0]);
    add(to, left, widths[1]);
    return { edge, sides };
  }
  const centre = centreOf(...from, ...to, bulge);
  const [dx, dy] = [from[0] - centre[0], from[1] - centre[1]];
  // The centre is on the left of an arc that runs counter-clockwise.
  const outwards = -Math.sign(bulge) / Math.hypot(dx, dy);
  const sweep = 4 * Math.atan(bulge);
  const pieces = lines.pieces(Math.abs(sweep));
  for (let k = 0; k <= pieces; ++k) {
    const [c, s] = [Math.cos((sweep * k) / pieces), Math.sin((sweep * k) / pieces)];
    const [x, y] = [c * dx - s * dy, s * dx + c * dy];
    const width = widths[0] + ((widths[1] - widths[0]) * k) / pieces;
    add([centre[0] + x, centre[1] + y], [outwards * x, outwards * y], width);
  }
  lines.curved += 2 * pieces;
  return { edge, sides };
}

/** Where the lines through two sides cross; null if they are parallel. */
function crossing([p, q]: readonly Point[], [u, v]: readonly Point[]): Point | null {
  const [ax, ay, bx, by] = [q[0] - p[0], q[1] - p[1], v[0] - u[0], v[1] - u[1]];
  const cross = ax * by - ay * bx;
  if (Math.abs(cross) <= 1e-9 * Math.hypot(ax, ay) * Math.hypot(bx, by)) return null;
  const share = ((u[0] - p[0]) * by - (u[1] - p[1]) * bx) / cross;
  return [p[0] + share * ax, p[1] + share * ay];
}

function joinOf(one: Strip, next: Strip): Join | null {
  const width = one.edge.widths[1];
  const join: Point[] = [];
  for (const side of [0, 1]) {
    const [before, after] = [one.sides[side], next.sides[side]];
    const end = before[before.length - 1];
    const isMitred = isStraight(one.edge) && isStraight(next.edge);
    const isSame = apart(end, after[0]) <= smallestStep * width;
    const point = isSame ? end : isMitred ? crossing(before, after) : null;
    if (!point || apart(point, one.edge.to) > longestMitre * width) return null;
    join.push(point);
  }
  return Math.abs(width - next.edge.widths[0]) <= smallestStep * width ? (join as Join) : null;
}

/** Each edge with the next one, and the last with the first. Edges that are too short for their mitres have none. */
function joinsOf(strips: readonly Strip[], isNext: (one: WideEdge, next: WideEdge) => boolean): (Join | null)[] {
  const count = strips.length;
  const joins = strips.map((one, k) => {
    const next = strips[(k + 1) % count];
    return isNext(one.edge, next.edge) ? joinOf(one, next) : null;
  });
  const isTurned = ({ sides }: Strip, k: number): boolean =>
    sides.some((points, side) => {
      const [from, to] = [points[0], points[points.length - 1]];
      const [begin, end] = [joins[(k + count - 1) % count]?.[side] ?? from, joins[k]?.[side] ?? to];
      return (end[0] - begin[0]) * (to[0] - from[0]) + (end[1] - begin[1]) * (to[1] - from[1]) < 0;
    });
  for (const k of strips.flatMap((strip, k) => (isStraight(strip.edge) && isTurned(strip, k) ? [k] : [])))
    joins[k] = joins[(k + count - 1) % count] = null;
  return joins;
}

function drawLoop(lines: Lines, points: readonly Point[]): void {
  const first = lines.count;
  lines.move(...points[0]);
  for (const point of points.slice(1)) lines.line(...point);
  lines.line(...points[0]);
  lines.outline(first);
}

/** `count`: of all edges of the polyline. */
export function drawWide(lines: Lines, edges: readonly WideEdge[], count: number, isClosed: boolean): void {
  const strips = edges.map((edge) => stripOf(edge, lines));
  const joins = joinsOf(
    strips,
    (one, next) => next.index === one.index + 1 || (isClosed && one.index === count - 1 && next.index === 0),
  );
  const end = joins.indexOf(null);
  let sides: Strip["sides"] = [[], []];
  for (let k = end + 1; k <= end + strips.length; ++k) {
    const at = k % strips.length;
    const [before, join] = [joins[(at + strips.length - 1) % strips.length], joins[at]];
    for (const side of [0, 1]) {
      const points = strips[at].sides[side];
      // The join before has the first point.
      for (const point of points.slice(before ? 1 : 0, -1)) sides[side].push(point);
      sides[side].push(join?.[side] ?? points[points.length - 1]);
    }
    if (join) continue;
    drawLoop(lines, [...sides[0], ...sides[1].reverse()]);
    sides = [[], []];
  }
  if (end < 0) for (const side of sides) drawLoop(lines, side);
}
