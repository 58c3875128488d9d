// The file and the section `planogram` of the store for the lines of a planogram.

import { isObject, type Json, type JsonObject } from "../document/json";
import { csvText } from "../table/write";
import type { Place } from "./check";
import type { Mapping } from "./mapping";
import { lengthOf, type Shop } from "./shop";

/** A person before the back or the left side has the end of the fixture on the left. */
const isMirrored = ({ face }: Place): boolean => face === "back" || face === "left";

const edgeOf = ({ holder, face, level }: Place): string => [holder.id, face, level].join("\n");

/** Positions and distances from the beginning of the fixture. */
function alongFixtures(places: readonly Place[], { measure, fromLeft, columns }: Mapping): number[] {
  if (!fromLeft) return places.map(({ place }) => place);
  const isDistance = measure !== "position" && columns.place !== undefined;
  const counts = new Map<string, number>();
  for (const place of places) counts.set(edgeOf(place), Math.max(counts.get(edgeOf(place)) ?? 0, place.place));
  return places.map((one) => {
    if (!isMirrored(one)) return one.place;
    return isDistance
      ? lengthOf(one.holder, one.face) - one.place
      : (counts.get(edgeOf(one)) as number) + 1 - one.place;
  });
}

/** In the unit of the store, rounded to a place on the fixture. */
function distanceIn(factor: number, metres: number, length: number): number {
  const step = 1e-6;
  const rounded = Number((metres / factor).toFixed(6));
  return rounded * factor > length ? rounded - step : Math.max(rounded, 0);
}

function fileOfFixtures(places: readonly Place[], mapping: Mapping, { unit }: Shop): string {
  const isDistance = mapping.measure !== "position" && mapping.columns.place !== undefined;
  const along = alongFixtures(places, mapping);
  return csvText(
    ["article", "fixture", "face", "level", isDistance ? "x" : "position", "type", "hook", "tilt_deg", "description"],
    places.map((one, k) => [
      one.article,
      one.holder.id,
      one.face,
      one.level,
      isDistance ? distanceIn(unit.factor, along[k], lengthOf(one.holder, one.face)) : along[k],
      one.type,
      one.hook === undefined ? undefined : one.hook / unit.factor,
      one.tilt,
      one.description,
    ]),
    5,
  );
}

function fileOfSegments(places: readonly Place[], { unit }: Shop): string {
  return csvText(
    [
      "article",
      "segment",
      "shelf",
      "sequence",
      "planogram",
      "width",
      "facings",
      "type",
      "hook",
      "tilt_deg",
      "description",
    ],
    places.map((one) => [
      one.article,
      one.segment,
      one.level,
      one.place,
      one.planogram,
      one.width,
      one.facings,
      one.type,
      one.hook === undefined ? undefined : one.hook / unit.factor,
      one.tilt,
      one.description,
    ]),
    4,
  );
}

export const fileOf = (places: readonly Place[], mapping: Mapping, shop: Shop): string =>
  mapping.form === "segments" ? fileOfSegments(places, shop) : fileOfFixtures(places, mapping, shop);

interface Group {
  place: Place;
  segments: Set<number>;
}

const mostListed = 100; // segments of a member

/** Planograms on the same face stand beside each other, in the order of the file, by their numbers of segments. */
function spanOf(group: Group, all: readonly Group[], factor: number): JsonObject {
  const { holder, face } = group.place;
  const beside = all.filter(({ place }) => place.holder === holder && place.face === face);
  const count = (groups: readonly Group[]) => groups.reduce((sum, { segments }) => sum + segments.size, 0);
  const length = lengthOf(holder, face);
  const at = beside.indexOf(group);
  const end = (behind: number) => distanceIn(factor, (length * count(beside.slice(0, behind))) / count(beside), length);
  return {
    ...(at === 0 ? {} : { from: end(at) }),
    ...(at === beside.length - 1 ? {} : { to: end(at + 1) }),
  };
}

/** Members of `segments`: the segments of a planogram that share a face, from the left. */
function membersOf(places: readonly Place[], { first, fromTop }: Mapping, { unit }: Shop): JsonObject[] {
  const groups = new Map<string, Group>();
  for (const place of places) {
    const key = [place.planogram, place.holder.id, place.face].join("\n");
    const group = groups.get(key) ?? { place, segments: new Set() };
    groups.set(key, group);
    group.segments.add(place.segment);
  }
  const all = [...groups.values()];
  return all.map((group) => ({
    ...(group.place.planogram === "" ? {} : { planogram: group.place.planogram }),
    ...(group.segments.size > mostListed ? {} : { segments: [...group.segments].sort((a, b) => a - b) }),
    fixture: group.place.holder.id,
    face: group.place.face,
    ...spanOf(group, all, unit.factor),
    ...(first === 1 ? {} : { first_shelf: first }),
    ...(fromTop ? { from_top: true } : {}),
  }));
}

/** `before`: the present section, whose mountings of labels stay. */
export function sectionOf(
  file: string,
  places: readonly Place[],
  mapping: Mapping,
  shop: Shop,
  before: Json | undefined,
): JsonObject {
  const { segments: _segments, ...kept } = isObject(before) ? before : {};
  return {
    ...kept,
    file,
    type: mapping.type,
    ...(mapping.form === "segments" ? { segments: membersOf(places, mapping, shop) } : {}),
  };
}

/** The fixtures of the lines that have labels by themselves, by path; a null takes the place of those of a preset. */
export function ownLabels(places: readonly Place[]): Map<string, null | undefined> {
  const found = new Map<string, null | undefined>();
  for (const { holder } of places)
    if (holder.labels) found.set(holder.path, holder.labels === "preset" ? null : undefined);
  return found;
}
