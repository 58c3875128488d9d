// Types of the selected elements: their names, and the change of a type.

import { EditBuilder } from "../document/edit";
import { pointerTo } from "../document/json";
import { withoutPlace } from "../document/messages";
import type { TypeList } from "../elements/types";
import { namesIn } from "../form/initial";
import type { ElementKind, StoreElement } from "../elements/kinds";
import { namesOf } from "../elements/names";
import type { Planner } from "../planner";
import { say, text } from "../text";
import { changeUnits } from "../units/act";
import { chosenUnits } from "../units/chosen";

const typesOf: Partial<Record<ElementKind, [TypeList, string]>> = {
  fixture: ["presets", "preset"],
  label: ["label_types", "type"],
  plane: ["label_types", "type"],
  unit: ["transceiver_types", "type"],
  grid: ["transceiver_types", "type"],
  area: ["transceiver_types", "type"],
  rail: ["transceiver_types", "type"],
  faces: ["transceiver_types", "type"],
};

/** The presets that fixtures can have: others have keys that a fixture of this type does not know. */
export function presetsFor({ presets, document }: Planner, fixtures: readonly Pick<StoreElement, "value">[]): string[] {
  const typeOf = (name: unknown) => presets.get(String(name))?.effective.type;
  const [type, ...others] = fixtures.map(({ value }) => value.type ?? typeOf(value.preset));
  if (type === undefined || others.some((other) => other !== type)) return [];
  return namesIn(document.json, "presets", document.shared).filter((name) => typeOf(name) === type);
}

/** What number keys give the selection: the list of the types, the key that names one, and the types in their order. */
interface Assigned {
  list: TypeList;
  key: string;
  names: string[];
}

export function assignedTypes(planner: Planner): Assigned | null {
  const { document, selected } = planner;
  const isUnits = chosenUnits(planner).length > selected.length;
  const lists = isUnits ? [typesOf.unit] : selected.map(({ kind }) => typesOf[kind]);
  const [first] = lists;
  if (!first || lists.some((other) => other?.[0] !== first[0])) return null;
  const [list, key] = first;
  const names = list === "presets" ? presetsFor(planner, selected) : namesIn(document.json, list, document.shared);
  return { list, key, names };
}

export const canAssign = (planner: Planner): boolean => planner.selected.length > 0 || chosenUnits(planner).length > 0;

/** Gives the selected elements the type with this number in its list. */
export function assignType(planner: Planner, index: number): void {
  const { document, selected } = planner;
  const units = chosenUnits(planner);
  const types = assignedTypes(planner);
  const name = types?.names[index];
  if (!types || name === undefined) return;
  // Other candidates become entries of the list.
  if (units.length > selected.length)
    void changeUnits(planner, units, say(text.edits.assign, "{0}", name), () => ({ type: name }));
  else if (types.list === "presets") void givePreset(planner, selected, name);
  else {
    const builder = new EditBuilder(document.json);
    for (const { path } of selected) builder.set(pointerTo(path, types.key), name);
    void document.edit({ label: say(text.edits.assign, namesOf(selected), name), ops: builder.ops });
  }
}

/** Gives fixtures a preset, or none. Values of their own may contradict it: then nothing changes. */
export async function givePreset(
  planner: Planner,
  fixtures: readonly StoreElement[],
  name: string | undefined,
): Promise<void> {
  const { document } = planner;
  const wasValid = document.problems.length === 0;
  const builder = new EditBuilder(document.json);
  for (const { path } of fixtures) builder.set(pointerTo(path, "preset"), name);
  const names = namesOf(fixtures);
  const label =
    name === undefined ? say(text.edits.change, text.fields.preset, names) : say(text.edits.assign, names, name);
  const isDone = await document.edit({ label, ops: builder.ops });
  const [problem] = document.problems;
  if (!isDone || !wasValid || !problem || !(await document.undo())) return;
  planner.say(say(text.notices.refused, label, withoutPlace(problem, document.file)), true);
}
