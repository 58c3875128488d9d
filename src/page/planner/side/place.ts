// Where the selection is: typed x and y move it, a typed angle turns it.

import { element } from "../../panel/dom";
import { shiftSelection, turnSelection } from "../actions/move";
import { entry, type Place } from "../form/inputs";
import { numberFrom, unitText } from "../form/parse";
import { lengthText, tidy } from "../geometry/units";
import type { Planner } from "../planner";
import { say, text } from "../text";

/** Null without anything that has a place. */
export function placeRows(planner: Planner, isDisabled: boolean): HTMLElement | null {
  const bounds = planner.selectionBounds;
  const { unit, json, shared } = planner.document;
  if (!bounds) return null;
  const place: Place = {
    id: "place",
    key: "",
    label: text.place.title,
    around: { json, shared, unit, part: null },
    isDisabled,
    isRequired: true,
    problemId: "",
  };
  const coordinate = (axis: 0 | 1) => {
    const present = tidy(bounds.lower[axis] / unit.factor, unit);
    return element(
      "span",
      { class: "component" },
      element("span", { class: "axis", text: text.components.position[axis], "aria-hidden": "true" }),
      entry(place, {
        id: `place/${axis}`,
        label: [text.place.x, text.place.y][axis],
        shown: String(present),
        placeholder: "",
        unit: axis === 1 ? unit.name : "",
        read: (typed) => numberFrom(typed, "length", unit),
        commit: (value) => {
          const way = (Number(value) - present) * unit.factor;
          void shiftSelection(planner, axis === 0 ? way : 0, axis === 1 ? way : 0);
        },
      }),
    );
  };
  const turn = entry(place, {
    id: "place/turn",
    label: text.place.turn,
    shown: "",
    placeholder: "0",
    unit: unitText("degrees", unit),
    read: (typed) => numberFrom(typed, "degrees", unit),
    commit: (value) => void turnSelection(planner, Number(value)),
  });
  const row = (name: string, ...controls: HTMLElement[]) =>
    element(
      "div",
      { class: "row" },
      element("span", { class: "name", text: name }),
      element("div", { class: "control" }, ...controls),
    );
  const [width, height] = [0, 1].map((axis) => lengthText(bounds.upper[axis] - bounds.lower[axis], unit));
  return element(
    "section",
    { class: "place" },
    row(text.place.title, element("span", { class: "vector" }, coordinate(0), coordinate(1))),
    row(text.place.turn, turn),
    row(text.place.size, element("span", { class: "constant", text: say(text.place.by, width, height) })),
    ...gapRow(planner, row),
  );
}

/** The distances between two selected elements. */
function gapRow(planner: Planner, row: (name: string, ...controls: HTMLElement[]) => HTMLElement): HTMLElement[] {
  const all = planner.selection.items.flatMap((item) => planner.boundsOfItem(item) ?? []);
  if (all.length !== 2) return [];
  const [a, b] = all;
  const { unit } = planner.document;
  const gaps = [0, 1].map((axis) => Math.max(b.lower[axis] - a.upper[axis], a.lower[axis] - b.upper[axis]));
  const words =
    gaps[0] <= 0 && gaps[1] <= 0
      ? text.place.overlap
      : say(text.place.gaps, lengthText(Math.max(gaps[0], 0), unit), lengthText(Math.max(gaps[1], 0), unit));
  return [row(text.place.gap, element("span", { class: "constant", text: words }))];
}
