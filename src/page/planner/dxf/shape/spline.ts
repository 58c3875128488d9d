// Non-uniform rational B-splines.

import type { Lines } from "./lines";

type Point = readonly [number, number];

export interface Spline {
  degree: number;
  knots: readonly number[];
  points: readonly Point[];
  /** Of the points; empty: all the same. */
  weights: readonly number[];
}

const highestDegree = 25;

const isValid = ({ degree, knots, points, weights }: Spline): boolean =>
  Number.isInteger(degree) &&
  degree >= 1 &&
  degree <= highestDegree &&
  points.length > degree &&
  knots.length === points.length + degree + 1 &&
  knots.every((knot, k) => k === 0 || knot >= knots[k - 1]) &&
  knots[degree] < knots[points.length] &&
  (weights.length === 0 || (weights.length === points.length && weights.every((weight) => weight > 0)));

/** By de Boor's algorithm, between the knots `span` and `span` + 1. */
function pointAt({ degree, knots, points, weights }: Spline, span: number, t: number): Point {
  const first = span - degree;
  const work: [number, number, number][] = [];
  for (let k = 0; k <= degree; ++k) {
    const [x, y] = points[first + k];
    const weight = weights.length > 0 ? weights[first + k] : 1;
    work.push([x * weight, y * weight, weight]);
  }
  for (let level = 1; level <= degree; ++level)
    for (let k = degree; k >= level; --k) {
      const lower = knots[first + k];
      const width = knots[first + k + 1 + degree - level] - lower;
      const share = width > 0 ? (t - lower) / width : 0;
      for (let axis = 0; axis < 3; ++axis) work[k][axis] = (1 - share) * work[k - 1][axis] + share * work[k][axis];
    }
  const [x, y, weight] = work[degree];
  return [x / weight, y / weight];
}

function distanceFromLine([x, y]: Point, a: Point, b: Point): number {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const length = Math.hypot(dx, dy);
  return length > 0 ? Math.abs((x - a[0]) * dy - (y - a[1]) * dx) / length : Math.hypot(x - a[0], y - a[1]);
}

/** Draws a spline; false if its description is not valid. */
export function drawSpline(lines: Lines, spline: Spline): boolean {
  if (!isValid(spline)) return false;
  const { degree, knots, points } = spline;
  let [left, right, lower, upper] = [Infinity, -Infinity, Infinity, -Infinity];
  for (const [x, y] of points) {
    left = Math.min(left, x);
    right = Math.max(right, x);
    lower = Math.min(lower, y);
    upper = Math.max(upper, y);
  }
  const tolerance = lines.tolerance(Math.hypot(right - left, upper - lower));
  const before = lines.count;

  const draw = (span: number, from: number, a: Point, to: number, b: Point, levels: number): void => {
    const middle = 0.5 * (from + to);
    const point = pointAt(spline, span, middle);
    if (levels === 0 || distanceFromLine(point, a, b) <= tolerance) lines.line(...b);
    else {
      draw(span, from, a, middle, point, levels - 1);
      draw(span, middle, point, to, b, levels - 1);
    }
  };

  let last = pointAt(spline, degree, knots[degree]);
  lines.move(...last);
  for (let span = degree; span < points.length; ++span) {
    const [from, to] = [knots[span], knots[span + 1]];
    if (from === to) continue;
    // An S has its middle on the straight line from end to end.
    const pieces = degree === 1 ? 1 : 4;
    for (let k = 1; k <= pieces; ++k) {
      const [t, u] = [from + ((k - 1) * (to - from)) / pieces, from + (k * (to - from)) / pieces];
      const next = pointAt(spline, span, k === pieces ? to : u);
      draw(span, t, last, u, next, 5);
      last = next;
    }
  }
  lines.curved += lines.count - before;
  return true;
}
