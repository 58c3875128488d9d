// What was read with a reservation, counted by kind and name.

import type { DxfNote, DxfNoteCode } from "./drawing";

/** Further names are counted together. */
const mostNames = 100;

export class Notes {
  private readonly found = new Map<DxfNoteCode, Map<string | null, DxfNote>>();

  add(code: DxfNoteCode, name: string | null = null, count = 1): void {
    const names = this.found.get(code) ?? new Map<string | null, DxfNote>();
    this.found.set(code, names);
    const key = names.has(name) || names.size < mostNames ? name : null;
    const note = names.get(key);
    if (note) note.count += count;
    else names.set(key, { code, name: key, count });
  }

  count(code: DxfNoteCode): number {
    return this.list().reduce((sum, note) => sum + (note.code === code ? note.count : 0), 0);
  }

  list(): DxfNote[] {
    return [...this.found.values()].flatMap((names) => [...names.values()]);
  }
}
