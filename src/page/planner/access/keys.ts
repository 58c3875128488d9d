// Keys and chords by name: "V", "Ctrl+Shift+Z", "Shift+2", "?".

const isMac = () => navigator.platform.startsWith("Mac");

/** Characters that some keyboards write with Shift or Alt: their name is the character. */
const isSymbol = (key: string) => key.length === 1 && !/[\p{L}\d ]/u.test(key);

export function chordOf(event: KeyboardEvent): string {
  const { key, code } = event;
  const command = isMac() ? event.metaKey : event.ctrlKey;
  const digit = /^Digit(\d)$/.exec(code)?.[1];
  if (isSymbol(key) && (key === "?" || key === "/" || !digit)) return `${command ? "Ctrl+" : ""}${key}`;
  const name = digit && event.shiftKey ? digit : key === " " ? "Space" : key.length === 1 ? key.toUpperCase() : key;
  return `${command ? "Ctrl+" : ""}${event.altKey ? "Alt+" : ""}${event.shiftKey ? "Shift+" : ""}${name}`;
}

const arrows: Record<string, string> = { ArrowLeft: "←", ArrowRight: "→", ArrowUp: "↑", ArrowDown: "↓" };

/** As people read it. */
export const chordText = (chord: string): string =>
  chord.replace(/Arrow\w+$/, (name) => arrows[name] ?? name).replace("Ctrl", isMac() ? "⌘" : "Ctrl");

/** Whether a chord belongs to a field that has the focus. A field without a new text has nothing to undo. */
export function isOfField(target: EventTarget | null, chord: string): boolean {
  if (!isField(target)) return false;
  const isUnchanged =
    target instanceof HTMLSelectElement ||
    (target instanceof HTMLInputElement && target.value === target.dataset.shown && target.ariaInvalid !== "true");
  return !(isUnchanged && ["Ctrl+Z", "Ctrl+Y", "Ctrl+Shift+Z"].includes(chord));
}

export function isField(target: EventTarget | null): boolean {
  if (target instanceof HTMLInputElement) return !["checkbox", "radio", "button"].includes(target.type);
  return target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement;
}
