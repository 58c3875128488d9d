// The text of a file: UTF-8 or UTF-16 by its mark, otherwise UTF-8, or Windows-1252 as old spreadsheets write it.

import { NotATable } from "./fault";

const marks: [string, number[]][] = [
  ["utf-8", [0xef, 0xbb, 0xbf]],
  ["utf-16le", [0xff, 0xfe]],
  ["utf-16be", [0xfe, 0xff]],
];

/**
 * Control characters, and U+FFFD, which stands for bytes that are no text. Some letters of files from DOS become the
 * control characters that are left out.
 */
const noText = /[^\P{Cc}\t\n\v\f\r\u0080-\u009f]|\ufffd/u;

function decoded(bytes: Uint8Array): string {
  for (const [encoding, mark] of marks)
    if (mark.every((byte, k) => bytes[k] === byte)) return new TextDecoder(encoding).decode(bytes);
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch {
    return new TextDecoder("windows-1252").decode(bytes);
  }
}

/** Throws NotATable. */
export function textOf(bytes: Uint8Array): string {
  const all = decoded(bytes);
  // Files from DOS end with Ctrl-Z.
  const text = all.endsWith("\u001a") ? all.slice(0, -1) : all;
  if (noText.test(text)) throw new NotATable("binary");
  return text;
}
