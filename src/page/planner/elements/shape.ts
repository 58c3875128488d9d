// Which values of an element are positions, directions and angles: what a movement of the element changes.

import { isObject, pointerTo, type Json, type JsonObject } from "../document/json";
import type { ElementKind } from "./kinds";

/** Pointers are relative to the element. */
export interface Shape {
  /** [x, y] or [x, y, z]. */
  points: string[];
  /** Directions [x, y] or [x, y, z]. */
  vectors: string[];
  /** The keys of two opposite corners of a rectangle that stays parallel to the axes. */
  rectangle: boolean;
  /** The key of an angle about the vertical, counter-clockwise. */
  turn: string | null;
  /** Axes with the angle about them. */
  axes: { axes: string[]; roll: string } | null;
  /** Lengths along the fixture: a mirror image changes their sign. */
  steps: string[];
  /** Why it cannot be moved. */
  fixed: "room" | "follows" | null;
}

const fixedShape: Shape = {
  points: [],
  vectors: [],
  rectangle: false,
  turn: null,
  axes: null,
  steps: [],
  fixed: null,
};

const isPoint = (value: Json | undefined): boolean =>
  Array.isArray(value) && value.length >= 2 && value.every((number) => typeof number === "number");

/** The points at a key: one, or a list of them. */
function pointsAt(value: JsonObject, key: string): string[] {
  const found = value[key];
  if (!Array.isArray(found)) return [];
  const pointer = pointerTo("", key);
  if (isPoint(found)) return [pointer];
  return found.flatMap((inner, k) =>
    isPoint(inner)
      ? [pointerTo(pointer, k)]
      : Array.isArray(inner)
        ? inner.flatMap((point, n) => (isPoint(point) ? [pointerTo(pointer, k, n)] : []))
        : [],
  );
}

const axesOf = (value: JsonObject, key: "axis" | "axes"): Shape["axes"] => ({
  axes: pointsAt(value, key),
  roll: "/roll_deg",
});

function fixtureShape(value: JsonObject): Shape {
  const repeat = isObject(value.repeat) ? value.repeat : {};
  const stepsWith = (test: (step: Json | undefined) => boolean) =>
    ["step", "step2"].filter((key) => test(repeat[key])).map((key) => pointerTo("/repeat", key));
  const points = ["at", "polygon", "corners"].flatMap((key) => pointsAt(value, key));
  return {
    ...fixedShape,
    points,
    vectors: stepsWith(isPoint),
    steps: stepsWith((step) => typeof step === "number"),
    rectangle: points.length === 0 && isPoint(value.min),
    turn: value.type === "cylinder" || !isPoint(value.at) ? null : "/rotation_deg",
  };
}

/** `value`: the element with the keys of its presets. */
export function shapeOf(kind: ElementKind, value: JsonObject): Shape {
  const points = (...keys: string[]) => keys.flatMap((key) => pointsAt(value, key));
  switch (kind) {
    case "fixture":
      return fixtureShape(value);
    case "room":
      return { ...fixedShape, points: points("outline", "holes", "height"), fixed: value.outline ? null : "room" };
    case "zone":
      return { ...fixedShape, points: points("polygon", "height") };
    case "wall":
      return { ...fixedShape, points: points("from", "to") };
    case "label":
      return { ...fixedShape, points: points("position"), vectors: points("normal") };
    case "plane":
      return { ...fixedShape, points: points("origin"), vectors: points("axes", "normal") };
    case "unit":
      return { ...fixedShape, points: points("position"), axes: axesOf(value, "axis") };
    case "grid":
      return { ...fixedShape, rectangle: true, axes: axesOf(value, "axis") };
    case "area":
      return {
        ...fixedShape,
        points: points("area"),
        axes: axesOf(value, "axes"),
        fixed: Array.isArray(value.area) ? null : "follows",
      };
    case "rail":
      return { ...fixedShape, points: points("points"), axes: axesOf(value, "axes") };
    case "keep_out":
      return { ...fixedShape, points: points("polygon"), rectangle: value.polygon === undefined };
    case "faces":
    case "opening":
      return { ...fixedShape, fixed: "follows" };
  }
}
