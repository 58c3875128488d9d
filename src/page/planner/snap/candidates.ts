// The places that the pointer can mean.

import type { Point } from "../document/messages";
import { between, distance, dot, minus, plus, times } from "../geometry/vector";
import {
  faintReach,
  joining,
  ranks,
  slideOf,
  strainOf,
  type Candidate,
  type Guide,
  type Pull,
  type SnapKind,
} from "./choice";
import { crossingOf, nearestOf, passes, tolerance, type Line } from "./lines";
import { lastEdges, type Surroundings } from "./pulls";
import { fromOf, type SnapRequest } from "./request";

/** The beginning of the drawing attracts from twice as far. */
const closing = 2;

const isAt = (a: Point, b: Point | undefined): boolean => b !== undefined && distance(a, b) <= tolerance;

const closingPoint = ({ drawn = [], closes }: SnapRequest): Point | undefined =>
  closes && drawn.length > 2 ? drawn[0] : undefined;

type Place = Omit<Candidate, "slide" | "strain"> & { reach: number };

function placesOf({ near }: Surroundings, request: SnapRequest): Place[] {
  const { reach, drawn = [] } = request;
  const first = closingPoint(request);
  const made = (kind: keyof typeof ranks.point, at: Point, own: number): Place => ({
    kind,
    at,
    rank: ranks.point[kind],
    reach: own,
    guides: [],
  });
  const ends = [...near.flatMap(({ from, to }) => [from, to]), ...drawn].filter((end) => !isAt(end, first));
  return [
    ...(first ? [made("close", first, closing * reach)] : []),
    ...ends.map((end) => made("end", end, Math.max(reach, joining))),
    ...near.map(({ from, to }) => made("middle", between(from, to), reach)),
  ];
}

/** The place that two lines have in common. */
function crossingPlace(a: Pull, b: Pull, reach: number): Place | null {
  const at = crossingOf(a.line, b.line);
  if (!at) return null;
  const guides: Guide[] = [...a.guides(at), ...b.guides(at)];
  if (a.kind === "line" && b.kind === "line")
    return { kind: "crossing", at, rank: ranks.point.crossing, reach, guides };
  const kind: SnapKind =
    a.kind === "line" ? b.kind : b.kind === "line" || ranks.slide[a.kind] <= ranks.slide[b.kind] ? a.kind : b.kind;
  const rank = a.kind === "line" || b.kind === "line" ? ranks.both.drawn : ranks.both.inferred;
  return { kind, at, rank, reach, guides };
}

/** Where an edge along a line would be as long as one of the last ones. */
function lengthPlaces(line: Line, { drawn = [], pointer }: SnapRequest): { at: Point; guides: Guide[] }[] {
  const from = drawn.at(-1);
  if (!from || !passes(line, from)) return [];
  const side = Math.sign(dot(minus(pointer, from), line.way)) || 1;
  return drawn.slice(-1 - lastEdges).flatMap((a, k, corners) => {
    const b = corners[k + 1];
    if (!b) return [];
    const length = distance(a, b);
    return [
      {
        at: plus(from, times(line.way, side * length)),
        guides: [{ from: a, to: b, kind: "length", distance: length }],
      },
    ];
  });
}

/** Every place and every line near the pointer, and what each two of the lines have in common. */
export function candidatesOf(around: Surroundings, request: SnapRequest): Candidate[] {
  const { pointer, reach } = request;
  const pulls = [...around.lines, ...around.inferred];
  const slides = pulls.map((pull) => slideOf(pull, pointer, reach));
  const candidates: Candidate[] = slides.slice();
  const add = ({ reach: own, ...place }: Place, least: number) =>
    candidates.push({
      ...place,
      strain: Math.max(least, strainOf(distance(place.at, pointer), own, reach)),
      slide: null,
    });
  for (const place of placesOf(around, request)) add(place, 0);
  pulls.forEach((a, k) => {
    for (let other = k + 1; other < pulls.length; ++other) {
      const place = crossingPlace(a, pulls[other], reach);
      // A weak line catches from near only, also where it crosses another one.
      if (place) add(place, Math.max(slides[k].strain, slides[other].strain));
    }
  });
  for (const pull of around.inferred)
    for (const { at, guides } of lengthPlaces(pull.line, request))
      add(
        {
          kind: "length",
          at,
          rank: ranks.both.inferred,
          reach: faintReach(reach),
          guides: [...pull.guides(at), ...guides],
        },
        0,
      );
  return candidates.filter(({ at }) => !isAt(at, fromOf(request)));
}

/** The places of a half-line. `place`: the one nearest to the pointer. */
export function candidatesAlong(ray: Line, place: Point, around: Surroundings, request: SnapRequest): Candidate[] {
  const { reach } = request;
  const towards = (at: Point): Guide[] => [{ from: ray.at, to: at, kind: "angle" }];
  const onRay = (at: Point, kind: SnapKind, rank: number, own: number, guides: readonly Guide[]): Candidate => ({
    at,
    kind,
    rank,
    guides: [...towards(at), ...guides],
    strain: strainOf(distance(at, place), own, reach),
    slide: null,
  });
  const ends = around.near.flatMap(({ from, to }) => [from, to]);
  const crossings = [...around.lines, ...around.inferred].flatMap((pull) => {
    const at = crossingOf(ray, pull.line);
    if (!at) return [];
    if (pull.kind !== "line") return [onRay(at, pull.kind, ranks.slide[pull.kind], pull.reach, pull.guides(at))];
    const kind = ends.some((end) => isAt(end, at)) ? "end" : "crossing";
    return [onRay(at, kind, ranks.point[kind], reach, [])];
  });
  const first = closingPoint(request);
  const lengths = lengthPlaces(ray, request).map(({ at, guides }) =>
    onRay(at, "length", ranks.both.inferred, faintReach(reach), guides),
  );
  return [
    ...lengths,
    ...crossings.filter(({ at }) => !isAt(at, ray.at) && !isAt(at, first)),
    ...(first && passes(ray, first) ? [onRay(first, "close", ranks.point.close, closing * reach, [])] : []),
    { ...onRay(nearestOf(ray, place), "angle", ranks.slide.angle, reach, []), slide: ray },
  ];
}
