// Candidates on the faces of fixtures and walls.

import type { EditBuilder } from "../document/edit";
import { valueAt, type Json, type JsonObject } from "../document/json";
import type { Part, Point } from "../document/messages";
import { nextId } from "../elements/copies";
import { contains, edgesOf, nearestOn, signedArea } from "../geometry/polygon";
import { directionOf, distance, minus, wholeTurn } from "../geometry/vector";
import { inFile, type Site } from "./site";
import type { WallLine } from "./walls";

const reach = 0.6; // m from a wall or fixture

export type Compass = "east" | "north" | "west" | "south";

const compass: Compass[] = ["east", "north", "west", "south"];

/** What carries candidates: a fixture, an inner wall, or a wall of the room by its number. */
export interface Carrier {
  key: "fixture" | "inner_wall" | "wall";
  name: string | number;
  /** The face at the pointer; null if none of the four looks there. */
  face: Compass | null;
  /** All faces, and those of `face`. */
  edges: readonly [Point, Point][];
  faceEdges: readonly [Point, Point][];
  /** m; of a wall of the room unknown. */
  height?: number;
}

/** The part of the compass within 45 degrees of which a face looks; null for exactly between two. */
export function lookOf([a, b]: readonly [Point, Point], isLeftTurning: boolean): Compass | null {
  const normal = directionOf(minus(b, a)) + (isLeftTurning ? -90 : 90);
  const quarters = wholeTurn(normal) / 90;
  const nearest = Math.round(quarters);
  return Math.abs(quarters - nearest) < 0.5 - 1e-9 ? compass[nearest % 4] : null;
}

const awayFrom = (edge: readonly [Point, Point], point: Point): number =>
  distance(nearestOn(edge[0], edge[1], point), point);

function carrierOf({ kind, id, outline, height }: Part, point: Point): Carrier {
  const edges = edgesOf(outline);
  const isLeftTurning = signedArea(outline) > 0;
  const nearest = edges.reduce((best, edge) => (awayFrom(edge, point) < awayFrom(best, point) ? edge : best));
  const face = lookOf(nearest, isLeftTurning);
  const faceEdges = face === null ? [] : edges.filter((edge) => lookOf(edge, isLeftTurning) === face);
  return { key: kind === "fixture" ? "fixture" : "inner_wall", name: id, face, edges, faceEdges, height };
}

/** The fixture or wall at a point: the one that the point is in, or the nearest within reach. */
export function carrierAt(parts: readonly Part[], walls: readonly WallLine[], point: Point): Carrier | null {
  let [found, least] = [null as (() => Carrier) | null, reach];
  const offer = (away: number, make: () => Carrier) => {
    if (away < least) [found, least] = [make, away];
  };
  for (const part of parts) {
    const isSolid = (part.kind === "fixture" || part.kind === "wall") && part.id !== "" && part.outline.length > 2;
    if (!isSolid) continue;
    const away = Math.min(...edgesOf(part.outline).map((edge) => awayFrom(edge, point)));
    offer(contains(part.outline, point) ? 0 : away, () => carrierOf(part, point));
  }
  for (const { from, to, number } of walls)
    if (number !== null)
      offer(awayFrom([from, to], point), () => {
        const edges: [Point, Point][] = [[from, to]];
        return { key: "wall", name: number, face: null, edges, faceEdges: edges };
      });
  return found && (found as () => Carrier)();
}

export interface FacesForm {
  type: string;
  /** All faces instead of one. */
  isAround: boolean;
  /** m */
  z: number;
  spacing: number;
  /** Degrees downwards from the horizontal. */
  tilt: number;
}

const usualId = (key: Carrier["key"], name: string | number, face: Compass | null): string =>
  key === "wall" ? `wall-${name}` : face === null ? String(name) : `${name}-${face}`;

/** The beginnings of the ids of candidates on rails and faces. */
function beginnings(json: Json): Set<string> {
  const idsOf = (list: string, nameOf: (value: Json) => string) => {
    const members = valueAt(json, list);
    return Array.isArray(members) ? members.map(nameOf) : [];
  };
  const ownId = (value: Json) => String(valueAt(value, "/id"));
  const onFaces = (value: Json) => {
    const key = (["fixture", "inner_wall", "wall"] as const).find((one) => valueAt(value, `/${one}`) !== undefined);
    if (valueAt(value, "/id") !== undefined || !key) return ownId(value);
    return usualId(key, valueAt(value, `/${key}`) as string | number, (valueAt(value, "/face") as Compass) ?? null);
  };
  return new Set([...idsOf("/transceivers/rails", ownId), ...idsOf("/transceivers/on", onFaces)]);
}

/** At the height that is wanted, or near the upper edge of a lower fixture. */
const heightOn = ({ height = Infinity }: Carrier, z: number): number =>
  Math.min(z, Math.max(height - 0.1, 0.5 * height));

export function addFaces(builder: EditBuilder, site: Site, carrier: Carrier, form: FacesForm): string {
  const face = form.isAround ? null : carrier.face;
  const usual = usualId(carrier.key, carrier.name, face);
  const taken = beginnings(builder.json);
  const member: JsonObject = {
    type: form.type,
    ...(taken.has(usual) ? { id: nextId(`${usual}-1`, taken) } : {}),
    [carrier.key]: carrier.name,
    ...(face === null ? {} : { face }),
    z: inFile(site, heightOn(carrier, form.z)),
    spacing: inFile(site, form.spacing),
    ...(form.tilt === 0 ? {} : { tilt_deg: form.tilt }),
  };
  return builder.append("/transceivers/on", member);
}
