// What a form knows about the values of an element.

import type { Json } from "../document/json";

/** What a number measures: a length in the unit of the file, an angle, another unit of measure, or nothing. */
export type Measure = "length" | "degrees" | "m" | "nm" | "dB" | "1/m" | "none";

/** The names that a value chooses from. */
export type NameList = "materials" | "label_types" | "transceiver_types" | "presets" | "fixtures" | "walls" | "areas";

export type FieldType =
  | { kind: "number"; measure: Measure; isInteger: boolean; least: number; most: number }
  | { kind: "flag" }
  | { kind: "text" }
  | { kind: "choice"; values: string[] }
  | { kind: "constant"; value: Json }
  | { kind: "name"; of: NameList }
  | { kind: "vector"; size: number; measure: Measure }
  | { kind: "numbers"; measure: Measure }
  | { kind: "points"; size: number; measure: Measure }
  | { kind: "set"; values: string[] }
  | { kind: "map"; value: FieldType; keys: "levels" | "walls" | "sides" | "patterns" }
  | { kind: "list"; item: Group }
  | { kind: "group"; group: Group }
  | { kind: "either"; options: FieldType[] }
  | { kind: "json" };

export interface Field {
  key: string;
  type: FieldType;
  isRequired: boolean;
  /** In m, if it is a length. */
  default: Json | undefined;
  description: string;
}

/** Keys of an object; `alternatives` are sets of keys of which exactly one is present. */
export interface Variant {
  /** The value of `type`, or the key that tells it from the other variants. */
  name: string;
  fields: Field[];
  required: string[];
  alternatives: string[][];
}

export interface Group {
  /** Several if the object has several forms. */
  variants: Variant[];
  /** Whether the key `type` tells them apart. */
  isTyped: boolean;
}
