// Texts with places for values. The catalogues belong to the report and to the planner.

export interface Plural {
  one: string;
  many: string;
}

export function plural(texts: Plural, count: number): string {
  return count === 1 ? texts.one : texts.many;
}

/** A text with values in its places {0}, {1}, ...: the children of an element. */
export function partsOf(template: string, ...values: (Node | string)[]): (Node | string)[] {
  return template.split(/\{(\d+)\}/).map((part, k) => (k % 2 === 1 ? values[Number(part)] : part));
}

/** Fills the places {0}, {1}, ... of a text. */
export function say(template: string, ...values: (string | number)[]): string {
  return partsOf(template, ...values.map(String)).join("");
}
