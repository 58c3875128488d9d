// Where the picture of the floor plan lies, and what its scale, a turn, a crop or another file make of that.

import type { Point } from "../document/messages";
import { boundsOf, type Bounds } from "../geometry/bounds";
import { factorOf, tidy, type LengthUnit } from "../geometry/units";
import { between, cross, directionOf, distance, dot, minus, plus, times, unitAt } from "../geometry/vector";
import type { Viewport } from "../view/viewport";
import { hasLines, type Drawing, type Line } from "./drawing";

/** The width of a picture without a scale, m. */
const usualWidth = 20;
/** Lines within this angle of horizontal or vertical were meant to be so, degrees. */
const askew = 5;
/** Two lengths check one another if their directions differ by this angle, degrees. */
export const leastAngle = 30;
/** Relative difference of two lengths that agree. */
export const tolerance = 0.01;

/** Pixels to m: turned about the lower left corner, which is at `origin`. */
export interface Placement {
  origin: Point;
  /** m per pixel. */
  step: number;
  /** Degrees, counter-clockwise. */
  turn: number;
  /** Pixels. */
  height: number;
}

const pixelLength = ({ from, to, length }: Line): number => length / distance(from, to);

export function placementOf({ size, at, unit, scale, rotation_deg = 0 }: Drawing, { factor }: LengthUnit): Placement {
  const step = scale ? pixelLength(scale) * factor : unit === undefined ? usualWidth / size[0] : factorOf(unit);
  return { origin: times(at, factor), step, turn: rotation_deg, height: size[1] };
}

/** A pixel of the screen, in pixels of the picture. */
export const screenPixel = ({ step }: Placement, { scale }: Pick<Viewport, "scale">): number => 1 / (step * scale);

export function toWorld({ origin, step, turn, height }: Placement, [x, y]: Point): Point {
  const [c, s] = unitAt(turn);
  const [u, v] = [step * x, step * (height - y)];
  return [origin[0] + c * u - s * v, origin[1] + s * u + c * v];
}

export function toPixel({ origin, step, turn, height }: Placement, point: Point): Point {
  const way = minus(point, origin);
  const [c, s] = unitAt(turn);
  return [dot(way, [c, s]) / step, height - cross([c, s], way) / step];
}

/** A map of points, as a canvas takes it. */
export type Matrix = [number, number, number, number, number, number];

/** Pixels to the screen. */
export function matrixOf(placement: Placement, viewport: Viewport): Matrix {
  const [c, s] = unitAt(placement.turn).map((value) => value * placement.step * viewport.scale);
  const [x, y] = viewport.toScreen(placement.origin);
  return [c, -s, s, c, x - s * placement.height, y - c * placement.height];
}

/** The corners of the part that is shown, pixels. */
export function shownCorners({ size: [width, height], crop = [0, 0, width, height] }: Drawing): Point[] {
  const [left, upper, right, lower] = crop;
  return [
    [left, lower],
    [right, lower],
    [right, upper],
    [left, upper],
  ];
}

export const boundsOfPicture = (drawing: Drawing, unit: LengthUnit): Bounds | null =>
  boundsOf(shownCorners(drawing).map((corner) => toWorld(placementOf(drawing, unit), corner)));

/** To a hundredth of a pixel, or to a ten millionth of a drawing of lines, whose corners are exact. */
export function roundPixel([x, y]: Point, { file, size }: Pick<Drawing, "file" | "size">): Point {
  const decimals = hasLines(file) ? Math.max(Math.ceil(7 - Math.log10(Math.max(...size))), 0) : 2;
  return [Number(x.toFixed(decimals)), Number(y.toFixed(decimals))];
}

/** `drawing` at another place, so that a pixel stays where it was before. */
function keeping(pixel: Point, before: Drawing, drawing: Drawing, unit: LengthUnit): Drawing {
  const [old, now] = [before, drawing].map((one) => toWorld(placementOf(one, unit), pixel));
  return shifted(drawing, unit, minus(old, now));
}

/** An angle without the digits that only rounding makes, from -180 to 180; undefined for none. */
function tidyTurn(degrees: number): number | undefined {
  const turn = Number((degrees - 360 * Math.round(degrees / 360)).toFixed(4));
  return turn === 0 ? undefined : turn;
}

/** The angle by which the picture turns to make a line horizontal or vertical, whichever is nearer. */
export function straighteningOf({ rotation_deg = 0 }: Drawing, { from, to }: Pick<Line, "from" | "to">): number {
  const direction = directionOf([to[0] - from[0], from[1] - to[1]]) + rotation_deg;
  return Number((90 * Math.round(direction / 90) - direction).toFixed(4));
}

/** Whether a line was meant to be horizontal or vertical, and is not. */
export function isAskew(drawing: Drawing, line: Pick<Line, "from" | "to">): boolean {
  const turn = Math.abs(straighteningOf(drawing, line));
  return turn >= 0.01 && turn <= askew;
}

/** `keeps`: whether the beginning of the line stays where it is, or the lower left corner of the picture. */
export function withScale(
  drawing: Drawing,
  unit: LengthUnit,
  { line, isStraight, keeps }: { line: Line; isStraight: boolean; keeps: "line" | "corner" },
): Drawing {
  const turn = (drawing.rotation_deg ?? 0) + (isStraight ? straighteningOf(drawing, line) : 0);
  const scaled = { ...drawing, scale: line, rotation_deg: tidyTurn(turn) };
  return keeps === "line" ? keeping(line.from, drawing, scaled, unit) : scaled;
}

/** Turns the picture about the middle of its shown part. */
export function turnedTo(drawing: Drawing, unit: LengthUnit, degrees: number): Drawing {
  const [a, , b] = shownCorners(drawing);
  return keeping(between(a, b), drawing, { ...drawing, rotation_deg: tidyTurn(degrees) }, unit);
}

/** `shift`: m. */
export function shifted(drawing: Drawing, unit: LengthUnit, shift: Point): Drawing {
  const [x, y] = plus(drawing.at, times(shift, 1 / unit.factor));
  return { ...drawing, at: [tidy(x, unit), tidy(y, unit)] };
}

/** A part of the picture, in whole pixels unless it has lines; undefined for all of it. */
export function cropBetween({ file, size: [width, height] }: Drawing, a: Point, b: Point): Drawing["crop"] {
  const whole = hasLines(file) ? (value: number) => value : Math.round;
  const [x, y] = [0, 1].map((axis) => [a[axis], b[axis]].map(whole).sort((p, q) => p - q));
  const [left, right] = x.map((value) => Math.min(Math.max(value, 0), width));
  const [upper, lower] = y.map((value) => Math.min(Math.max(value, 0), height));
  const isWhole = left === 0 && upper === 0 && right === width && lower === height;
  return isWhole || left === right || upper === lower ? undefined : [left, upper, right, lower];
}

/** What a file says of itself. */
export type Source = Pick<Drawing, "file" | "page" | "size" | "unit" | "origin">;

/** Another version of a DXF drawing: its coordinates stay where they are. */
function newVersion(drawing: Drawing, next: Source, of: LengthUnit): Drawing | null {
  const { origin, unit, rotation_deg = 0 } = drawing;
  if (!origin || !next.origin || unit === undefined || unit !== next.unit || drawing.scale) return null;
  const [c, s] = unitAt(rotation_deg);
  const [x, y] = times(minus(next.origin, origin), factorOf(unit));
  return shifted({ ...drawing, ...next, crop: undefined }, of, [c * x - s * y, s * x + c * y]);
}

/**
 * Another picture at the place of this one: the coordinates of its file stay, or else its lower left corner and its scale.
 * A check stays with a file of the same size and page only: nobody has confirmed that another one has the same scale.
 */
export function replacedBy(drawing: Drawing, next: Source, unit: LengthUnit): Drawing {
  return newVersion(drawing, next, unit) ?? atCorner(drawing, next, unit);
}

const endingOf = (file: string): string => (hasLines(file) ? file.slice(-4).toLowerCase() : "");

/**
 * How many pixels of the next picture are one of this: one, so that m per pixel, or per point of the paper, stay with
 * whatever is added at the sides. Pictures of the same proportions are taken as the same one with another resolution, and
 * pixels are no points: these keep the width.
 */
function enlargement({ file, size: [width, height] }: Drawing, next: Source): number {
  const factor = next.size[0] / width;
  const isSameShape = Math.abs(next.size[1] - factor * height) <= Math.max(factor, 1); // sizes are whole pixels
  const isPicture = !hasLines(file) && isSameShape;
  return isPicture || endingOf(file) !== endingOf(next.file) ? factor : 1;
}

/** The scale of a drawing whose unit is known. */
function scaleOfUnit({ unit, size: [width, height] }: Drawing, { factor }: LengthUnit): Line | undefined {
  if (unit === undefined) return undefined;
  return { from: [0, height], to: [width, height], length: (width * factorOf(unit)) / factor };
}

function atCorner(drawing: Drawing, next: Source, unit: LengthUnit): Drawing {
  const { file, size, page = 1 } = next;
  // A unit that a person has overruled by a scale does not come back with the next version.
  if (next.unit !== undefined && next.unit === drawing.unit && drawing.scale) {
    const { from, to, length } = drawing.scale;
    const [width, height] = size;
    const line = {
      from: [0, height] as Point,
      to: [width, height] as Point,
      length: (width * length) / distance(from, to),
    };
    return { ...drawing, ...next, scale: line, check: undefined, crop: undefined };
  }
  // A drawing with a unit is straight.
  const exact = { page: undefined, scale: undefined, check: undefined, crop: undefined, rotation_deg: undefined };
  if (next.unit !== undefined) return { ...drawing, ...exact, ...next };
  const factor = enlargement(drawing, next);
  const moved = ([x, y]: Point): Point =>
    roundPixel([factor * x, size[1] - factor * (drawing.size[1] - y)], { file, size });
  const { scale = scaleOfUnit(drawing, unit), check, page: old = 1 } = drawing;
  const isSame = page === old && endingOf(file) === endingOf(drawing.file) && distance(size, drawing.size) === 0;
  const unknown = { page: undefined, unit: undefined, origin: undefined };
  const line = scale && { ...scale, from: moved(scale.from), to: moved(scale.to) };
  const replaced = { ...drawing, ...unknown, ...next, scale: line, check: isSame ? check : undefined };
  if (!drawing.crop) return replaced;
  const [left, upper, right, lower] = drawing.crop;
  return { ...replaced, crop: cropBetween(replaced, moved([left, upper]), moved([right, lower])) };
}

/** The angle between two lines, from 0 to 90 degrees. */
export function angleBetween(a: Pick<Line, "from" | "to">, b: Pick<Line, "from" | "to">): number {
  const [u, v] = [a, b].map(({ from, to }) => minus(to, from));
  return directionOf([Math.abs(dot(u, v)), Math.abs(cross(u, v))]);
}

export interface Comparison {
  /** The second length as the scale gives it, in the unit of the store. */
  byScale: number;
  /** By how much it differs from the given one, relative to that. */
  difference: number;
  agrees: boolean;
}

/** Null without two lengths in different directions. */
export function comparisonOf({ scale, check }: Drawing): Comparison | null {
  if (!scale || !check || angleBetween(scale, check) < leastAngle) return null;
  const byScale = distance(check.from, check.to) * pixelLength(scale);
  const difference = byScale / check.length - 1;
  return { byScale, difference, agrees: Math.abs(difference) <= tolerance };
}
