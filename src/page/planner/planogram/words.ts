// Words in comparable form.

/** Lower case without accents. */
export const plain = (text: string): string =>
  text.toLowerCase().replaceAll("ß", "ss").normalize("NFKD").replace(/\p{M}/gu, "");

/** Letters and digits alone, numbers without leading zeros. */
export const squashed = (text: string): string =>
  plain(text)
    .replace(/(?<!\d)0+(?=\d)/g, "")
    .replace(/[^\p{L}\p{N}]/gu, "");
