// Numbers as the report writes them (report/text/words.cpp).

import { plural, say, type Plural } from "./text";

const isGerman = globalThis.document?.documentElement.lang === "de";

function localised(number: string): string {
  return isGerman ? number.replace(/[.,]/g, (mark) => (mark === "." ? "," : ".")) : number;
}

export function grouped(count: number): string {
  return localised(count.toFixed(0).replace(/\B(?=(\d{3})+$)/g, ","));
}

/** The text for a count, which is its {0}. */
export function counted(texts: Plural, count: number, ...values: string[]): string {
  return say(plural(texts, count), grouped(count), ...values);
}

export function fixed(value: number, decimals: number): string {
  const text = localised(Math.abs(value).toFixed(decimals));
  return value < 0 && /[1-9]/.test(text) ? `−${text}` : text;
}

export function significant(value: number, digits = 3): string {
  if (value === 0) return "0";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : value < 0 ? "−∞" : "–";
  const rounded = Number(value.toExponential(digits - 1));
  const exponent = Math.floor(Math.log10(Math.abs(rounded)) + 1e-12);
  if (exponent < -4 || exponent > 6) return `${fixed(rounded / 10 ** exponent, digits - 1)}·10^${exponent}`;
  return fixed(rounded, Math.max(0, digits - 1 - exponent));
}

export function percent(share: number, decimals = 1): string {
  return `${fixed(100 * share, decimals)}\u00a0%`;
}

/** The format of a confidence: `99 %`. */
export function percentage(share: number): string {
  return `${plain(100 * share)}\u00a0%`;
}

/** Up to six significant digits without trailing zeros. */
export function plain(value: number): string {
  const text = localised(String(Number(Math.abs(value).toPrecision(6))));
  return value < 0 && text !== "0" ? `−${text}` : text;
}

/** A finite margin, with two decimals if it would otherwise read as 0.0 dB. */
export function decibelText(value: number): string {
  const digits = fixed(value, Math.abs(value) < 0.095 ? 2 : 1);
  return `${value > 0 && digits !== "0.00" ? "+" : ""}${digits}\u00a0dB`;
}
