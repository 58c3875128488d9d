// The fixture that the next line makes: one of a preset, or one like the fixture that is selected.

import type { JsonObject } from "../document/json";
import { withPreset } from "../elements/context";
import { sizeOf, type Template } from "../make/run";
import type { Planner } from "../planner";
import type { Model } from "./settings";

/** What belongs to one fixture alone. */
const placed = new Set([
  "preset",
  "id",
  "at",
  "min",
  "max",
  "rotation_deg",
  "against",
  "repeat",
  "length",
  "arrangement",
]);

/** "A" of "A4" and of "A{n}". */
const prefixOf = (id: unknown): string | null =>
  (typeof id === "string" && /^(.*?\D)(\d+|\{n\})$/.exec(id)?.[1]) || null;

function withKeys(planner: Planner, preset: string | null, value: JsonObject): Template | null {
  const { presets, document } = planner;
  const base = preset === null ? undefined : presets.get(preset)?.effective;
  if (preset !== null && !base) return null;
  const own = Object.fromEntries(Object.entries(value).filter(([key]) => !placed.has(key)));
  if (base) delete own.size; // its length is that of the line
  const effective = withPreset(base, base && Array.isArray(value.size) ? { ...own, size: value.size } : own);
  const all = base ? effective : { ...effective, length: value.length };
  if (!sizeOf(all, document.unit)) return null;
  const usualSize = base ? sizeOf(base, document.unit) : null;
  const usual = usualSize?.length ?? null;
  // The model may be one module of another length.
  const length = sizeOf({ ...all, ...value }, document.unit)?.length;
  const module = usual !== null && length !== undefined && length < 1.5 * usual ? length : usual;

  return { preset, own, base: usualSize, effective: all, prefix: prefixOf(value.id), module };
}

/** A template of another depth, in the unit of the store. A box has its depth in its size. */
export function withDepth(template: Template, depth: number): Template {
  const { own, effective } = template;
  if (!Array.isArray(effective.size))
    return { ...template, own: { ...own, depth }, effective: { ...effective, depth } };
  const [length, , height] = effective.size as number[];
  return { ...template, effective: { ...effective, size: [length, depth, height] } };
}

/** The fixture that the next one is like: the selected one, or the last, also if undo has removed it; null: none. */
export function modelOf({ selected, settings }: Planner): Model | null {
  const [model] = selected;
  if (!settings.now.isLike) return null;
  if (selected.length === 1 && model.kind === "fixture")
    settings.model = { id: String(model.value.id ?? ""), value: model.value };
  return settings.model;
}

export function templateOf(planner: Planner): Template | null {
  const { preset } = planner.settings.now;
  const model = modelOf(planner);
  const like = model && withKeys(planner, (model.value.preset as string | undefined) ?? null, model.value);
  return like ?? (preset === null ? null : withKeys(planner, preset, {}));
}
