// What is at a point of the plan, and what a rectangle contains. Hidden and locked kinds are never found.

import type { StoreDocument } from "../document/document";
import type { Devices } from "../document/devices";
import type { Part, Point } from "../document/messages";
import type { Bounds } from "../geometry/bounds";
import { isWithin } from "../geometry/bounds";
import { area, contains, distanceTo, isInside, touches } from "../geometry/polygon";
import { distance } from "../geometry/vector";
import type { UnitMover } from "../units/mover";
import type { Fan } from "./fan";
import { levelOf, type Layers } from "./layers";
import type { Item } from "./selection";

/** Kinds that are found at their lines only, because other elements lie inside them. */
const lineKinds = new Set<Part["kind"]>(["room", "zone", "area", "rail", "grid", "faces", "opening", "plane"]);

export const isOpenLine = ({ kind }: Part): boolean => kind === "rail" || kind === "opening";

export function itemOf(part: Part): Item {
  return part.locked || part.path === null
    ? { kind: "copy", key: part.key, path: part.path }
    : { kind: "element", path: part.path };
}

export function deviceItem(devices: Devices, index: number): Item {
  const path = devices.pathOf(index);
  return path !== null && devices.isListed(index)
    ? { kind: "element", path }
    : { kind: "device", device: devices.kind, index, path };
}

/** Whether a label or unit can be selected. */
export const isDeviceFree = ({ kind, state }: Devices, index: number, layers: Layers): boolean =>
  layers.isFree(kind) && (kind !== "label" || layers.isFree(levelOf(state[index])));

/** Marks that other elements make lie close together, and often above fixtures: they are found only from near. */
const derivedShare = 0.5;

/** What can be seen of the store. */
export interface Sight {
  document: StoreDocument;
  layers: Layers;
  fan: Fan;
  mover: Pick<UnitMover, "shown">;
}

function nearestDevice(devices: Devices, point: Point, reach: number, sight: Sight): [number, number] | null {
  const { layers, fan } = sight;
  const moved = devices.kind === "unit" ? sight.mover.shown : null;
  let found: [number, number] | null = null;
  const { position, count } = devices;
  const farthest = reach + fan.reach;
  for (let index = 0; index < count; ++index) {
    const at = index === moved?.index ? moved.mount.position : null;
    if (!at && Math.abs(position[3 * index] - point[0]) > farthest) continue;
    if (!at && Math.abs(position[3 * index + 1] - point[1]) > farthest) continue;
    const place: Point = at ? [at[0], at[1]] : fan.place(devices, index);
    const away = distance(place, point) / (devices.stands(index) ? 1 : derivedShare);
    if (away > (found?.[1] ?? reach) || (devices.kind === "label" && fan.isCovered(index))) continue;
    if (isDeviceFree(devices, index, layers)) found = [index, away];
  }
  return found;
}

/** The label or unit at a point. */
function deviceAt(sight: Sight, point: Point, reach: number): Item | null {
  const { document, layers } = sight;
  const near = [document.units, document.labels]
    .filter(({ kind }) => layers.isFree(kind))
    .flatMap((devices) => {
      const found = nearestDevice(devices, point, reach, sight);
      return found ? [{ devices, index: found[0], away: found[1] }] : [];
    })
    .sort((a, b) => a.away - b.away);
  return near.length > 0 ? deviceItem(near[0].devices, near[0].index) : null;
}

/** The outline at a point: of those with the point inside, the smallest. */
export function partAt(parts: readonly Part[], point: Point, reach: number, layers: Layers): Part | null {
  let [found, rank] = [null as Part | null, Infinity];
  for (const part of parts) {
    if (!layers.isFree(part.kind) || part.outline.length === 0) continue;
    const isLine = lineKinds.has(part.kind);
    const outlines = [part.outline, ...(part.holes ?? [])];
    const isOn = outlines.some((outline) => distanceTo(outline, point, isOpenLine(part)) <= reach);
    if (!isOn && (isLine || !contains(part.outline, point))) continue;
    // Lines come after surfaces, unless the point is on the line alone.
    // An opening has no area, so it comes before the room.
    const own = isLine ? 1e9 + area(part.outline) : area(part.outline);
    if (own < rank) [found, rank] = [part, own];
  }
  return found;
}

/** `reach`: m. Labels and units lie above everything else. */
export function itemAt(sight: Sight, point: Point, reach: number): Item | null {
  const device = deviceAt(sight, point, reach);
  if (device) return device;
  const part = partAt(sight.document.parts.all, point, 0.6 * reach, sight.layers);
  return part && itemOf(part);
}

/** The elements with outlines that can be selected together. */
export function freePaths(document: StoreDocument, layers: Layers): string[] {
  const free = document.parts.all.filter(({ kind }) => kind !== "room" && layers.isFree(kind));
  return [...new Set(free.flatMap(({ path }) => path ?? []))];
}

/** The elements in a rectangle: those that lie inside, or also those that it touches. */
export function itemsWithin(document: StoreDocument, layers: Layers, bounds: Bounds, isTouching: boolean): Item[] {
  const isCaught = (part: Part) =>
    isTouching && !lineKinds.has(part.kind)
      ? touches(part.outline, bounds, isOpenLine(part))
      : isInside(part.outline, bounds);
  // A row is caught if all its copies lie inside, or if one of them is touched.
  const paths = freePaths(document, layers).filter((path) => {
    const copies = document.parts.of(path);
    return isTouching ? copies.some(isCaught) : copies.every(isCaught);
  });
  const devices = [document.units, document.labels]
    .filter(({ kind }) => layers.isFree(kind))
    .flatMap((list) => {
      const found: Item[] = [];
      for (let index = 0; index < list.count; ++index) {
        const [x, y] = list.at(index);
        if (list.isListed(index) && isWithin([x, y], bounds) && isDeviceFree(list, index, layers))
          found.push(deviceItem(list, index));
      }
      return found;
    });
  return [...paths.map((path): Item => ({ kind: "element", path })), ...devices];
}
