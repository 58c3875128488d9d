// Numbers as people write them, by the rules of the program (src/shelfbeam/base/written_number.hpp);
// test/data/written_numbers.tsv has cases for both.

export type Mark = "." | ",";

export interface WrittenNumber {
  /** Of an unclear number, that with decimals. */
  value: number;
  /** Of an unclear number, as 1,250, that with thousands. */
  grouped?: number;
  /** Of length; of 12'-6", in. */
  unit?: "m" | "cm" | "mm" | "ft" | "in";
  /** The decimal mark, if the number shows it. */
  mark?: Mark;
}

const plainSigns: [RegExp, string][] = [
  [/\u2212/g, "-"],
  [/[\u2032\u2019]/g, "'"],
  [/[\u2033\u201c\u201d]|''/g, '"'],
  [/[\u00a0\u2009\u202f]/g, " "],
];

/** Signs, marks and blanks of typography as those of a keyboard, in lower case. */
export const plainSigned = (text: string): string =>
  plainSigns
    .reduce((plain, [sign, own]) => plain.replace(sign, own), text)
    .trim()
    .toLowerCase();

const units: Record<string, WrittenNumber["unit"]> = {
  mm: "mm",
  cm: "cm",
  m: "m",
  feet: "ft",
  foot: "ft",
  "ft.": "ft",
  ft: "ft",
  "'": "ft",
  inches: "in",
  inch: "in",
  "in.": "in",
  in: "in",
  '"': "in",
};

const digitsPattern = /[1-9]\d{0,2}(?:[ ']\d{3}(?!\d|\/))+(?:[.,]\d*)?|[\d.,]*\d[\d.,]*(?:e[-+]?\d+)?/y;
const fractionPattern = /(?: (\d{1,3}))?\/(\d{1,3})(?!\d)/y;
const unitPattern = / ?(mm|cm|m|feet|foot|ft\.|ft|inches|inch|in\.|in)(?![a-z])| ?(['"])/y;

function matchAt(pattern: RegExp, text: string, at: number): RegExpExecArray | null {
  pattern.lastIndex = at;
  return pattern.exec(text);
}

/** Digits with marks; null if the marks make no number. */
function decimalsOf(text: string): WrittenNumber | null {
  const joined = text.replace(/[ ']/g, "");
  const isGrouped = joined !== text;
  const [digits, exponent = ""] = joined.split(/(?=e)/);
  const marks = digits.replace(/\d/g, "");
  if (marks === "") return { value: Number(joined) };
  const last = marks.at(-1) as Mark;
  if (marks.length === 1) {
    const value = Number(digits.replace(",", ".") + exponent);
    const isUnclear = !isGrouped && exponent === "" && /^[1-9]\d{0,2}[.,]\d{3}$/.test(digits);
    return { value, mark: last, ...(isUnclear ? { grouped: Number(digits.replace(last, "")) } : {}) };
  }
  // Several marks of one kind separate thousands; of two kinds, the last one is the decimal mark.
  const thousands = marks[0] === "." ? /^\d{1,3}(\.\d{3})+(,\d*)?$/ : /^\d{1,3}(,\d{3})+(\.\d*)?$/;
  if (isGrouped || !thousands.test(digits)) return null;
  const mark = marks[0] === "." ? "," : ".";
  return { value: Number(digits.replaceAll(marks[0], "").replace(",", ".") + exponent), mark };
}

interface Scanned {
  number: WrittenNumber;
  end: number;
}

/** A number with its unit, if it has one. */
function partAt(text: string, at: number): Scanned | null {
  const found = matchAt(digitsPattern, text, at)?.[0];
  const number = found === undefined ? null : decimalsOf(found);
  if (found === undefined || !number || !Number.isFinite(number.value)) return null;
  let end = at + found.length;
  let isFraction = false;
  const fraction = /^\d+$/.test(found) ? matchAt(fractionPattern, text, end) : null;
  if (fraction) {
    const [all, above, below] = fraction;
    const [whole, numerator] = above === undefined ? [0, number.value] : [number.value, Number(above)];
    isFraction = numerator < Number(below) && numerator < 1000;
    if (isFraction) {
      number.value = whole + numerator / Number(below);
      end += all.length;
    }
  }
  const unit = matchAt(unitPattern, text, end);
  if (!unit) return { number, end };
  number.unit = units[unit[0].trim()];
  const isImperial = number.unit === "ft" || number.unit === "in";
  // 1'250" is not a number of thousands, 1/2 m may be a division, and no country separates thousands of feet or inches by points.
  if (isImperial ? found.includes("'") : isFraction) return null;
  if (isImperial && number.mark === ".") delete number.grouped;
  return { number, end: end + unit[0].length };
}

/**
 * The number at a place of a text in plain signs. 12'-6" and 12' 6 1/2" are one number; 12'-6, which may be a difference,
 * is none.
 */
export function numberAt(text: string, at: number): Scanned | null {
  const feet = partAt(text, at);
  if (feet?.number.unit !== "ft") return feet;
  const dash = text[feet.end] === "-" ? 1 : 0;
  const inches = partAt(text, feet.end + (dash || Number(text[feet.end] === " ")));
  if (!inches || (inches.number.unit !== "in" && inches.number.unit !== undefined)) return feet;
  const { value, mark, grouped, unit } = inches.number;
  if (unit === undefined) return dash ? null : feet;
  if (feet.number.mark !== undefined || grouped !== undefined || value >= 12) return null;
  return { number: { value: 12 * feet.number.value + value, unit: "in", mark }, end: inches.end };
}

/** Null for a text that is not a number. */
export function writtenNumber(text: string): WrittenNumber | null {
  if (/^\d+$/.test(text)) return { value: Number(text) };
  const plain = plainSigned(text);
  const sign = plain.startsWith("-") ? -1 : 1;
  const from = plain.startsWith("-") || plain.startsWith("+") ? 1 : 0;
  const found = numberAt(plain, from);
  if (found?.end !== plain.length) return null;
  const { value, grouped, ...others } = found.number;
  return { value: sign * value, ...(grouped === undefined ? {} : { grouped: sign * grouped }), ...others };
}
