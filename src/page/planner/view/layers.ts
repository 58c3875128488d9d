// Which kinds of elements and which shelf levels are shown, and which kinds are locked. The browser remembers it.

import type { Changes } from "../changes";
import type { ElementKind } from "../elements/kinds";

export type Layer = ElementKind | "names";

export const layers: Layer[] = [
  "names",
  "unit",
  "label",
  "fixture",
  "wall",
  "zone",
  "room",
  "area",
  "grid",
  "rail",
  "faces",
  "keep_out",
];

interface Stored {
  hidden: Layer[];
  locked: Layer[];
  levels: number[];
  lockedLevels: number[];
}

export class Layers {
  private hidden = new Set<Layer>();
  private locked = new Set<Layer>();
  private hiddenLevels = new Set<number>();
  private lockedLevels = new Set<number>();
  private key = "";

  constructor(private readonly changes: Changes) {}

  /** Restores the layers of a project. */
  open(project: string): void {
    this.key = `shelfbeam.layers.${project}`;
    try {
      const stored = JSON.parse(localStorage.getItem(this.key) ?? "{}") as Partial<Stored>;
      this.hidden = new Set(stored.hidden);
      this.locked = new Set(stored.locked);
      this.hiddenLevels = new Set(stored.levels);
      this.lockedLevels = new Set(stored.lockedLevels);
    } catch {
      // Without a memory, everything is shown.
    }
    this.changes.note("layers");
  }

  isShown(layer: Layer): boolean {
    return !this.hidden.has(layer);
  }

  isLocked(layer: Layer): boolean {
    return this.locked.has(layer);
  }

  /** Whether elements of a kind can be selected. */
  isFree(kind: ElementKind): boolean {
    return this.isShown(kind) && !this.isLocked(kind);
  }

  isLevelShown(level: number): boolean {
    return !this.hiddenLevels.has(level);
  }

  isLevelLocked(level: number): boolean {
    return this.lockedLevels.has(level);
  }

  /** Whether labels of a level can be selected. */
  isLevelFree(level: number): boolean {
    return this.isLevelShown(level) && !this.isLevelLocked(level);
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

  showLevel(level: number, shown: boolean): void {
    if (shown) this.hiddenLevels.delete(level);
    else this.hiddenLevels.add(level);
    this.store();
  }

  lockLevel(level: number, locked: boolean): void {
    if (locked) this.lockedLevels.add(level);
    else this.lockedLevels.delete(level);
    this.store();
  }

  showAll(): void {
    this.hidden.clear();
    this.hiddenLevels.clear();
    this.store();
  }

  private store(): void {
    const stored: Stored = {
      hidden: [...this.hidden],
      locked: [...this.locked],
      levels: [...this.hiddenLevels],
      lockedLevels: [...this.lockedLevels],
    };
    try {
      localStorage.setItem(this.key, JSON.stringify(stored));
    } catch {
      // Private windows may refuse to remember.
    }
    this.changes.note("layers");
  }
}
