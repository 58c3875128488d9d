// What stands between the person and the store: an invalid file, or a lost connection.

import { button, element } from "../../panel/dom";
import { counted } from "../../data/format";
import type { Saving } from "../document/document";
import type { Planner } from "../planner";
import { say, text } from "../text";

function lostText({ edits, hasEnded }: Extract<Saving, { state: "lost" }>): string {
  if (!hasEnded) return text.banner.lost;
  return edits === 0 ? text.banner.ended : `${text.banner.ended} ${counted(text.banner.unsaved, edits)}`;
}

/** The title names the file. */
const withoutFile = (message: string, file: string): string =>
  message.slice(message.indexOf(`${file}: `) + file.length + 2);

export class Banner {
  readonly root = element("div", { class: "banner", role: "alert", hidden: true });
  private shown = "";

  constructor(private readonly planner: Planner) {}

  update(): void {
    const { document } = this.planner;
    const { locked, saving } = document;
    const words = locked ? withoutFile(locked.message, document.file) : saving.state === "lost" ? lostText(saving) : "";
    const key = `${locked ? "locked" : ""}${words}`;
    if (key === this.shown) return;
    this.shown = key;
    this.root.hidden = words === "";
    this.root.replaceChildren(
      ...(locked
        ? [
            element(
              "div",
              {},
              element("strong", { text: say(text.banner.locked, document.file) }),
              element("p", { text: words }),
            ),
            button(text.banner.restore, () => void document.restore(), { title: text.banner.restore_title }),
          ]
        : [element("p", { text: words })]),
    );
  }
}
