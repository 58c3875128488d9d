// The texts of the page, which this module gets from it: it is loaded apart, and would contain all of them again.

import type { text as catalogue } from "../text";

export let text: typeof catalogue;

export function useTexts(texts: typeof catalogue): void {
  text = texts;
}
