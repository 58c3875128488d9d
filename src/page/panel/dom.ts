// Helpers for the controls beside the picture.

type Child = Node | string | null;

interface Attributes {
  class?: string;
  text?: string;
  on?: Partial<Record<keyof HTMLElementEventMap, (event: Event) => void>>;
  [name: string]: unknown;
}

/** An element with attributes, listeners and children; true is an attribute without a value. */
export function element<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[Tag] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "text") made.textContent = String(value);
    else if (name === "on")
      for (const [event, listener] of Object.entries(value as object)) made.addEventListener(event, listener);
    else if (value === true) made.setAttribute(name, "");
    else if (value !== false && value !== undefined && value !== null) made.setAttribute(name, String(value));
  }
  made.append(...children.filter((child): child is Node | string => child !== null));
  return made;
}

export function button(text: string, pressed: () => void, attributes: Attributes = {}): HTMLButtonElement {
  return element("button", { type: "button", text, on: { click: pressed }, ...attributes });
}

/** Shows a sentence, or hides its element if it is empty. Screen readers hear only changes. */
export function setText(element: HTMLElement, words: string): void {
  if (element.textContent !== words) element.textContent = words;
  element.hidden = words === "";
}

/** A choice of one value, as radio buttons in one row. */
export class Choice<Value extends string> {
  readonly root: HTMLFieldSetElement;
  private readonly inputs = new Map<Value, HTMLInputElement>();

  constructor(name: string, legend: string, values: [Value, string][], chosen: (value: Value) => void) {
    this.root = element("fieldset", { class: "v3-choice" }, element("legend", { text: legend }));
    for (const [value, text] of values) {
      const input = element("input", { type: "radio", name, value, on: { change: () => chosen(value) } });
      this.inputs.set(value, input);
      this.root.append(element("label", {}, input, element("span", { text })));
    }
  }

  show(value: Value): void {
    const input = this.inputs.get(value);
    if (input) input.checked = true;
  }
}

/** Replaces the children of a list; the focused control (by data-key) keeps the focus. */
export function replaceChildren(list: HTMLElement, children: Node[]): void {
  const focused = document.activeElement;
  const key = focused instanceof HTMLElement && list.contains(focused) ? focused.dataset.key : undefined;
  const scrolled = list.scrollTop;
  list.replaceChildren(...children);
  list.scrollTop = scrolled;
  if (key !== undefined) list.querySelector<HTMLElement>(`[data-key="${CSS.escape(key)}"]`)?.focus();
}
