// Numbers the selected fixtures by a pattern.

import { openPicker } from "../access/picker";
import { counted } from "../../data/format";
import { EditBuilder } from "../document/edit";
import { contextOf, knowDetails } from "../elements/context";
import { giveIds, namesIn, namingOf, patternOf, type Numbered } from "../elements/numbering";
import { boundsOfParts, middleOf } from "../geometry/bounds";
import type { Planner } from "../planner";
import { say, text } from "../text";

const fixturesOf = ({ selected }: Planner) => selected.filter(({ kind }) => kind === "fixture");

export const canNumber = (planner: Planner): boolean =>
  planner.document.locked === null && fixturesOf(planner).length > 0;

/** The selection of the moment, because another tab may change the store while the dialog is open. */
function numberedBy(planner: Planner, pattern: string) {
  const { document } = planner;
  const elements = fixturesOf(planner).flatMap(({ path }): Numbered[] => {
    const context = contextOf(document, path);
    const bounds = boundsOfParts(document.parts.of(path).slice(0, 1));
    return context && bounds ? [{ path, value: context.effective, middle: middleOf(bounds) }] : [];
  });
  const own = new Set(elements.flatMap(({ path }) => document.parts.of(path).map(({ key }) => key)));
  const others = new Set(document.parts.all.filter(({ key }) => !own.has(key)).map(({ id }) => id));
  return namingOf(elements, pattern, others);
}

export async function numberFixtures(planner: Planner): Promise<void> {
  const { document } = planner;
  const paths = fixturesOf(planner).map(({ path }) => path);
  await knowDetails(document, paths, false);
  openPicker(text.access.number, text.access.number_hint, (typed) => {
    if (typed === "") return [];
    const pattern = patternOf(typed);
    return [
      {
        name: namesIn(numberedBy(planner, pattern), pattern),
        note: counted(text.counted.fixture, fixturesOf(planner).length),
        choose: () => {
          const builder = new EditBuilder(document.json);
          const naming = numberedBy(planner, pattern);
          giveIds(builder, naming, pattern);
          void document.edit({ label: say(text.edits.number, namesIn(naming, pattern)), ops: builder.ops });
        },
      },
    ];
  });
}
