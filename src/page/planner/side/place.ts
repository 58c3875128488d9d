// Where elements are: typed x and y move it, a typed angle turns it.

import { element } from "../../panel/dom";
import { shiftElements, turnElements } from "../actions/move";
import { component, entry, type Place } from "../form/inputs";
import { numberFrom, unitText } from "../form/parse";
import { row } from "../form/row";
import { lengthText, tidy } from "../geometry/units";
import type { StoreElement } from "../elements/kinds";
import type { Planner } from "../planner";
import { say, text } from "../text";

/** Null without anything that has a place. */
export function placeRows(
  planner: Planner,
  elements: readonly StoreElement[],
  isDisabled: boolean,
): HTMLElement | null {
  const bounds = planner.boundsOfElements(elements);
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
  const coordinate = (axis: 0 | 1) =>
    component(
      text.components.position[axis],
      entry(place, {
        id: `place/${axis}`,
        label: [text.place.x, text.place.y][axis],
        shown: String(tidy(bounds.lower[axis] / unit.factor, unit)),
        placeholder: "",
        unit: axis === 1 ? unit.name : "",
        read: (typed) => numberFrom(typed, "length", unit),
        commit: (value) => {
          // Another tab may have moved the elements since somebody began to type.
          const now = planner.boundsOfElements(elements);
          if (!now) return;
          const way = (Number(value) - tidy(now.lower[axis] / unit.factor, unit)) * unit.factor;
          void shiftElements(planner, elements, axis === 0 ? [way, 0] : [0, way]);
        },
      }),
    );
  const turn = entry(place, {
    id: "place/turn",
    label: text.place.turn,
    shown: "",
    placeholder: "0",
    unit: unitText("degrees", unit),
    read: (typed) => numberFrom(typed, "degrees", unit),
    commit: (value) => void turnElements(planner, elements, Number(value)),
  });
  const [width, height] = [0, 1].map((axis) => lengthText(bounds.upper[axis] - bounds.lower[axis], unit));
  return element(
    "section",
    { class: "place" },
    row(text.place.title, element("span", { class: "vector" }, coordinate(0), coordinate(1))),
    row(text.place.turn, turn),
    row(text.place.size, element("span", { class: "constant", text: say(text.place.by, width, height) })),
    ...gapRow(planner),
  );
}

/** The distances between two selected elements. */
function gapRow(planner: Planner): HTMLElement[] {
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
