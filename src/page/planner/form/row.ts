// One line of a panel: a name, and controls.

import { element } from "../../panel/dom";

export const row = (name: string, ...controls: HTMLElement[]): HTMLElement =>
  element(
    "div",
    { class: "row" },
    element("span", { class: "name", text: name }),
    element("div", { class: "control" }, ...controls),
  );
