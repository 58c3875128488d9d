// Keys and chords by name: "V", "Ctrl+Shift+Z", "Shift+2", "?".

const isMac = () => navigator.platform.startsWith("Mac");

/** Characters that some keyboards write with Shift or Alt: their name is the character. */
const isSymbol = (key: string) => key.length === 1 && !/[\p{L}\d ]/u.test(key);

/** Whether the last letter was not Latin: then symbols on letter keys, as on Q and W in Hebrew, are not meant either. */
let isOtherScript = false;

/** What a key writes; where it writes no Latin letters, what it writes at its place on an English keyboard. */
export function keyOf({ key, code, ctrlKey, metaKey }: KeyboardEvent): string {
  const isLatin = /^\p{Script=Latin}/u.test(key); // also "Enter"
  const isOther = !isLatin && /^(?:[\p{L}\p{M}]+|(?!\d)\p{Nd})$/u.test(key); // one key writes "\u0644\u0627"
  // With a command key, some systems give Latin letters.
  if (isOther || (isLatin && key.length === 1 && !ctrlKey && !metaKey)) isOtherScript = isOther;
  const place = /^(Key|Digit)(.)$/.exec(code);
  return place && (isOther || (isOtherScript && !isLatin && place[1] === "Key")) ? place[2] : key;
}

export function chordOf(event: KeyboardEvent): string {
  const { code } = event;
  const key = keyOf(event);
  const command = isMac() ? event.metaKey : event.ctrlKey;
  const digit = /^Digit(\d)$/.exec(code)?.[1];
  if (isSymbol(key) && (/[?/+=-]/.test(key) || !digit)) return `${command ? "Ctrl+" : ""}${key}`;
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
