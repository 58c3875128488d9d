// What the tools draw with: the values that were used last.

import type { Changes } from "../changes";
import type { JsonObject } from "../document/json";
import type { Purpose } from "./materials";

export type OpeningKind = "door" | "window" | "open";

/** Lengths in m. */
export interface Settings {
  preset: string | null;
  /** The next fixture is like the selected one. */
  isLike: boolean;
  thickness: number;
  zoneHeight: number;
  opening: OpeningKind;
  doorHeight: number;
  sill: number;
  lintel: number;
  blockHeight: number;
  /** The block is a column up to the ceiling. */
  isColumn: boolean;
  /** By purpose. */
  materials: { [Key in Purpose]?: string };
  spacing: number;
  /** Of rows. */
  count: number;
  /** Null: the first type of the store. */
  unitType: string | null;
  /** Of units below the ceiling: degrees from straight down, and to which side, clockwise from north. */
  unitTilt: number;
  heading: number;
  /** Of units on faces: degrees downwards from the horizontal. */
  faceTilt: number;
  /** Whether rails and faces attract units. */
  attracts: boolean;
  /** Whether placed units are mounted already. */
  isInstalled: boolean;
  /** Null: the next free one. */
  railId: string | null;
  /** Of rails: below the ceiling. */
  below: number;
  railSpacing: number;
  /** Whether candidates are on all faces, or on the one at the pointer. */
  isAround: boolean;
  faceHeight: number;
  faceSpacing: number;
}

export type AngleKey = "unitTilt" | "heading" | "faceTilt";

export type LengthKey = Exclude<
  { [Key in keyof Settings]: Settings[Key] extends number ? Key : never }[keyof Settings],
  AngleKey | "count"
>;

const usual: Settings = {
  preset: null,
  isLike: true,
  thickness: 0.12,
  zoneHeight: 2.6,
  opening: "door",
  doorHeight: 2.1,
  sill: 0.9,
  lintel: 2.1,
  blockHeight: 0.9,
  isColumn: false,
  materials: {},
  spacing: 1.2,
  count: 2,
  unitType: null,
  unitTilt: 0,
  heading: 0,
  faceTilt: 30,
  attracts: true,
  isInstalled: false,
  railId: null,
  below: 0.05,
  railSpacing: 0.5,
  isAround: true,
  faceHeight: 2.4,
  faceSpacing: 1,
};

/** A fixture that others are like. */
export interface Model {
  id: string;
  value: JsonObject;
}

export class ToolSettings {
  model: Model | null = null;
  private values = usual;

  constructor(private readonly changes: Changes) {}

  get now(): Settings {
    return this.values;
  }

  set(changed: Partial<Settings>): void {
    this.values = { ...this.values, ...changed };
    this.changes.note("tool", "preview");
  }
}
