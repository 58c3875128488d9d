// The keyboard of the page: chords run commands, Space moves the plan, and the clipboard holds elements.

import type { Commands } from "../access/commands";
import { chordOf, isField, isOfField, keyOf } from "../access/keys";
import { copySelection, deleteSelection, paste } from "../actions/copy";
import { whyNoCopy } from "../actions/why_not";
import { fromText, toText } from "../elements/copies";
import type { Gestures } from "../gesture/gestures";
import type { Planner } from "../planner";
import { isTableText } from "../table/sniff";

/** Chords that the browser answers with events of the clipboard. */
const clipboardChords = new Set(["Ctrl+C", "Ctrl+X", "Ctrl+V"]);

/** The digit on a key that some keyboards give another meaning without Shift. */
function digitOf({ code, ctrlKey, metaKey, altKey, shiftKey }: KeyboardEvent): string {
  return ctrlKey || metaKey || altKey || shiftKey ? "" : (/^Digit(\d)$/.exec(code)?.[1] ?? "");
}

/**
 * A button or list of choices that has the focus from a click. While the pointer is over the plan, keys are for the plan:
 * otherwise Space would press the button again, and letters would choose from the list.
 */
const isClickedControl = (target: HTMLElement): boolean =>
  target.matches("button:not(:focus-visible), select:not(:focus-visible), summary:not(:focus-visible)") &&
  target.closest("dialog, .menu") === null;

export function listenToKeys(
  planner: Planner,
  commands: Commands,
  gestures: Gestures,
  plans: readonly HTMLElement[],
  pasteFile: (file: File) => void,
  beginLength: (typed: string) => boolean,
): void {
  // Keys of an input method are for its text, also Enter and Escape: no field or list gets them. Safari tells by 229 alone.
  document.addEventListener(
    "keydown",
    (event) => {
      if (event.isComposing || event.keyCode === 229) event.stopImmediatePropagation();
    },
    { capture: true },
  );
  document.addEventListener("keydown", (event) => {
    if (event.defaultPrevented) return;
    // AltGr writes a character, which no command has. Windows reports Ctrl and Alt with it.
    if (event.getModifierState("AltGraph") && event.key !== "Escape") return;
    // Also with the keys held that change the gesture.
    const cancels = event.key === "Escape" || ((event.ctrlKey || event.metaKey) && keyOf(event).toLowerCase() === "z");
    if (cancels && gestures.cancel()) {
      event.preventDefault();
      return;
    }
    const { target } = event;
    const isClicked = planner.pointer !== null && target instanceof HTMLElement && isClickedControl(target);
    const inPlan = target === document.body || plans.includes(target as HTMLElement) || isClicked;
    const chord = chordOf(event);
    const inField = !isClicked && isOfField(target, chord);
    if (chord === "Space" && inPlan) {
      event.preventDefault();
      gestures.holdSpace(true);
      return;
    }
    if (clipboardChords.has(chord)) return;
    if (
      inPlan &&
      ((chord === "Backspace" && gestures.takeBack()) || (/^[\d.,]$/.test(event.key) && beginLength(event.key)))
    ) {
      event.preventDefault();
      return;
    }
    const place = { inField, inPlan, isBusy: gestures.isBusy };
    if (commands.press(chord, place) || commands.press(digitOf(event), place)) event.preventDefault();
  });
  document.addEventListener("pointerdown", () => commands.forgetRefusal(), { capture: true });
  document.addEventListener("keyup", (event) => {
    if (event.key === " ") gestures.holdSpace(false);
  });
  addEventListener("blur", () => gestures.holdSpace(false));

  const ours = (event: ClipboardEvent) =>
    !isField(event.target) && !gestures.isBusy && document.querySelector("dialog[open]") === null;
  const copy = (event: ClipboardEvent, isCut: boolean) => {
    if (!ours(event) || String(getSelection()) !== "") return;
    if (!copySelection(planner)) {
      planner.say(whyNoCopy(planner), true);
      return;
    }
    event.clipboardData?.setData("text/plain", toText(planner.clip));
    event.preventDefault();
    if (isCut && planner.document.locked === null) void deleteSelection(planner);
  };
  document.addEventListener("copy", (event) => copy(event, false));
  document.addEventListener("cut", (event) => copy(event, true));
  document.addEventListener("paste", (event) => {
    if (!ours(event)) return;
    // Elements may come from another tab; without text of ours, a table or a file, the last copies of this tab are meant.
    const typed = event.clipboardData?.getData("text/plain") ?? "";
    const clip = fromText(typed);
    // Spreadsheets give cells as a picture, too.
    const [file] =
      typed.includes("\t") && isTableText(typed)
        ? [new File([typed], "table.csv")]
        : (event.clipboardData?.files ?? []);
    if (!clip && file) {
      event.preventDefault();
      pasteFile(file);
      return;
    }
    planner.clip = clip ?? planner.clip;
    if (planner.clip.copied.length === 0) return;
    event.preventDefault();
    void paste(planner, planner.isPlan ? planner.pointer : null);
  });
}
