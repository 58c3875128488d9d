// Collects the changes of one gesture. Changes are as small as possible, because the server replaces only the bytes of
// changed values, and leaves comments and layout between them as they are.

import { applyOps, child, equal, isObject, pointerTo, splitPointer, valueAt, type EditOp, type Json } from "./json";

/** One step of the history. */
export interface Edit {
  label: string;
  ops: readonly EditOp[];
  /** Whether it continues the step before it, if that has the same paths and is recent. */
  join?: boolean;
}

export class EditBuilder {
  readonly ops: EditOp[] = [];

  constructor(private root: Json) {}

  /** The store with all changes so far. */
  get json(): Json {
    return this.root;
  }

  get(pointer: string): Json | undefined {
    return valueAt(this.root, pointer);
  }

  /** Sets a value, or removes it if it is undefined. Missing objects on the way to it are made. */
  set(pointer: string, value: Json | undefined): void {
    const [parent, key] = splitPointer(pointer);
    const old = this.get(pointer);
    if (value === undefined) {
      if (old !== undefined) this.add({ path: pointer, before: old });
    } else if (old !== undefined) this.replace(pointer, old, value);
    else if (parent !== "" && this.get(parent) === undefined) this.set(parent, { [key]: value });
    else this.add({ path: pointer, after: value });
  }

  insert(list: string, index: number, value: Json): void {
    this.add({ path: pointerTo(list, index), after: value });
  }

  /** Adds a member to the end of a list, which is made if it is missing. The result is its pointer. */
  append(list: string, value: Json): string {
    const old = this.get(list);
    if (!Array.isArray(old)) {
      this.set(list, [value]);
      return pointerTo(list, 0);
    }
    this.insert(list, old.length, value);
    return pointerTo(list, old.length);
  }

  private replace(pointer: string, old: Json, value: Json): void {
    if (equal(old, value)) return;
    if (Array.isArray(old) && Array.isArray(value) && old.length === value.length)
      value.forEach((inner, k) => this.replace(pointerTo(pointer, k), old[k], inner));
    else if (isObject(old) && isObject(value))
      for (const key of new Set([...Object.keys(old), ...Object.keys(value)]))
        this.set(pointerTo(pointer, key), child(value, key));
    else this.add({ path: pointer, before: old, after: value });
  }

  private add(op: EditOp): void {
    this.root = applyOps(this.root, [op]);
    this.ops.push(op);
  }
}
