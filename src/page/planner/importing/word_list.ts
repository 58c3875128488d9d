// What words of the file stand for: one choice each. Unknown ones come first, in red, with the number of their lines.

import { counted } from "../../data/format";
import { say } from "../../data/text";
import { element } from "../../panel/dom";
import type { WordKind } from "../planogram/mapping";
import type { Word } from "../planogram/meanings";
import { text } from "./text";

export interface Choice {
  value: string;
  name: string;
}

const most = 200; // words
const nothing = "?";
const leaveOut = "-";

const optionOf = ({ meaning }: Word): string =>
  meaning === undefined ? nothing : meaning === null ? leaveOut : `=${meaning}`;

export class WordList {
  readonly root: HTMLElement;
  private readonly list = element("div", { class: "words" });
  private readonly known = element("details", {});
  private readonly knownList = element("div", { class: "words" });
  private readonly summary = element("summary");
  private readonly rows = new Map<string, { row: HTMLElement; select: HTMLSelectElement }>();
  /** Words stay where they are while a person chooses. */
  private shownOf = "";

  constructor(
    private readonly kind: WordKind,
    private readonly chosen: (word: string, meaning: string | null | undefined) => void,
  ) {
    this.root = element("section", { "aria-label": text.planogram.words[kind] });
    this.known.append(this.summary, this.knownList);
    this.root.append(element("h3", { text: text.planogram.words[kind] }), this.list, this.known);
  }

  show(words: readonly Word[], choices: readonly Choice[]): void {
    this.root.hidden = words.length === 0;
    const key = JSON.stringify([words.map(({ word, lines }) => [word, lines]), choices]);
    if (key !== this.shownOf) this.build(words, choices);
    this.shownOf = key;
    for (const word of words) {
      const found = this.rows.get(word.word);
      if (!found) continue;
      found.row.classList.toggle("unknown", word.meaning === undefined);
      found.select.ariaInvalid = String(word.meaning === undefined);
      found.select.value = optionOf(word);
    }
  }

  private build(words: readonly Word[], choices: readonly Choice[]): void {
    const byLines = [...words].sort((a, b) => b.lines - a.lines);
    const unknown = byLines.filter(({ meaning }) => meaning === undefined).slice(0, most);
    const known = byLines.filter(({ meaning }) => meaning !== undefined).slice(0, most);
    this.rows.clear();
    this.list.replaceChildren(...unknown.map((word) => this.row(word, choices)));
    this.knownList.replaceChildren(...known.map((word) => this.row(word, choices)));
    this.known.hidden = known.length === 0;
    this.known.open = false;
    this.summary.textContent = counted(text.planogram.known_words, known.length);
  }

  private row(word: Word, choices: readonly Choice[]): HTMLElement {
    const name = word.word === "" ? text.planogram.whole_file : word.word;
    const option = ({ value, name }: Choice) => element("option", { value: `=${value}`, text: name });
    const select = element("select", {
      "data-key": `word/${this.kind}/${word.word}`,
      "aria-label": say(text.planogram.word_of, name),
      on: {
        change: () =>
          this.chosen(
            word.word,
            select.value === nothing ? undefined : select.value === leaveOut ? null : select.value.slice(1),
          ),
      },
    });
    select.append(
      element("option", { value: nothing, text: text.planogram.choose }),
      element("option", { value: leaveOut, text: text.planogram.leave_out }),
      ...choices.filter(({ value }) => value === word.meaning).map(option),
    );
    // All choices of many words would be slow, and few are looked at.
    const fill = () => {
      if (select.dataset.isFull) return;
      select.dataset.isFull = "yes";
      const { value } = select;
      select.replaceChildren(...[...select.children].slice(0, 2), ...choices.map(option));
      select.value = value;
    };
    if (choices.length <= 40) fill();
    select.addEventListener("focus", fill);
    const row = element(
      "div",
      { class: "word" },
      element("span", { class: "name", text: name }),
      element("span", { class: "lines", text: counted(text.planogram.lines, word.lines) }),
      select,
    );
    this.rows.set(word.word, { row, select });
    return row;
  }
}
