// The subpaths of a path of a PDF page. Curves become chords.

import type { Point } from "../document/messages";
import type { Matrix } from "../dxf/shape/matrix";
import { Region, type Loop } from "./region";

const chords = 24;
const [moveTo, lineTo, curveTo, quadraticTo] = [0, 1, 2, 3];

/** The subpaths of a path: numbers of operations, each with its coordinates. Fills close what they begin. */
export function loopsOf(path: ArrayLike<number>, [a, b, c, d, e, f]: Matrix, isFilled: boolean): Loop[] {
  const loops: Loop[] = [];
  let loop: number[] = [];
  let [x, y] = [0, 0];
  const add = (u: number, v: number) => {
    [x, y] = [u, v];
    const [px, py] = [a * u + c * v + e, b * u + d * v + f];
    if (loop.length === 0 || loop[loop.length - 2] !== px || loop[loop.length - 1] !== py) loop.push(px, py);
  };
  const finish = (isClosed: boolean) => {
    const [u, v] = loop;
    if (isClosed && loop.length > 2 && (loop[loop.length - 2] !== u || loop[loop.length - 1] !== v)) loop.push(u, v);
    if (loop.length > 2) loops.push(loop);
    loop = [];
  };
  /** `controls`: of the curve after the present point. */
  const curve = (controls: readonly [number, number][]) => {
    const points: [number, number][] = [[x, y], ...controls];
    for (let k = 1; k <= chords; ++k) {
      let level = points;
      while (level.length > 1)
        level = level.slice(1).map(([u, v], n): [number, number] => {
          const [p, q] = level[n];
          return [p + (k / chords) * (u - p), q + (k / chords) * (v - q)];
        });
      add(...level[0]);
    }
    [x, y] = controls[controls.length - 1];
  };
  let start: Point = [0, 0];
  for (let k = 0; k < path.length; ) {
    const pair = (n: number): Point => [path[k + 2 * n], path[k + 2 * n + 1]];
    switch (path[k++]) {
      case moveTo:
        finish(isFilled);
        start = pair(0);
        add(...start);
        k += 2;
        break;
      case lineTo:
        add(...pair(0));
        k += 2;
        break;
      case curveTo:
        curve([pair(0), pair(1), pair(2)]);
        k += 6;
        break;
      case quadraticTo:
        curve([pair(0), pair(1)]);
        k += 4;
        break;
      default:
        finish(true);
        add(...start);
    }
  }
  finish(isFilled);
  return loops;
}

/** A rectangle of a form, or the unit square of an image. */
export const placed = ([x, y, u, v]: ArrayLike<number> & Iterable<number>, matrix: Matrix): Region =>
  new Region(loopsOf([moveTo, x, y, lineTo, u, y, lineTo, u, v, lineTo, x, v], matrix, true), false);
