// The commands for selected units.

import type { Command } from "../access/commands";
import { isDrawTool } from "../draw/tools";
import type { Planner } from "../planner";
import { text } from "../text";
import { hasMark, marks, removeUnits, toggleMark, turnUnits, type Mark } from "./act";
import { chosenUnits, stateOf, whyFixed } from "./chosen";

const keys: Record<Mark, string> = { switch: "Q", pin: "P", exclude: "X", install: "I" };

/** Why none of the selected units can be marked; null if they can. */
export function whyNoMark(planner: Planner): string | null {
  if (planner.document.locked) return text.why_not.locked;
  return chosenUnits(planner).length === 0 ? text.units.none : null;
}

/** Why the selected units cannot be changed; null if they can. */
export function whyNoChange(planner: Planner): string | null {
  const whys = chosenUnits(planner).map((index) => whyFixed(planner, index));
  return whyNoMark(planner) ?? whys.find((why) => why !== null) ?? null;
}

/** Why the selected units cannot be removed; null if one of them can. */
export function whyNoRemoval(planner: Planner): string | null {
  const { units } = planner.document;
  const chosen = chosenUnits(planner);
  const isRemovable = (index: number) => units.isListed(index) || stateOf(units, index) !== "candidate";
  if (chosen.some((index) => units.pathOf(index) === null)) return text.why_not.file;
  return whyNoMark(planner) ?? (chosen.some(isRemovable) ? null : text.units.no_removal);
}

/** Whether all selected units have a mark. */
export const allHave = ({ document }: Planner, chosen: readonly number[], mark: Mark): boolean =>
  chosen.length > 0 && chosen.every((index) => hasMark(mark, stateOf(document.units, index)));

/** They come before those for elements, whose keys some of them have. */
export function unitCommands(planner: Planner, showField: (pointer: string) => void): Command[] {
  const command = (id: Command["id"], ofKeys: string[], run: () => void, why: () => string | null): Command => ({
    id,
    group: "units",
    keys: ofKeys,
    where: "page",
    run,
    isEnabled: () => why() === null && !isDrawTool(planner.tool),
    // Other elements, and a tool, have commands with some of these keys.
    why: () => {
      const isMeant = chosenUnits(planner).length > 0 && !isDrawTool(planner.tool);
      return isMeant || !sharedKeys.has(ofKeys[0]) ? why() : null;
    },
  });
  const mark = (name: Mark): Command => ({
    ...command(
      `unit_${name}`,
      [keys[name]],
      () => void toggleMark(planner, chosenUnits(planner), name),
      () => whyNoMark(planner),
    ),
    isOn: () => allHave(planner, chosenUnits(planner), name),
  });
  const change = () => whyNoChange(planner);
  return [
    ...marks.map(mark),
    command("unit_turn", ["R"], () => void turnUnits(planner, chosenUnits(planner), 90), change),
    command("unit_turn_back", ["Shift+R"], () => void turnUnits(planner, chosenUnits(planner), -90), change),
    command("unit_tilt", [], () => showField("/unit/tilt"), change),
    // Entries of the list have fields of their own.
    command("unit_exchange", [], () => showField(isEntry(planner) ? "/type" : "/unit/type"), change),
    command("unit_power", [], () => showField(isEntry(planner) ? "/relative_power" : "/unit/power"), change),
    command(
      "unit_remove",
      ["Delete", "Backspace"],
      () => void removeUnits(planner, chosenUnits(planner)),
      () => whyNoRemoval(planner),
    ),
  ];
}

const isEntry = ({ selected }: Planner): boolean => selected.length > 0;

const sharedKeys = new Set(["R", "Shift+R", "Delete"]);
