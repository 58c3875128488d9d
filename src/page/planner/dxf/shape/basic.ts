// Entities of one part, drawn as lines.

import type { Entity } from "../file/entity";
import { radians, sweepOf } from "./angle";
import { drawHatch } from "./hatch";
import type { Lines } from "./lines";
import { drawPolyline, Polyline } from "./polyline";
import { drawSpline } from "./spline";

function drawLightPolyline(lines: Lines, entity: Entity): void {
  const width = entity.number(43);
  const polyline = new Polyline(lines, [width, width]);
  const { codes, numbers, count } = entity;
  let x = 0;
  for (let k = 0; k < count; ++k)
    if (codes[k] === 10) x = numbers[k];
    else if (codes[k] === 20) polyline.add(x, numbers[k]);
    else if (codes[k] === 42) polyline.bend(numbers[k]);
    else if (codes[k] === 40) polyline.widen(0, numbers[k]);
    else if (codes[k] === 41) polyline.widen(1, numbers[k]);
  polyline.finishOutline((entity.number(70) & 1) !== 0);
}

function drawEllipse(lines: Lines, entity: Entity): void {
  const [mx, my, mz] = [entity.number(11), entity.number(21), entity.number(31)];
  const [nx, ny, nz] = entity.normal();
  const scale = entity.number(40, 1) / (Math.hypot(nx, ny, nz) || 1);
  const minor = [scale * (ny * mz - nz * my), scale * (nz * mx - nx * mz)];
  const from = entity.number(41);
  const sweep = sweepOf(from, entity.number(42, 2 * Math.PI));
  const first = lines.count;
  lines.arc(entity.point(10), [mx, my], minor, from, sweep);
  if (sweep > 2 * Math.PI - 1e-9) lines.outline(first);
}

/** Corners with the codes 10 to 13, of which the last may be missing or equal to the one before. */
function drawFace(lines: Lines, entity: Entity, order: readonly number[]): void {
  const corners = order.filter((code) => code < 13 || entity.has(13)).map((code) => entity.point(code));
  drawPolyline(lines, corners, true);
}

/** Each element of a multiline crosses the mitre of each vertex at some distance from the vertex. */
function drawMultiline(lines: Lines, entity: Entity): void {
  const elements: [number, number][][] = [];
  let [x, y, mitreX, mitreY, element, isFirst] = [0, 0, 0, 0, -1, false];
  for (let k = 0; k < entity.count; ++k) {
    const [code, value] = [entity.codes[k], entity.numbers[k]];
    if (code === 11) [x, element, isFirst] = [value, -1, false];
    else if (code === 21) y = value;
    else if (code === 13) mitreX = value;
    else if (code === 23) mitreY = value;
    else if (code === 74) {
      ++element;
      isFirst = true;
    } else if (code === 41 && isFirst) {
      isFirst = false;
      while (elements.length <= element) elements.push([]);
      elements[element].push([x + mitreX * value, y + mitreY * value]);
    }
  }
  for (const points of elements) drawPolyline(lines, points, (entity.number(71) & 2) !== 0);
}

export interface BasicShape {
  /** Its coordinates are those of its own plane, not of the block. */
  isPlanar: boolean;
  /** False if the description is not valid. */
  draw(lines: Lines, entity: Entity): boolean;
}

type Draw = (lines: Lines, entity: Entity) => void;

const always =
  (draw: Draw): BasicShape["draw"] =>
  (lines, entity) => {
    draw(lines, entity);
    return true;
  };
const planar = (draw: Draw): BasicShape => ({ isPlanar: true, draw: always(draw) });
const spatial = (draw: Draw): BasicShape => ({ isPlanar: false, draw: always(draw) });
const solid = planar((lines, entity) => drawFace(lines, entity, [10, 11, 13, 12]));

function drawLine(lines: Lines, entity: Entity): void {
  lines.move(entity.number(10), entity.number(20));
  lines.line(entity.number(11), entity.number(21));
}

function drawCircle(lines: Lines, entity: Entity): void {
  const first = lines.count;
  lines.circle(entity.point(10), entity.number(40));
  lines.outline(first);
}

function drawArc(lines: Lines, entity: Entity): void {
  const from = radians(entity.number(50));
  lines.circle(entity.point(10), entity.number(40), from, sweepOf(from, radians(entity.number(51, 360))));
}

/** Programs that write no control points give at least points on the curve. */
function drawSplineEntity(lines: Lines, entity: Entity): boolean {
  const points = entity.points(10);
  if (points.length === 0 && entity.has(11)) drawPolyline(lines, entity.points(11));
  else {
    const [degree, knots, weights] = [entity.number(71, 3), entity.all(40), entity.all(41)];
    return drawSpline(lines, { degree, knots, points, weights });
  }
  return true;
}

export const basicShapes: ReadonlyMap<string, BasicShape> = new Map([
  ["LINE", spatial(drawLine)],
  ["LWPOLYLINE", planar(drawLightPolyline)],
  ["CIRCLE", planar(drawCircle)],
  ["ARC", planar(drawArc)],
  ["ELLIPSE", spatial(drawEllipse)],
  ["SPLINE", { isPlanar: false, draw: drawSplineEntity }],
  ["SOLID", solid],
  ["TRACE", solid],
  ["3DFACE", spatial((lines, entity) => drawFace(lines, entity, [10, 11, 12, 13]))],
  ["HATCH", { isPlanar: true, draw: drawHatch }],
  ["LEADER", spatial((lines, entity) => drawPolyline(lines, entity.points(10)))],
  ["MLINE", spatial(drawMultiline)],
]);
