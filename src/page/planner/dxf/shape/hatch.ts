// The boundary of a hatch: paths that are polylines or lists of edges.

import { Numbers } from "../file/numbers";
import { radians, sweepOf } from "./angle";
import type { Lines } from "./lines";
import { Polyline } from "./polyline";
import { drawSpline } from "./spline";

/** From the angle of a point of an ellipse to the angle of its point on the circle about it. */
const parameterOf = (angle: number, ratio: number): number => Math.atan2(Math.sin(angle) / ratio, Math.cos(angle));

function drawEdge(lines: Lines, edge: Numbers): boolean {
  const isBackward = edge.number(73, 1) === 0;
  // Angles of edges that run clockwise are measured clockwise.
  const [from, to] = isBackward ? [-edge.number(51), -edge.number(50)] : [edge.number(50), edge.number(51)];
  const [start, end] = [radians(from), radians(to)];
  switch (edge.number(72)) {
    case 1:
      lines.move(...edge.point(10));
      lines.line(...edge.point(11));
      return true;
    case 2:
      lines.circle(edge.point(10), edge.number(40), start, sweepOf(start, end));
      return true;
    case 3: {
      const [x, y] = edge.point(11);
      const ratio = edge.number(40, 1);
      const first = parameterOf(start, ratio);
      lines.arc(edge.point(10), [x, y], [-y * ratio, x * ratio], first, sweepOf(first, parameterOf(end, ratio)));
      return true;
    }
    case 4: {
      const weights = edge.number(73, 0) === 0 ? [] : edge.all(42);
      return drawSpline(lines, { degree: edge.number(94), knots: edge.all(40), points: edge.points(10), weights });
    }
    default:
      return false;
  }
}

/** False if a part of the boundary is not valid. */
export function drawHatch(lines: Lines, { codes, numbers, count }: Numbers): boolean {
  let isValid = true;
  let isInPaths = false;
  let polyline: Polyline | null = null;
  const edge = new Numbers();
  let x = 0;
  let isClosed = true;
  const finish = (): void => {
    polyline?.finish(isClosed);
    if (edge.count > 0 && !drawEdge(lines, edge)) isValid = false;
    polyline = null;
    edge.clear();
  };
  const corner = (path: Polyline, code: number, value: number): void => {
    if (code === 10) x = value;
    else if (code === 20) path.add(x, value);
    else if (code === 42) path.bend(value);
    else if (code === 73) isClosed = value !== 0;
  };
  for (let k = 0; k < count; ++k) {
    const [code, value] = [codes[k], numbers[k]];
    // Style or pattern: the paths are over.
    if (code === 75 || code === 76) break;
    if (code === 91) isInPaths = true;
    else if (!isInPaths) continue;
    else if (code === 92) {
      finish();
      isClosed = true;
      if ((value & 2) !== 0) polyline = new Polyline(lines);
    } else if (polyline) corner(polyline, code, value);
    else {
      if (code === 72) finish();
      if (code === 72 || edge.count > 0) edge.add(code, value);
    }
  }
  finish();
  return isValid;
}
