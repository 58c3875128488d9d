// Reads the fields of an element from the JSON Schema of the store, which the program writes from its readers.

import schema from "../../../../data/store.schema.json";
import { isObject, type Json, type JsonObject } from "../document/json";
import type { ElementKind } from "../elements/kinds";
import type { TypeList } from "../elements/types";
import type { Field, FieldType, Group, Measure, NameList, Variant } from "./field";

const definitions = schema.$defs as unknown as Record<string, JsonObject>;

/** Keys that the planner does not show. */
const omitted = new Set([
  "$schema",
  "format",
  "units",
  "ignore",
  "variation",
  "parts",
  "catalogues",
  "zones",
  "inner_walls",
  "drawing",
]);

/** Keys of numbers in the unit of the file that the schema gives as plain numbers. */
const lengthKeys = new Set(
  "at bottom below_ceiling depth from gap height length offset position positions radius shelves size thickness".split(
    " ",
  ),
);

const unitSuffixes: [string, Measure][] = [
  ["_deg", "degrees"],
  ["_nm", "nm"],
  ["_per_m", "1/m"],
  ["_m", "m"],
  ["_db", "dB"],
];

export function measureOf(key: string): Measure {
  const suffix = unitSuffixes.find(([end]) => key.endsWith(end));
  return suffix ? suffix[1] : lengthKeys.has(key) ? "length" : "none";
}

/** Definitions with a meaning that their structure does not show. */
const known: Record<string, FieldType> = {
  length: { kind: "number", measure: "length", isInteger: false, least: -Infinity, most: Infinity },
  coordinate: { kind: "number", measure: "length", isInteger: false, least: -Infinity, most: Infinity },
  plan_point: { kind: "vector", size: 2, measure: "length" },
  point: { kind: "vector", size: 3, measure: "length" },
  direction: { kind: "vector", size: 3, measure: "none" },
  polygon: { kind: "points", size: 2, measure: "length" },
  axes: { kind: "points", size: 3, measure: "none" },
  material_name: { kind: "name", of: "materials" },
  name: { kind: "text" },
  label_size: { kind: "vector", size: 2, measure: "length" },
  area: {
    kind: "either",
    options: [
      { kind: "name", of: "areas" },
      { kind: "points", size: 2, measure: "length" },
    ],
  },
};

/** The lists of names by key; `type` is the name of a type of devices. */
const nameKeys: Record<string, NameList> = {
  preset: "presets",
  fixture: "fixtures",
  inner_wall: "walls",
  hears: "transceiver_types",
};

/** Where the schema is read: it decides the types that `type` names. */
interface Place {
  key: string;
  ofUnits: boolean;
}

function definitionOf(ref: string): string {
  return ref.slice(ref.lastIndexOf("/") + 1);
}

/** A schema with its reference replaced by what it refers to. */
function resolved(part: JsonObject): JsonObject {
  const { $ref, ...own } = part;
  return typeof $ref === "string" ? { ...resolved(definitions[definitionOf($ref)]), ...own } : part;
}

const objectsIn = (value: Json | undefined): JsonObject[] => (Array.isArray(value) ? value.filter(isObject) : []);
const textsIn = (value: Json | undefined): string[] => (Array.isArray(value) ? value.map(String) : []);

function numberType(part: JsonObject, key: string): FieldType {
  return {
    kind: "number",
    measure: measureOf(key),
    isInteger: part.type === "integer",
    // Limits of lengths are wide enough for every unit: the server checks them.
    least: measureOf(key) === "length" ? -Infinity : Number(part.minimum ?? -Infinity),
    most: measureOf(key) === "length" ? Infinity : Number(part.maximum ?? Infinity),
  };
}

function arrayType(part: JsonObject, place: Place): FieldType {
  if (!isObject(part.items)) return { kind: "json" };
  const ref = typeof part.items.$ref === "string" ? definitionOf(part.items.$ref) : "";
  const items = resolved(part.items);
  const size = part.minItems === part.maxItems ? Number(part.maxItems) : 0;
  if (Array.isArray(items.enum)) return { kind: "set", values: textsIn(items.enum) };
  const inner = known[ref];
  if (inner?.kind === "vector") return { kind: "points", size: inner.size, measure: inner.measure };
  if (inner?.kind === "points") return { kind: "json" };
  if (items.type === "number" || items.type === "integer") {
    const measure = inner?.kind === "number" ? inner.measure : measureOf(place.key);
    return size === 2 || size === 3 ? { kind: "vector", size, measure } : { kind: "numbers", measure };
  }
  if (items.type === "object" || items.oneOf) return { kind: "list", item: groupOf(items, place.ofUnits) };
  return { kind: "json" };
}

const mapKeys: Record<string, "levels" | "walls" | "sides" | "patterns"> = {
  level_types: "levels",
  wall_materials: "walls",
  stocking: "sides",
  materials: "patterns",
};

function objectType(part: JsonObject, place: Place): FieldType {
  const inner = part.additionalProperties;
  if (isObject(part.properties) || part.oneOf) return { kind: "group", group: groupOf(part, place.ofUnits) };
  if (!isObject(inner)) return { kind: "json" };
  // The values of a map of types have no key of their own.
  const value = typeOf(inner, { ...place, key: place.key === "level_types" ? "type" : "" });
  return { kind: "map", value, keys: mapKeys[place.key] ?? "patterns" };
}

function choiceType(part: JsonObject, place: Place): FieldType {
  const options = objectsIn(part.oneOf);
  if (options.every((option) => resolved(option).properties)) return objectType(part, place);
  const types = options
    .map((option) => typeOf(option, place))
    // 0 is a number like the others.
    .filter((type) => type.kind !== "constant" || type.value !== 0);
  return types.length === 1 ? types[0] : { kind: "either", options: types };
}

function typeOf(part: JsonObject, place: Place): FieldType {
  if (typeof part.$ref === "string" && known[definitionOf(part.$ref)]) return known[definitionOf(part.$ref)];
  const own = resolved(part);
  if (own.const !== undefined) return { kind: "constant", value: own.const };
  if (Array.isArray(own.enum)) return { kind: "choice", values: textsIn(own.enum) };
  if (own.type === "number" || own.type === "integer") return numberType(own, place.key);
  if (own.type === "boolean") return { kind: "flag" };
  if (own.type === "array") return arrayType(own, place);
  if (own.type === "object") return objectType(own, place);
  if (own.oneOf) return choiceType(own, place);
  if (own.type !== "string") return { kind: "json" };
  if (place.key === "type") return { kind: "name", of: place.ofUnits ? "transceiver_types" : "label_types" };
  const of = nameKeys[place.key];
  return of ? { kind: "name", of } : { kind: "text" };
}

function variantOf(part: JsonObject, ofUnits: boolean): Variant {
  const properties = isObject(part.properties) ? part.properties : {};
  const required = textsIn(part.required);
  const fields = Object.entries(properties).flatMap(([key, own]): Field[] => {
    if (omitted.has(key) || !isObject(own)) return [];
    return [
      {
        key,
        type: typeOf(own, { key, ofUnits }),
        isRequired: required.includes(key),
        default: resolved(own).default,
        description: String(own.description ?? resolved(own).description ?? ""),
      },
    ];
  });
  const alternatives = objectsIn(part.oneOf).map((option) => textsIn(option.required));
  const type = isObject(properties.type) ? (properties.type.const ?? textsIn(properties.type.enum)[0]) : undefined;
  return { name: String(type ?? ""), fields, required, alternatives: alternatives.filter((keys) => keys.length > 0) };
}

/** The key that a variant requires and the others do not have. */
function ownKey(variant: Variant, others: readonly Variant[]): string {
  const has = ({ fields }: Variant, key: string) => fields.some((field) => field.key === key);
  return variant.required.find((key) => others.every((other) => other === variant || !has(other, key))) ?? "";
}

function groupOf(part: JsonObject, ofUnits: boolean): Group {
  const options = objectsIn(part.oneOf).map(resolved);
  if (isObject(part.properties) && !options.some((option) => isObject(option.properties)))
    return { variants: [variantOf(part, ofUnits)], isTyped: false };
  // A type that several names select (ies and eulumdat) is one variant for each name.
  const variants = options.flatMap((option) => {
    const type = isObject(option.properties) && isObject(option.properties.type) ? option.properties.type : {};
    const variant = variantOf(option, ofUnits);
    return Array.isArray(type.enum) ? textsIn(type.enum).map((name) => ({ ...variant, name })) : [variant];
  });
  const isTyped = new Set(variants.map(({ name }) => name)).size === variants.length;
  return {
    variants: isTyped ? variants : variants.map((variant) => ({ ...variant, name: ownKey(variant, variants) })),
    isTyped,
  };
}

const elementDefinitions: Record<Exclude<ElementKind, "fixture">, string> = {
  room: "room",
  zone: "zones",
  wall: "inner_walls",
  opening: "openings",
  label: "label",
  plane: "measuring_plane",
  unit: "transceiver",
  grid: "grid",
  area: "mount_area",
  rail: "mount_rail",
  faces: "mount_faces",
  keep_out: "keep_out",
};

const unitKinds = new Set<string>(["unit", "grid", "area", "rail", "faces"]);

const groups = new Map<string, Group>();

function cached(name: string, make: () => Group): Group {
  const group = groups.get(name) ?? make();
  groups.set(name, group);
  return group;
}

/** `fixtureType`: of a fixture. Null for an unknown type. */
export function groupOfElement(kind: ElementKind, fixtureType: string): Group | null {
  const name = kind === "fixture" ? fixtureType : elementDefinitions[kind];
  const definition = definitions[name];
  if (!definition) return null;
  const part = isObject(definition.items) ? definition.items : definition;
  return cached(name, () => {
    const group = groupOf(part, unitKinds.has(kind));
    return kind === "fixture" ? withPreset(group) : kind === "room" ? without(group, "openings") : group;
  });
}

/** Openings of outer walls are elements of their own, unlike those of an inner wall. */
function without(group: Group, key: string): Group {
  const variants = group.variants.map((variant) => ({
    ...variant,
    fields: variant.fields.filter((field) => field.key !== key),
  }));
  return { ...group, variants };
}

/** A fixture may also name a preset, which the definitions of the types leave out. */
function withPreset(group: Group): Group {
  const field: Field = {
    key: "preset",
    type: { kind: "name", of: "presets" },
    isRequired: false,
    default: undefined,
    description: "",
  };
  const variants = group.variants.map((variant) => ({ ...variant, fields: [field, ...variant.fields] }));
  return { ...group, variants };
}

/** A preset has the keys of the fixtures of its type, none of them required. */
export function groupOfType(list: TypeList, fixtureType: string): Group | null {
  if (list === "presets") return groupOfElement("fixture", fixtureType);
  const name = { materials: "material", label_types: "label_type", transceiver_types: "transceiver_type" }[list];
  return cached(name, () => groupOf(definitions[name], list === "transceiver_types"));
}

/** The keys of the store itself. */
export function groupOfStore(): Group {
  const { name, language, currency, wavelength_nm } = schema.properties as unknown as JsonObject;
  const part = { type: "object", properties: { name, language, currency, wavelength_nm } };
  return cached("store", () => groupOf(part, false));
}
