// The lines of a file that are left out, with the reasons.

import { counted, grouped } from "../../data/format";
import { say } from "../../data/text";
import { button, element, replaceChildren } from "../../panel/dom";
import type { BadLine } from "../planogram/check";
import { text } from "./text";

const shown = 200;
const longest = 160; // characters of a line

const contentOf = ({ row }: BadLine): string => {
  const content = row.fields.join(" | ");
  return content.length > longest ? `${content.slice(0, longest)} …` : content;
};

const reasonOf = ({ reason: { code, value = "", most = "" } }: BadLine): string =>
  say(text.planogram.reasons[code], value.length > longest ? `${value.slice(0, longest)} …` : value, most);

export class BadLines {
  readonly root = element("section", { class: "bad-lines", "aria-label": text.planogram.bad });
  private readonly title = element("h3");
  private readonly list = element("table", { "aria-label": text.planogram.bad });
  private readonly more = element("p", { class: "note" });
  private lines: readonly BadLine[] = [];
  private readonly copyButton = button(text.planogram.copy, () => this.copy(), {
    class: "small",
    "data-key": "copy-bad-lines",
  });

  constructor() {
    const scrolled = element("div", {
      class: "scrolled",
      tabindex: 0,
      role: "group",
      "aria-label": text.planogram.bad,
    });
    scrolled.append(this.list);
    this.root.append(element("header", {}, this.title, this.copyButton), scrolled, this.more);
  }

  show(lines: readonly BadLine[]): void {
    this.lines = lines;
    this.root.hidden = lines.length === 0;
    this.title.textContent = counted(text.planogram.left_out, lines.length);
    this.copyButton.textContent = text.planogram.copy;
    this.more.textContent = lines.length > shown ? say(text.planogram.more_lines, grouped(shown)) : "";
    const rows = lines
      .slice(0, shown)
      .map((bad) =>
        element(
          "tr",
          {},
          element("th", { scope: "row", text: String(bad.row.line) }),
          element("td", { text: reasonOf(bad) }),
          element("td", { class: "fields", text: contentOf(bad) }),
        ),
      );
    replaceChildren(this.list, [
      element(
        "thead",
        {},
        element("tr", {}, ...text.planogram.bad_columns.map((name) => element("th", { scope: "col", text: name }))),
      ),
      element("tbody", {}, ...rows),
    ]);
  }

  private copy(): void {
    const words = this.lines.map((bad) => `${bad.row.line}\t${reasonOf(bad)}\t${bad.row.fields.join("\t")}`).join("\n");
    this.copyButton.textContent = copyText(words) ? text.planogram.copied : text.planogram.not_copied;
  }
}

/** navigator.clipboard is missing in pages that other computers open without encryption. */
function copyText(words: string): boolean {
  const give = (event: ClipboardEvent) => {
    event.clipboardData?.setData("text/plain", words);
    event.preventDefault();
  };
  document.addEventListener("copy", give, { capture: true, once: true });
  const isCopied = document.execCommand("copy");
  document.removeEventListener("copy", give, { capture: true });
  return isCopied;
}
