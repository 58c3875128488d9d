// Colours are read from the style sheet of the page, so that they follow its light and dark setting.

import { Color } from "three";

/** The value of a CSS colour variable, #rrggbb. */
export function colourOf(element: Element, variable: string): Color {
  return new Color(getComputedStyle(element).getPropertyValue(variable).trim() || "#888888");
}

export function onThemeChange(changed: () => void): void {
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", changed);
}
