// The presets of the project with all their keys, also those of catalogues, which the server knows.

import type { Changes } from "../changes";
import type { StoreDocument } from "../document/document";
import { equal, isObject, valueAt, type Json, type JsonObject } from "../document/json";
import { inUnit } from "../form/convert";

interface Answer {
  presets: Record<string, { effective: JsonObject; units: Record<string, string> }>;
}

/** A preset with all its keys, in the unit of the store. */
export interface Preset {
  name: string;
  effective: JsonObject;
}

export class Presets {
  private known = new Map<string, Preset>();
  private asked: Json | undefined;

  constructor(
    private readonly document: StoreDocument,
    private readonly changes: Changes,
  ) {
    changes.listen(["document"], () => void this.follow());
  }

  get all(): Preset[] {
    return [...this.known.values()];
  }

  get(name: string): Preset | null {
    return this.known.get(name) ?? null;
  }

  /** Asks again after a change of what presets depend on. */
  private async follow(): Promise<void> {
    const { document } = this;
    if (!document.isReady) return;
    const key: Json = [
      valueAt(document.json, "/presets") ?? null,
      valueAt(document.json, "/catalogues") ?? null,
      valueAt(document.json, "/units") ?? null,
      document.shared.presets ?? [],
    ];
    if (equal(key, this.asked)) return;
    this.asked = key;
    try {
      const { presets } = await document.request<Answer>("presets", {});
      if (!equal(key, this.asked)) return;
      this.known = new Map(
        Object.entries(presets)
          .filter(([, { effective }]) => isObject(effective) && typeof effective.type === "string")
          .map(([name, { effective, units }]) => [name, { name, effective: inUnit(effective, units, document.unit) }]),
      );
      this.changes.note("presets");
    } catch {
      if (this.asked === key) this.asked = undefined; // presets with problems, or no connection: the next change asks again
    }
  }
}
