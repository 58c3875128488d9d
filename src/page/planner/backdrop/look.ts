// How the picture of the floor plan looks, and whether it can be moved. The browser remembers it.

import type { Changes } from "../changes";

interface Stored {
  isShown: boolean;
  isLocked: boolean;
  isGrey: boolean;
  /** Light drawings on dark ground become dark on light, so that what is drawn over them is visible. */
  isInverted: boolean;
  /** From 0, as it is, to 1, invisible. */
  fade: number;
  /** By the file of a drawing and the names of its layers, where a person has decided: whether they are shown. */
  layers: Readonly<Record<string, Readonly<Record<string, boolean>>>>;
}

const usual: Stored = { isShown: true, isLocked: true, isGrey: false, isInverted: false, fade: 0.3, layers: {} };

export class Look {
  private state = usual;
  private key = "";

  constructor(private readonly changes: Changes) {}

  /** Restores the look in a project. */
  open(project: string): void {
    this.key = `shelfbeam.picture.${project}`;
    try {
      this.state = { ...usual, ...(JSON.parse(localStorage.getItem(this.key) ?? "{}") as Partial<Stored>) };
    } catch {
      // Without a memory, it looks as usual.
    }
    this.changes.note("layers");
  }

  get now(): Readonly<Stored> {
    return this.state;
  }

  /** Whether layers of a drawing are shown, by their names. */
  layersOf(file: string): Readonly<Record<string, boolean>> {
    return this.state.layers[file] ?? {};
  }

  decideLayers(file: string, decided: Readonly<Record<string, boolean>>): void {
    this.set({ layers: { ...this.state.layers, [file]: { ...this.layersOf(file), ...decided } } });
  }

  set(changed: Partial<Stored>): void {
    this.state = { ...this.state, ...changed };
    try {
      localStorage.setItem(this.key, JSON.stringify(this.state));
    } catch {
      // Private windows may refuse to remember.
    }
    // The slider of the fade stays under the pointer; the other controls are built again.
    this.changes.note(Object.keys(changed).join() === "fade" ? "picture" : "layers");
  }
}
