// A menu of commands at a place of the screen.

import { element } from "../../panel/dom";
import { text } from "../text";
import { chordText } from "./keys";
import type { CommandId, Commands } from "./commands";

/** `closed`: after the command has run, if one was chosen. */
export function openMenu(
  commands: Commands,
  groups: readonly CommandId[][],
  x: number,
  y: number,
  closed: () => void = () => {},
): void {
  const before = document.activeElement;
  const close = () => {
    menu.remove();
    document.removeEventListener("pointerdown", outside, true);
    if (before instanceof HTMLElement) before.focus({ preventScroll: true });
    setTimeout(closed);
  };
  const outside = (event: Event) => {
    if (!menu.contains(event.target as Node)) close();
  };
  const items = groups.map((group) =>
    group
      .filter((id) => commands.isEnabled(id))
      .map((id) =>
        element(
          "button",
          {
            type: "button",
            role: "menuitem",
            tabindex: -1,
            "data-command": id,
            on: {
              click: () => {
                close();
                commands.run(id);
              },
            },
          },
          element("span", { text: text.commands[id] }),
          element("kbd", { text: chordText(commands.get(id).keys[0] ?? "") }),
        ),
      ),
  );
  const shown = items.filter((group) => group.length > 0);
  const menu = element(
    "div",
    { class: "menu", role: "menu", "aria-label": text.access.menu },
    ...shown.flatMap((group, k) => [...(k > 0 ? [element("div", { role: "separator" })] : []), ...group]),
  );
  const all = shown.flat();
  if (all.length === 0) {
    closed();
    return;
  }
  const focus = (index: number) => all[(index + all.length) % all.length].focus();
  menu.addEventListener("keydown", (event) => {
    const { key } = event as KeyboardEvent;
    const index = all.indexOf(document.activeElement as HTMLButtonElement);
    event.stopPropagation();
    if (key === "ArrowDown") focus(index + 1);
    else if (key === "ArrowUp") focus(index - 1);
    else if (key === "Home") focus(0);
    else if (key === "End") focus(-1);
    else if (key === "Escape" || key === "Tab") close();
    else return;
    event.preventDefault();
  });
  menu.addEventListener("contextmenu", (event) => event.preventDefault());
  (document.querySelector("main") ?? document.body).append(menu);
  menu.style.left = `${Math.max(Math.min(x, innerWidth - menu.offsetWidth - 8), 4)}px`;
  menu.style.top = `${Math.max(Math.min(y, innerHeight - menu.offsetHeight - 8), 4)}px`;
  document.addEventListener("pointerdown", outside, true);
  focus(0);
}
