// First values of keys that a person adds to an element.

import { isObject, valueAt, type Json, type JsonObject } from "../document/json";
import type { Part, SharedNames } from "../document/messages";
import { boundsOf } from "../geometry/bounds";
import { tidy, type LengthUnit } from "../geometry/units";
import { wholeTurn } from "../geometry/vector";
import type { FieldType, Group, NameList } from "./field";
import { fieldsOf } from "./variants";

/** What first values depend on. */
export interface Surroundings {
  json: Json;
  shared: SharedNames;
  unit: LengthUnit;
  part: Part | null;
  /** Those that a fixture or preset can have. */
  presets?: readonly string[];
}

/** The area of the room outside its zones. */
export const roomWithoutZones = "room without zones";

/** The names that a value can have. */
export function namesIn(json: Json, of: NameList, shared: SharedNames = {}): string[] {
  const keysOf = (pointer: string) => {
    const found = valueAt(json, pointer);
    return isObject(found) ? Object.keys(found) : [];
  };
  const idsOf = (pointer: string) => {
    const found = valueAt(json, pointer);
    return Array.isArray(found)
      ? found.flatMap((_, k) => (valueAt(found, `/${k}/id`) as string | undefined) ?? [])
      : [];
  };
  if (of === "fixtures") return idsOf("/fixtures");
  if (of === "walls") return idsOf("/room/inner_walls");
  if (of === "areas") {
    const zones = idsOf("/room/zones");
    return ["room", ...(zones.length > 0 ? [roomWithoutZones] : []), ...zones];
  }
  return [...new Set([...keysOf(`/${of}`), ...(shared[of] ?? [])])];
}

/** The place of the element as it is now, for keys that state it in another form. */
function placed(key: string, { unit, part }: Surroundings): Json | undefined {
  const bounds = part && boundsOf(part.outline);
  if (!part || !bounds) return undefined;
  const inFile = (metres: number) => tidy(metres / unit.factor, unit);
  const { lower, upper } = bounds;
  const isFlat = part.kind !== "fixture" && part.kind !== "room";
  const third = (metres: number) => (isFlat ? [] : [inFile(metres)]);
  const height = part.height ?? 1;
  const corner = part.footing?.at ?? lower;
  switch (key) {
    case "at":
      return [...corner.map(inFile), ...(part.type === "box" || part.type === "mesh" ? [0] : [])];
    case "size":
      return [part.footing?.length ?? upper[0] - lower[0], part.footing?.depth ?? upper[1] - lower[1], height].map(
        inFile,
      );
    case "rotation_deg":
      return wholeTurn(part.rotation ?? part.footing?.rotation ?? 0);
    case "min":
      return [...lower.map(inFile), ...third(0)];
    case "max":
      return [...upper.map(inFile), ...third(height)];
    case "polygon":
    case "outline":
    case "area":
      return part.outline.map((point) => point.map(inFile));
    case "height":
      return inFile(height);
    default:
      return undefined;
  }
}

/** Lengths that begin with nothing. */
const fromZero = new Set(["from", "gap", "shift", "bottom", "z", "at", "positions"]);

export function initialValue(type: FieldType, key: string, around: Surroundings): Json {
  const here = placed(key, around);
  if (here !== undefined && type.kind !== "list" && type.kind !== "name") return here;
  const { json, shared, unit } = around;
  const metre = tidy(1 / unit.factor, unit);
  switch (type.kind) {
    case "number":
      if (type.measure === "length") return fromZero.has(key) ? 0 : metre;
      return Math.min(Math.max(0, type.least), type.most);
    case "flag":
      return false;
    case "text":
      return key;
    case "choice":
      return type.values[0];
    case "constant":
      return type.value;
    case "name":
      return namesIn(json, type.of, shared)[0] ?? "";
    case "vector":
      return Array.from({ length: type.size }, (_, k) =>
        type.measure === "length" ? (fromZero.has(key) ? 0 : metre) : k === type.size - 1 ? 1 : 0,
      );
    case "numbers":
      return [type.measure === "length" ? metre : 0];
    case "points":
      return [0, 1, 2].map((k) =>
        Array.from({ length: type.size }, (_, axis) => (axis === 2 ? metre : k === axis + 1 ? metre : 0)),
      );
    case "set":
      return type.values.slice(0, 1);
    case "map":
      return {};
    case "list":
      return [];
    case "group":
      return initialObject(type.group, 0, around);
    case "either":
      return initialValue(type.options[0], key, around);
    case "json":
      return [];
  }
}

/** An object with the required keys of one of its forms. */
export function initialObject(group: Group, index: number, around: Surroundings): JsonObject {
  const variant = group.variants[index];
  const chosen = variant.alternatives[0] ?? [];
  const typed: JsonObject = group.isTyped ? { type: variant.name } : {};
  const keys = fieldsOf(variant, {}).filter(({ key, isRequired }) => isRequired || chosen.includes(key));
  const inner = { ...around, part: null };
  return { ...typed, ...Object.fromEntries(keys.map(({ key, type }) => [key, initialValue(type, key, inner)])) };
}
