// What the tools draw with: the values that were used last.

import type { Changes } from "../changes";
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
}

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
};

export class ToolSettings {
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
