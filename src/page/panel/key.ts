// Entries of legends: a mark as it is in the picture, and its meaning.

import { element } from "./dom";

const shapes = {
  disc: '<circle r="7" class="v3-thin"/>',
  triangle: '<path d="M0-8 8 6H-8Z"/>',
  square: '<path d="M-6-6H6V6H-6Z"/>',
  hatched: '<path d="M-6-6H6V6H-6Z"/><path d="M-6 1 1-6M-6 6 6-6M-1 6 6-1" class="v3-lines"/>',
  diamond: '<path d="M0-9 9 0 0 9-9 0Z"/>',
  block: '<path d="M-5-8H5V8H-5Z"/>',
  dot: '<circle r="8" class="v3-bare"/>',
  cross: '<path d="M-4 0h8M0-4v8" class="v3-stroke"/>',
  solid: '<path d="M-9 0H9" class="v3-stroke v3-wide"/>',
  dashed: '<path d="M-9 0H9" class="v3-stroke v3-wide v3-dashed"/>',
};

export type KeyShape = keyof typeof shapes;

/** `colour`: a CSS variable. */
export function key(shape: KeyShape, colour: string, ...name: (Node | string)[]): HTMLElement {
  const mark = element("span", { class: "v3-key", "aria-hidden": "true" });
  mark.innerHTML = `<svg viewBox="-10 -10 20 20">${shapes[shape]}</svg>`;
  mark.style.setProperty("--tone", `var(${colour})`);
  return element("li", {}, mark, ...name);
}
