// Texts without their formatting.

const special: Readonly<Record<string, string>> = { d: "°", c: "Ø", p: "±", "%": "%" };
const pages: Readonly<Record<string, string>> = { 1: "shift_jis", 2: "big5", 3: "euc-kr", 5: "gbk" };

/** Characters that the code page lacks: \U+XXXX of Unicode, \M+nXXXX of another code page. */
export function characters(text: string): string {
  if (!text.includes("\\")) return text;
  return text
    .replace(/\\U\+([0-9a-f]{4})/gi, (_, code: string) => String.fromCharCode(Number.parseInt(code, 16)))
    .replace(/\\M\+([1235])([0-9a-f]{2})([0-9a-f]{2})/gi, (_, page: string, ...bytes: string[]) =>
      new TextDecoder(pages[page]).decode(Uint8Array.from(bytes.slice(0, 2), (byte) => Number.parseInt(byte, 16))),
    );
}

/** %%d and the like, and underlined or struck text. */
const symbols = (text: string): string =>
  text.replace(/%%(?:([dcp%])|([kou])|(\d{3}))/gi, (_, symbol?: string, style?: string, code?: string) => {
    if (symbol) return special[symbol.toLowerCase()];
    return style || !code ? "" : String.fromCharCode(Number(code));
  });

/** Control characters: ^I is a tab, "^ " is ^ itself. */
const carets = (text: string): string =>
  text.replace(/\^(.)/g, (_, one: string) => {
    if (one === " ") return "^";
    if (one === "I") return "\t";
    return one === "J" ? "\n" : "";
  });

export const plainText = (text: string): string => characters(symbols(carets(text)));

/**
 * Commands: of one letter; up to a semicolon; fractions; characters that are escaped; braces of groups. A command that
 * never ends is none, and is not searched beyond the next one: in a text of many, each would read the rest of the text.
 */
const formatting = /\\[PNX]|\\[LlOoKk]|\\S([^;]*);?|\\[ACcFfHQTWp][^;\\]*;|\\~|\\([\\{}])|[{}]/g;

export const plainParagraphs = (text: string): string =>
  symbols(
    carets(
      characters(text).replace(formatting, (command: string, fraction?: string, escaped?: string) => {
        if (escaped) return escaped;
        if (fraction !== undefined) return fraction.replace(/[#^]\s?/, "/");
        if (command === "\\~") return "\u00a0";
        return /^\\[PNX]/.test(command) ? "\n" : "";
      }),
    ),
  );
