// Types of the selected elements: their names, and the change of a type.

import { EditBuilder } from "../document/edit";
import { pointerTo } from "../document/json";
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

/** The types that the selected elements can have; null if they have none in common. */
function typesOfSelection(elements: readonly StoreElement[]): [TypeList, string] | null {
  const lists = elements.map(({ kind }) => typesOf[kind]);
  const [first] = lists;
  return first && lists.every((list) => list?.[0] === first[0]) ? first : null;
}

export const canAssign = (planner: Planner): boolean => planner.selected.length > 0 || chosenUnits(planner).length > 0;

/** The list of the types that number keys give the selection; undefined: none. */
export const assignedTypes = (planner: Planner): TypeList | undefined =>
  chosenUnits(planner).length > 0 ? "transceiver_types" : typesOfSelection(planner.selected)?.[0];

/** Gives the selected elements the type with this number in its list. */
export function assignType(planner: Planner, index: number): void {
  const elements = planner.selected;
  const units = chosenUnits(planner);
  // Other candidates become entries of the list.
  if (units.length > elements.length) {
    const type = namesIn(planner.document.json, "transceiver_types", planner.document.shared)[index];
    if (type !== undefined) void changeUnits(planner, units, say(text.edits.assign, "{0}", type), () => ({ type }));
    return;
  }
  const types = typesOfSelection(elements);
  if (!types) return;
  const name = namesIn(planner.document.json, types[0], planner.document.shared)[index];
  if (name === undefined) return;
  const builder = new EditBuilder(planner.document.json);
  for (const { path } of elements) builder.set(pointerTo(path, types[1]), name);
  void planner.document.edit({ label: say(text.edits.assign, namesOf(elements), name), ops: builder.ops });
}
