// The outlines that the server resolved, with the changes that it does not know yet.

import type { Part } from "./messages";
import type { Preview } from "./preview";

export class Parts {
  private resolved = new Map<string, Part>();
  private shown: Part[] = [];
  private byPath = new Map<string, Part[]>();

  replaceAll(parts: readonly Part[]): void {
    this.resolved = new Map(parts.map((part) => [part.key, part]));
  }

  change({ set, remove }: { set: readonly Part[]; remove: readonly string[] }): void {
    for (const key of remove) this.resolved.delete(key);
    for (const part of set) this.resolved.set(part.key, part);
  }

  /** `place`: the present place of an element that the server knows at a path; null if it is removed. */
  show(preview: Preview, place: (path: string) => string | null): void {
    this.shown = [];
    this.byPath = new Map();
    for (const [key, part] of this.resolved) {
      const path = part.path === null ? null : place(part.path);
      if (preview.hidden.has(key) || (part.path !== null && path === null)) continue;
      const shown = preview.parts.get(key) ?? part;
      this.add(shown.path === path ? shown : { ...shown, path });
    }
    for (const part of preview.added) this.add(part);
  }

  private add(part: Part): void {
    this.shown.push(part);
    if (part.path === null) return;
    const list = this.byPath.get(part.path);
    if (list) list.push(part);
    else this.byPath.set(part.path, [part]);
  }

  get all(): readonly Part[] {
    return this.shown;
  }

  /** The parts of an element: one, or its copies. */
  of(path: string): readonly Part[] {
    return this.byPath.get(path) ?? [];
  }

  withKey(key: string): Part | undefined {
    return this.shown.find((part) => part.key === key);
  }
}
