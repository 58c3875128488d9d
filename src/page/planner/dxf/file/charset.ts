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

export interface Charset {
  decode: Decode;
  /** False if there is no decoder for the code page. */
  isKnown: boolean;
}

/** `page`: as the header names it. `onInvalid` is called for each text that should be UTF-8 and is not. */
export function charsetOf(version: string, page: string | null, onInvalid: () => void): Charset {
  const declared = page === null ? null : decoderOf(page);
  const single = declared ?? new TextDecoder("windows-1252");
  const strict = new TextDecoder("utf-8", { fatal: true });
  const isUnicode = version >= unicode;
  // Many programs that write old versions name no code page, and write UTF-8.
  const triesUnicode = isUnicode || page === null;
  const decode = (bytes: Uint8Array): string => {
    const plain = ascii(bytes);
    if (plain !== null) return plain;
    if (triesUnicode)
      try {
        return strict.decode(bytes);
      } catch {
        if (isUnicode) onInvalid();
      }
    const text = single.decode(bytes);
    return single.encoding === "windows-1252" ? western(text) : text;
  };
  return { decode, isKnown: isUnicode || page === null || declared !== null };
}
