// A button with an icon for a command; its title names the key.

import { button } from "../../panel/dom";
import { say, text } from "../text";
import type { CommandId, Commands } from "./commands";
import { icon, type IconName } from "./icons";
import { chordText } from "./keys";

export function commandButton(commands: Commands, id: CommandId, image: IconName): HTMLButtonElement {
  const name = text.commands[id];
  const [key] = commands.get(id).keys;
  const made = button("", () => commands.run(id), {
    class: "tool",
    title: key ? say(text.access.with_key, name, chordText(key)) : name,
    "aria-label": name,
    "data-key": `tool-${id}`,
  });
  made.append(icon(image));
  return made;
}
