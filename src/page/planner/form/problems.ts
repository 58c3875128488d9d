// The sentences of problems and warnings below the fields.

import { element } from "../../panel/dom";

/** The id of the sentence of a value. */
export const problemId = (pointer: string): string => `field${pointer}-problem`;

/**
 * Shows problems below the fields of their values, or of the values around them. `form`: elements with the pointers of
 * their values as `data-field`.
 */
export function showProblems(form: HTMLElement, problems: ReadonlyMap<string, string>): void {
  const rows = new Map([...form.querySelectorAll<HTMLElement>("[data-field]")].map((row) => [row.dataset.field, row]));
  for (const row of rows.values()) row.querySelector(":scope > .problem")?.remove();
  for (const [pointer, sentence] of problems) {
    let at = pointer;
    while (at !== "" && !rows.has(at)) at = at.slice(0, at.lastIndexOf("/"));
    rows.get(at)?.append(element("p", { class: "problem", id: problemId(at), text: sentence }));
  }
}
