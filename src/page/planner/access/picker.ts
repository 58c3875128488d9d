// A dialog with a search field and a list of results, of which one is chosen: by the arrow keys and Enter, or a click.

import { element } from "../../panel/dom";
import { text } from "../text";
import { openDialog } from "./dialog";

export interface Result {
  name: string;
  /** What it is, in small letters. */
  note: string;
  isEnabled?: boolean;
  choose: () => void;
}

export function openPicker(
  title: string,
  placeholder: string,
  search: (typed: string) => Promise<Result[]> | Result[],
): void {
  let results: Result[] = [];
  let active = 0;
  let asked = 0;
  const list = element("ul", { class: "results", role: "listbox", id: "results", "aria-label": title });
  const note = element("p", { class: "note", role: "status" });
  const input = element("input", {
    type: "text",
    role: "combobox",
    placeholder,
    "aria-label": placeholder,
    "aria-controls": "results",
    "aria-expanded": "true",
    "aria-autocomplete": "list",
    autocomplete: "off",
    on: {
      input: () => {
        latest = update();
      },
    },
  });
  const dialog = openDialog(title, "picker", input, list, note);

  const choose = (index: number) => {
    const result = results[index];
    if (!result || result.isEnabled === false) return;
    dialog.close();
    result.choose();
  };
  const show = () => {
    list.replaceChildren(
      ...results.map(({ name, note: kind, isEnabled }, k) =>
        element(
          "li",
          {
            role: "option",
            id: `result${k}`,
            "aria-selected": String(k === active),
            "aria-disabled": isEnabled === false ? "true" : undefined,
            on: { click: () => choose(k) },
          },
          element("span", { text: name }),
          element("small", { text: kind }),
        ),
      ),
    );
    if (results.length > 0) input.setAttribute("aria-activedescendant", `result${active}`);
    else input.removeAttribute("aria-activedescendant");
    list.children[active]?.scrollIntoView({ block: "nearest" });
    note.textContent = results.length === 0 && input.value.trim() !== "" ? text.access.nothing : "";
  };
  const update = async () => {
    const own = ++asked;
    const found = await search(input.value.trim());
    if (own !== asked) return;
    results = found;
    active = 0;
    show();
  };
  let latest: Promise<void> = Promise.resolve();
  input.addEventListener("keydown", (event) => {
    const { key } = event as KeyboardEvent;
    if (key === "ArrowDown" || key === "ArrowUp") {
      active = (active + (key === "ArrowDown" ? 1 : -1) + results.length) % Math.max(results.length, 1);
      event.preventDefault();
      show();
    } else if (key === "Enter") {
      event.preventDefault();
      // The results may be those of the text before.
      void latest.then(() => choose(active));
    }
  });
  latest = update();
  input.focus();
}
