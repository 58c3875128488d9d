// Tests which command a key means on keyboards of other layouts.

import assert from "node:assert/strict";
import { test } from "node:test";

import { chordOf } from "../../../../src/page/planner/access/keys.ts";

Object.defineProperty(globalThis, "navigator", { value: { platform: "Linux" }, configurable: true });

/** `written`: what the layout writes, with the keys that are held before it. */
function chord(written, code) {
  const held = written.match(/^(?:(?:Ctrl|Shift|Alt)\+(?=.))*/)[0];
  const [ctrlKey, shiftKey, altKey] = ["Ctrl", "Shift", "Alt"].map((name) => held.includes(name));
  return chordOf({ key: written.slice(held.length), code, ctrlKey, metaKey: false, shiftKey, altKey });
}

for (const [what, keys] of Object.entries({
  "letters of other scripts are meant by their place": [
    ["ц", "KeyW", "W"], // Russian
    ["Ctrl+я", "KeyZ", "Ctrl+Z"],
    ["Ctrl+Shift+Я", "KeyZ", "Ctrl+Shift+Z"],
    ["ς", "KeyW", "W"], // Greek
    ["Ctrl+ש", "KeyA", "Ctrl+A"], // Hebrew
    ["Ctrl+ئ", "KeyZ", "Ctrl+Z"], // Arabic
    ["لا", "KeyB", "B"], // one key, two letters
    ["Shift+ٌ", "KeyR", "Shift+R"], // a mark
    ["۲", "Digit2", "2"], // Persian
    ["ә", "Digit2", "2"], // Kazakh
    ["х", "BracketLeft", "Х"], // no letter on an English keyboard, so no command
  ],
  "Latin layouts that place letters elsewhere are meant by what they write": [
    ["Ctrl+z", "KeyY", "Ctrl+Z"], // QWERTZ
    ["Ctrl+y", "KeyZ", "Ctrl+Y"],
    ["Ctrl+a", "KeyQ", "Ctrl+A"], // AZERTY
    ["Ctrl+z", "KeyW", "Ctrl+Z"],
    ["m", "Semicolon", "M"],
    [",", "KeyM", ","],
    [",", "KeyW", ","], // Dvorak
    ["Ctrl+;", "KeyZ", "Ctrl+;"],
    ["ß", "Minus", "SS"],
    ["ı", "KeyI", "I"], // Turkish
    ["Enter", "Enter", "Enter"],
    ["Dead", "BracketLeft", "Dead"],
  ],
  "symbols on letter keys are meant by their place after a letter of another script": [
    ["v", "KeyV", "V"],
    ["'", "KeyW", "'"],
    ["ש", "KeyA", "A"],
    ["'", "KeyW", "W"], // Hebrew
    ["/", "KeyQ", "Q"],
    ["/", "Slash", "/"],
    ["-", "Minus", "-"],
    ["Ctrl+z", "KeyZ", "Ctrl+Z"], // macOS gives Latin letters with its command key
    ["'", "KeyW", "W"],
    ["v", "KeyV", "V"],
    ["'", "KeyW", "'"],
  ],
  "plus, minus, question mark and digits are found on other layouts and the number pad": [
    ["+", "NumpadAdd", "+"],
    ["-", "NumpadSubtract", "-"],
    ["1", "Numpad1", "1"],
    ["+", "BracketRight", "+"], // German
    ["Shift++", "Digit1", "+"], // Swiss
    ["Shift++", "Equal", "+"],
    ["-", "Digit6", "-"], // French
    ["-", "Slash", "-"], // German
    ["Shift+?", "Minus", "?"], // German
    ["Shift+?", "Digit7", "?"], // Russian
    ["Shift+/", "Digit7", "/"], // German
    ["Shift+@", "Digit2", "Shift+2"], // English
    ['Shift+"', "Digit2", "Shift+2"], // German
  ],
}))
  test(what, () => {
    for (const [written, code, expected] of keys) assert.equal(chord(written, code), expected, written);
  });
