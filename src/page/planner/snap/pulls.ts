// The lines that attract the pointer: those of the drawing, and those that follow from it.

import type { Point } from "../document/messages";
import { distance, unitAt } from "../geometry/vector";
import { faintReach, hysteresis, joining, strainOf, type Guide, type Pull, type SnapKind } from "./choice";
import { gapPulls } from "./gaps";
import { areParallel, lineAlong, lineOf, nearestOf, normalOf, passes, tolerance, type Line } from "./lines";
import { fromOf, type SnapRequest } from "./request";
import type { SegmentIndex } from "./segment_index";
import type { Segment } from "./segments";

/** The largest numbers of lines; more of them would only flicker. */
const most = { near: 128, wide: 64, crossing: 24, inferred: 16, through: 8 };
/** How many times farther corners may be to show extensions and alignments. */
const wide = 20;
/** The share of the reach of lines through the corners of the drawing. */
const weak = 0.5;
/** The last edges to which new ones may be parallel or perpendicular, or as long as. */
export const lastEdges = 3;

export interface Surroundings {
  near: Segment[];
  /** The nearest of them, whose crossings count. */
  lines: Pull[];
  inferred: Pull[];
}

const edgesOfDrawing = (drawn: readonly Point[]): Segment[] =>
  drawn
    .slice(1)
    .map((to, k) => ({ from: drawn[k], to }))
    .filter(({ from, to }) => distance(from, to) > tolerance);

const wayOf = ({ from, to }: Segment): Point => lineOf(from, to).way;

function dotted(kind: SnapKind, anchor: Point, isMeasured = false): (at: Point) => Guide[] {
  return (at) =>
    distance(anchor, at) <= tolerance
      ? []
      : [{ from: anchor, to: at, kind, ...(isMeasured && { distance: distance(anchor, at) }) }];
}

function extensions(edges: readonly Segment[], reach: number): Pull[] {
  const beyond = (from: Point, to: Point): Pull => ({
    line: lineAlong(to, wayOf({ from, to }), 0),
    kind: "extension",
    reach,
    guides: dotted("extension", to, true),
  });
  return edges.flatMap(({ from, to }) => [beyond(from, to), beyond(to, from)]);
}

/** At right angles to `ways` and to the last edges, and along these. */
function directions(from: Point, ways: readonly Point[], last: readonly Segment[], reach: number): Pull[] {
  const pull = (kind: SnapKind, way: Point): Pull => ({
    line: lineAlong(from, way),
    kind,
    reach,
    guides: dotted(kind, from),
  });
  const edges = last.map(wayOf);
  // Along the previous edge there is its extension.
  const others = edges.filter((way) => !areParallel(way, edges[edges.length - 1]));
  return [
    ...[...ways, ...edges].map((way) => pull("perpendicular", normalOf(way))),
    ...others.map((way) => pull("parallel", way)),
  ];
}

/** Through the last corner, along the axes of the frame: almost straight edges are meant to be straight. */
const straightOf = (from: Point, frame: number, reach: number): Pull[] =>
  [frame, frame + 90].map((direction) => ({
    line: lineAlong(from, unitAt(direction)),
    kind: "align",
    reach,
    guides: dotted("align", from),
  }));

/** Through corners, along the axes of the frame; of several corners on a line the nearest one counts. */
function alignments(corners: readonly Point[], pointer: Point, frame: number, reach: number): Pull[] {
  const sorted = corners.map((corner) => ({ corner, away: distance(corner, pointer) })).sort((a, b) => a.away - b.away);
  return [frame, frame + 90].flatMap((direction) => {
    const found: Line[] = [];
    for (const { corner } of sorted) {
      const line = lineAlong(corner, unitAt(direction));
      if (distance(nearestOf(line, pointer), pointer) > (1 + hysteresis) * reach) continue;
      if (!found.some((other) => passes(other, corner))) found.push(line);
    }
    return found.map((line): Pull => ({ line, kind: "align", reach, guides: dotted("align", line.at, true) }));
  });
}

/** All that attracts at a place. */
export function surroundingsOf(index: SegmentIndex, request: SnapRequest, place: Point): Surroundings {
  const { reach, drawn = [], isBox = false, frame = 0 } = request;
  const from = fromOf(request);
  const own = edgesOfDrawing(drawn);
  const strain = ({ line, reach: of }: Pull) => strainOf(distance(nearestOf(line, place), place), of, reach);
  const nearest = (pulls: readonly Pull[], count: number) =>
    pulls
      .map((pull) => ({ pull, strain: strain(pull) }))
      .filter((one) => one.strain <= 1 + hysteresis)
      .sort((a, b) => a.strain - b.strain)
      .slice(0, count)
      .map(({ pull }) => pull);
  const isNear = ({ from: a, to: b }: Segment) =>
    distance(nearestOf(lineOf(a, b), place), place) <= (1 + hysteresis) * reach;
  const near = [
    ...index.near(place, Math.max((1 + hysteresis) * reach, 2 * joining), most.near),
    ...own.filter(isNear),
  ];
  const beside = index.near(place, wide * reach, most.wide);
  const corners = beside.flatMap((one) => [one.from, one.to]);
  const faint = faintReach(reach);
  const lines = nearest(
    near.map((one) => ({ line: lineOf(one.from, one.to), kind: "line", reach, guides: () => [] })),
    most.crossing,
  );
  const through = from && !isBox ? index.near(from, tolerance, most.through) : [];
  const ways = [...through.map(wayOf), ...lines.map(({ line }) => line.way)];
  const inferred = [
    ...extensions(beside, faint),
    ...extensions(own, reach),
    ...(from && !isBox ? directions(from, ways, own.slice(-lastEdges), reach) : []),
    ...(from && !isBox ? straightOf(from, frame, reach) : []),
    ...alignments(drawn, place, frame, weak * reach),
    ...alignments(corners, place, frame, faint),
    ...(from && isBox ? gapPulls(index, from, place, frame, faint) : []),
  ];
  return { near, lines, inferred: nearest(inferred, most.inferred) };
}
