// What stands between the person and the store: an invalid file, or a lost connection.

import { button, element } from "../../panel/dom";
import type { Planner } from "../planner";
import { say, text } from "../text";

export class Banner {
  readonly root = element("div", { class: "banner", role: "alert", hidden: true });
  private shown = "";

  constructor(private readonly planner: Planner) {}

  update(): void {
    const { document } = this.planner;
    const { locked, saving } = document;
    const words = locked ? locked.message : saving.state === "lost" ? text.banner.lost : "";
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
