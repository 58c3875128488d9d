// The texts of a file, by its version and code page.

export type Decode = (bytes: Uint8Array) => string;

/** From this version on, files are UTF-8. */
const unicode = "AC1021";

/** Code pages whose names TextDecoder does not know as they are. */
const labels: Readonly<Record<string, string>> = {
  ascii: "windows-1252",
  dos866: "ibm866",
  dos932: "shift_jis",
  johab: "",
  ksc5601: "euc-kr",
  "mac-roman": "macintosh",
  "874": "windows-874",
  "932": "shift_jis",
  "936": "gbk",
  "949": "euc-kr",
  "950": "big5",
};

/** The characters 128 to 159 of Windows-1252, which some versions of Node.js do not decode. */
const upper = "€\u0081‚ƒ„…†‡ˆ‰Š‹Œ\u008dŽ\u008f\u0090‘’“”•–—˜™š›œ\u009džŸ";
const western = (text: string): string =>
  text.replace(/[\u0080-\u009f]/g, (control) => upper[control.charCodeAt(0) - 128]);

/** Null if there is none. */
function decoderOf(page: string): TextDecoder | null {
  const name = page.toLowerCase().replace("_", "-");
  const number = /^(?:ansi|dos|cp|windows)-?(\d+)$/.exec(name)?.[1] ?? "";
  const label = labels[name] ?? labels[number] ?? (/^125\d$/.test(number) ? `windows-${number}` : name);
  try {
    return new TextDecoder(label);
  } catch {
    return null;
  }
}

function ascii(bytes: Uint8Array): string | null {
  if (bytes.length > 1024) return null;
  for (const byte of bytes) if (byte > 127) return null;
  return String.fromCharCode(...bytes);
}

const chunk = 65_536;

/** Whether a file is UTF-8 with at least so many bytes that are not the first ones of their characters. */
function isUtf8(file: Uint8Array, least: number): boolean {
  const strict = new TextDecoder("utf-8", { fatal: true });
  let more = file.length;
  try {
    for (let at = 0; at < file.length; at += chunk)
      more -= strict.decode(file.subarray(at, at + chunk), { stream: true }).length;
    return more - strict.decode().length >= least;
  } catch {
    return false;
  }
}

/** `page`: as the header names it. `note` is called for what is doubtful about a text that is not ASCII. */
export function charsetOf(
  version: string,
  page: string | null,
  file: Uint8Array,
  note: (code: "not_utf8" | "code_page" | "utf8") => void,
): Decode {
  const declared = page === null ? null : decoderOf(page);
  const single = declared ?? new TextDecoder("windows-1252");
  const strict = new TextDecoder("utf-8", { fatal: true });
  const isUnicode = version >= unicode || declared?.encoding === "utf-8";
  let isMistaken: boolean | null = null;
  /** Many programs write UTF-8 and name a code page. All texts of a file in that page are hardly UTF-8 by chance. */
  const isPageMistaken = (): boolean => {
    if (isMistaken !== null) return isMistaken;
    // A few characters of two bytes may be.
    isMistaken = isUtf8(file, /^windows-125/.test(single.encoding) ? 1 : 4);
    if (isMistaken) note("utf8");
    else if (!declared) note("code_page");
    return isMistaken;
  };
  return (bytes) => {
    const plain = ascii(bytes);
    if (plain !== null) return plain;
    // Others that write old versions name no code page.
    if (isUnicode || page === null || isPageMistaken())
      try {
        return strict.decode(bytes);
      } catch {
        if (isUnicode) note("not_utf8");
      }
    const text = single.decode(bytes);
    return single.encoding === "windows-1252" ? western(text) : text;
  };
}
