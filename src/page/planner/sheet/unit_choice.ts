// Asks in which unit of length a DXF drawing is. Headers often name a wrong one, so a person decides, by the size of the
// drawing in each unit.

import { button, element } from "../../panel/dom";
import { openDialog } from "../access/dialog";
import type { DxfFacts } from "../dxf/show/messages";
import { drawingUnits, factorOf } from "../geometry/units";
import { say, text } from "../text";
import { noteText } from "./open";

const sizeIn = ([width, height]: readonly number[], unit: string): string => {
  const [x, y] = [width, height].map((length) => (length * factorOf(unit)).toPrecision(3));
  return say(text.dxf.size, Number(x), Number(y));
};

const nameOf = (unit: string): string => (text.dxf.units as Record<string, string>)[unit] ?? unit;

/** Null: the drawing is not wanted. */
export function chooseUnit(facts: DxfFacts, name: string): Promise<string | null> {
  const { proposal, bulk, unit: named, notes } = facts;
  return new Promise((done) => {
    const choice = element(
      "select",
      { "data-key": "unit-choice", "aria-label": text.dxf.unit },
      ...[...drawingUnits.keys()].map((unit) =>
        element("option", {
          value: unit,
          text: `${nameOf(unit)}: ${sizeIn(bulk, unit)}`,
          selected: unit === proposal.unit,
        }),
      ),
    );
    const take = button(
      text.dxf.take,
      () => {
        done(choice.value);
        dialog.close();
      },
      { autofocus: true, "data-key": "unit-take" },
    );
    const { contradiction } = proposal;
    const doubts: string[] = [];
    if (named !== null && contradiction)
      doubts.push(say(text.dxf.contradictory, nameOf(named), text.dxf.systems[contradiction], sizeIn(bulk, named)));
    else if (named !== null && named !== proposal.unit) doubts.push(say(text.dxf.doubted, nameOf(named)));
    const dialog = openDialog(
      say(text.dxf.title, name),
      "unit",
      element("p", { text: say(text.dxf.why[proposal.why], nameOf(proposal.unit)) }),
      ...doubts.map((doubt) => element("p", { class: "problem", text: doubt })),
      element("p", { class: "choice" }, choice, take),
      ...(notes.length > 0
        ? [
            element(
              "details",
              { class: "notes" },
              element("summary", { text: text.dxf.reservations }),
              element("ul", {}, ...notes.map((note) => element("li", { text: noteText(note) }))),
            ),
          ]
        : []),
    );
    choice.addEventListener("keydown", ({ key }) => key === "Enter" && take.click());
    dialog.addEventListener("close", () => done(null));
  });
}
