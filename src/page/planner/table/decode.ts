// The text of a file: UTF-8 or UTF-16 by its mark, otherwise UTF-8, or an older encoding, which is guessed.

import { NotATable } from "./fault";

const marks: [string, number[]][] = [
  ["utf-8", [0xef, 0xbb, 0xbf]],
  ["utf-16le", [0xff, 0xfe]],
  ["utf-16be", [0xfe, 0xff]],
];

/** The ones that spreadsheets and databases write, the more frequent ones first. */
export const encodings = {
  "windows-1252": "Western (Windows-1252)",
  "windows-1250": "Central European (Windows-1250)",
  "windows-1251": "Cyrillic (Windows-1251)",
  cp850: "Western (DOS 850)",
  macintosh: "Western (Mac)",
  shift_jis: "Japanese (Shift-JIS)",
  gbk: "Chinese (GBK)",
  "windows-1253": "Greek (Windows-1253)",
  "windows-1254": "Turkish (Windows-1254)",
  "windows-1255": "Hebrew (Windows-1255)",
  "windows-1256": "Arabic (Windows-1256)",
  "euc-kr": "Korean (EUC-KR)",
  big5: "Chinese (Big5)",
} as const;
export type Encoding = keyof typeof encodings;

/** The letters of code page 850 from 0x80 on, which browsers do not know. */
const dos850 =
  "ÇüéâäàåçêëèïîìÄÅÉæÆôöòûùÿÖÜø£Ø×ƒáíóúñÑªº¿®¬½¼¡«»░▒▓│┤ÁÂÀ©╣║╗╝¢¥┐└┴┬├─┼ãÃ╚╔╩╦╠═╬¤ðÐÊËÈıÍÎÏ┘┌█▄¦Ì▀ÓßÔÒõÕµþÞÚÛÙýÝ¯´\u00ad±‗¾¶§÷¸°¨·¹³²■\u00a0";

function decodedAs(bytes: Uint8Array, encoding: Encoding): string {
  if (encoding !== "cp850") return new TextDecoder(encoding).decode(bytes);
  const text = new TextDecoder("windows-1252").decode(bytes.map((byte) => (byte < 0x80 ? byte : 0x2d)));
  let result = "";
  for (let k = 0; k < bytes.length; ++k) result += bytes[k] < 0x80 ? text[k] : dos850[bytes[k] - 0x80];
  return result;
}

const scripts = [
  /\p{Script=Latin}/u,
  /\p{Script=Cyrillic}/u,
  /\p{Script=Greek}/u,
  /\p{Script=Hebrew}/u,
  /\p{Script=Arabic}/u,
];
const scriptOf = (letter: string): number => scripts.findIndex((script) => script.test(letter));
const isUpper = (letter: string): boolean => letter !== letter.toLowerCase();

/** How likely a text is one that people wrote, by its letters that are not ASCII. */
function likelihoodOf(text: string): number {
  let sum = 0;
  for (const word of text.match(/[^\s\d;,|"()/.:_-]*[\u0080-\uffff][^\s\d;,|"()/.:_-]*/g) ?? []) {
    const letters = [...word];
    const known = new Set(letters.filter((letter) => /\p{L}/u.test(letter)).map(scriptOf));
    letters.forEach((letter, k) => {
      if (letter < "\x80") return;
      const before = letters[k - 1] ?? "";
      // Capitals within words, accents in a row, scripts side by side and symbols among letters are rare.
      const isOdd =
        !/\p{L}/u.test(letter) ||
        known.size > 1 ||
        (isUpper(letter) && before !== "" && !isUpper(before) && /\p{L}/u.test(before)) ||
        (scriptOf(letter) === 0 && before > "\x7f");
      sum += isOdd ? -1 : 0.5;
    });
    // Kana are in Japanese texts alone, and half of them in other encodings' misreadings.
    if (/[\u3040-\u30ff]/.test(word)) sum += 1;
    if (/[\uff61-\uff9f\ufffd]/.test(word)) sum -= 3;
  }
  return sum;
}

const sampled = 20_000; // bytes

function guessedEncoding(bytes: Uint8Array): Encoding {
  const names = Object.keys(encodings) as Encoding[];
  // Letters of one byte alone; texts in two bytes have half as many letters.
  const likely = names.map((name) => {
    const text = decodedAs(bytes.subarray(0, sampled), name);
    const share = ["shift_jis", "gbk", "big5", "euc-kr"].includes(name) ? 2 : 1;
    const value = likelihoodOf(text);
    return value > 0 ? share * value : value;
  });
  return names[likely.indexOf(Math.max(...likely))];
}

/**
 * Control characters, and U+FFFD, which stands for bytes that are no text. Some letters of files from DOS become the
 * control characters that are left out.
 */
const noText = /[^\P{Cc}\t\n\v\f\r\u0080-\u009f]|\ufffd/u;

function decoded(bytes: Uint8Array, chosen?: Encoding): { text: string; encoding?: Encoding } {
  for (const [encoding, mark] of marks)
    if (mark.every((byte, k) => bytes[k] === byte)) return { text: new TextDecoder(encoding).decode(bytes) };
  try {
    return { text: new TextDecoder("utf-8", { fatal: true }).decode(bytes) };
  } catch {
    const encoding = chosen ?? guessedEncoding(bytes);
    return { text: decodedAs(bytes, encoding), encoding };
  }
}

/** `encoding`: of a file that is not in UTF-8 or UTF-16, as `chosen` or guessed. Throws NotATable. */
export function textOf(bytes: Uint8Array, chosen?: Encoding): { text: string; encoding?: Encoding } {
  const { text: all, encoding } = decoded(bytes, chosen);
  // Files from DOS end with Ctrl-Z.
  const text = all.endsWith("\u001a") ? all.slice(0, -1) : all;
  // A person who chooses another encoding sees its letters.
  if (noText.test(chosen ? text.replaceAll("\ufffd", "") : text)) throw new NotATable("binary");
  return { text, encoding };
}
