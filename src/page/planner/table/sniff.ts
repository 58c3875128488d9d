// Whether a file is a table, from its name and its first bytes.

const sniffed = 4096; // bytes

export const isTableName = (name: string): boolean => /\.(csv|tsv|tab|txt)$/i.test(name);

export function isTable(name: string, bytes: Uint8Array): boolean {
  if (isTableName(name)) return true;
  const isWide = bytes[0] + bytes[1] === 0xff + 0xfe && bytes[0] >= 0xfe;
  const encoding = isWide ? (bytes[0] === 0xff ? "utf-16le" : "utf-16be") : "windows-1252";
  return isTableText(new TextDecoder(encoding).decode(bytes.subarray(0, sniffed)));
}

/** Whether its first two lines have the same separator; JSON and HTML have commas, too. */
export function isTableText(text: string): boolean {
  if (/[^\P{Cc}\t\n\v\f\r\u0080-\u009f]/u.test(text) || /^\s*[{[<]/.test(text)) return false;
  const [first = "", second = ""] = text.split(/\r\n|\r|\n/).filter((line) => line.trim() !== "");
  return ["\t", ";", ",", "|"].some((separator) => first.includes(separator) && second.includes(separator));
}
