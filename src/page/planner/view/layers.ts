// Which kinds of elements and which shelf levels are shown, and which kinds are locked. The browser remembers it.

import type { Changes } from "../changes";
import type { ElementKind } from "../elements/kinds";

/** A shelf level of labels. */
export type Level = `level-${number}`;
export type Layer = ElementKind | "names" | Level;

/** A level by its number from 0, the lowest first. */
export const levelOf = (number: number): Level => `level-${number}`;

/** All but the levels, which depend on the store. */
export const layers: Exclude<Layer, Level>[] = [
  "names",
  "unit",
  "label",
  "fixture",
  "wall",
  "opening",
  "zone",
  "room",
  "plane",
  "area",
  "grid",
  "rail",
  "faces",
  "keep_out",
];

interface Stored {
  hidden: Layer[];
  locked: Layer[];
}

export class Layers {
  private hidden = new Set<Layer>();
  private locked = new Set<Layer>();
  private key = "";

  constructor(private readonly changes: Changes) {}

  /** Restores the layers of a project. */
  open(project: string): void {
    this.key = `shelfbeam.layers.${project}`;
    try {
      const stored = JSON.parse(localStorage.getItem(this.key) ?? "{}") as Partial<Stored>;
      this.hidden = new Set(stored.hidden);
      this.locked = new Set(stored.locked);
    } catch {
      // Without a memory, everything is shown.
    }
    this.changes.note("layers");
  }

  isShown(layer: Layer): boolean {
    return !this.hidden.has(layer);
  }

  get hidesSome(): boolean {
    return this.hidden.size > 0;
  }

  isLocked(layer: Layer): boolean {
    return this.locked.has(layer);
  }

  /** Whether elements of a kind, or labels of a level, can be selected. */
  isFree(layer: Layer): boolean {
    return this.isShown(layer) && !this.isLocked(layer);
  }

  show(layer: Layer, shown: boolean): void {
    if (shown) this.hidden.delete(layer);
    else this.hidden.add(layer);
    this.store();
  }

  lock(layer: Layer, locked: boolean): void {
    if (locked) this.locked.add(layer);
    else this.locked.delete(layer);
    this.store();
  }

  showAll(): void {
    this.hidden.clear();
    this.store();
  }

  private store(): void {
    const stored: Stored = { hidden: [...this.hidden], locked: [...this.locked] };
    try {
      localStorage.setItem(this.key, JSON.stringify(stored));
    } catch {
      // Private windows may refuse to remember.
    }
    this.changes.note("layers");
  }
}
