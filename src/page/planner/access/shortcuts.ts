// The page of shortcuts.

import { element } from "../../panel/dom";
import { text } from "../text";
import { openDialog } from "./dialog";
import { chordText } from "./keys";
import type { Command, CommandGroup, Commands } from "./commands";

export function openShortcuts(commands: Commands): void {
  const groups = Object.keys(text.groups) as CommandGroup[];
  const row = (keys: readonly string[], words: string) => [
    element("dt", {}, ...keys.map((key) => element("kbd", { text: key }))),
    element("dd", { text: words }),
  ];
  const rowsOf = ({ id, keys, family }: Command, own: readonly Command[]) => {
    if (!family) return row(keys.map(chordText), text.commands[id]);
    // One row stands for all of them.
    const isFirst = own.find((other) => other.family === family)?.id === id;
    return isFirst ? row([text.family_keys[family]], text.families[family]) : [];
  };
  const sections = groups.map((group) => {
    const own = commands.all.filter((command) => command.group === group && command.keys.length > 0);
    return own.length === 0
      ? null
      : element(
          "section",
          {},
          element("h3", { text: text.groups[group] }),
          element("dl", {}, ...own.flatMap((command) => rowsOf(command, own))),
        );
  });
  const pointer = element(
    "section",
    {},
    element("h3", { text: text.pointer.title }),
    element("dl", {}, ...text.pointer.rows.flatMap(([keys, words]) => row([keys], words))),
  );
  openDialog(
    text.access.shortcuts,
    "shortcuts",
    element(
      "div",
      { class: "scrolled", tabindex: 0, role: "region", "aria-label": text.access.shortcuts },
      element("div", { class: "columns" }, ...sections.filter((section) => section !== null), pointer),
    ),
  );
}
