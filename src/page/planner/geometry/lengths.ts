// Lengths as people type them: 1.33, 3*1.33, 180cm, 6ft, 5'11", 12'-6 1/2", 2m + 40cm.

import { numberAt, plainSigned, type WrittenNumber } from "./written_number";

const metres: Record<NonNullable<WrittenNumber["unit"]>, number> = {
  m: 1,
  cm: 0.01,
  mm: 0.001,
  ft: 0.3048,
  in: 0.0254,
};

/** `length`: 1 for a length in m, 0 for a number without a unit. `only`: the unit of a number that stands alone. */
interface Quantity {
  value: number;
  length: 0 | 1;
  only?: WrittenNumber["unit"];
}

/** sum = product {(+ | -) product}, product = factor {(* | /) factor}, factor = number [unit] ... | ( sum ) | - factor */
class Parser {
  private at = 0;
  hasUnclear = false;

  constructor(
    private readonly text: string,
    /** The length of a number without a unit next to lengths, m. */
    private readonly unit: number,
    /** How unclear numbers are read. */
    private readonly reads: "decimals" | "thousands",
  ) {}

  parse(): Quantity | null {
    const sum = this.sum();
    this.skipBlanks();
    return this.at === this.text.length ? sum : null;
  }

  private skipBlanks(): void {
    while (this.text[this.at] === " " || this.text[this.at] === "\t") ++this.at;
  }

  private take(...wanted: string[]): string | null {
    this.skipBlanks();
    return wanted.includes(this.text[this.at]) ? this.text[this.at++] : null;
  }

  private metres({ value, length }: Quantity): number {
    return length === 1 ? value : value * this.unit;
  }

  private sum(): Quantity | null {
    let left = this.product();
    for (let sign = this.take("+", "-"); left && sign; sign = this.take("+", "-")) {
      const right = this.product();
      if (!right) return null;
      const factor = sign === "+" ? 1 : -1;
      // 12' - 6" may be 12 ft 6 in.
      if (factor < 0 && left.only === "ft" && right.only === "in") return null;
      left =
        left.length === right.length
          ? { value: left.value + factor * right.value, length: left.length }
          : { value: this.metres(left) + factor * this.metres(right), length: 1 };
    }
    return left;
  }

  private product(): Quantity | null {
    let left = this.factor();
    for (let sign = this.take("*", "×", "x", "/"); left && sign; sign = this.take("*", "×", "x", "/")) {
      const right = this.factor();
      if (!right) return null;
      if (sign === "/" && (right.value === 0 || right.length > left.length)) return null;
      if (sign !== "/" && left.length + right.length > 1) return null;
      left =
        sign === "/"
          ? { value: left.value / right.value, length: (left.length - right.length) as 0 | 1 }
          : { value: left.value * right.value, length: (left.length + right.length) as 0 | 1 };
    }
    return left;
  }

  private factor(): Quantity | null {
    if (this.take("-")) {
      const inner = this.factor();
      return inner && { ...inner, value: -inner.value };
    }
    this.take("+");
    if (this.take("(")) {
      const inner = this.sum();
      return this.take(")") ? inner : null;
    }
    return this.number();
  }

  /** A number with its unit; several of them add up, as in 2 m 40 cm. */
  private number(): Quantity | null {
    const parts: number[] = [];
    let only: WrittenNumber["unit"];
    for (this.skipBlanks(); /[\d.,]/.test(this.text[this.at] ?? ""); this.skipBlanks()) {
      const found = numberAt(this.text, this.at);
      if (!found) return null;
      const { value, grouped, unit } = found.number;
      this.at = found.end;
      if (grouped !== undefined) this.hasUnclear = true;
      const read = this.reads === "thousands" ? (grouped ?? value) : value;
      if (unit === undefined) return parts.length === 0 ? { value: read, length: 0 } : null;
      parts.push(read * metres[unit]);
      only = parts.length === 1 ? unit : undefined;
    }
    return parts.length === 0 ? null : { value: parts.reduce((sum, part) => sum + part), length: 1, only };
  }
}

/** The values that a text may stand for: two with an unclear number, such as 1,250. */
function readingsOf(text: string, unit: number): Quantity[] {
  const plain = plainSigned(text);
  const parsed = (reads: "decimals" | "thousands") => {
    const parser = new Parser(plain, unit, reads);
    const found = parser.parse();
    return { found: found && Number.isFinite(found.value) ? found : null, hasUnclear: parser.hasUnclear };
  };
  const { found, hasUnclear } = parsed("decimals");
  const other = hasUnclear ? parsed("thousands").found : null;
  return [found, other].flatMap((one) => one ?? []);
}

/** Lengths from here on are not typed with marks of thousands, so 1.250 m is no unclear number. */
const longest = 1000; // m

/** The lengths in a unit (its length in m) that a text may stand for; none if it is no length. */
export function lengthsOf(text: string, unit: number): number[] {
  const found = readingsOf(text, unit).map(({ value, length }) => (length === 1 ? value / unit : value));
  // No country separates thousands of feet or inches by points.
  const isImperial = unit === metres.ft || unit === metres.in;
  if (isImperial && !text.includes(",")) return found.slice(0, 1);
  return found.filter((value, k) => k === 0 || Math.abs(value * unit) < longest);
}

/** The numbers, or values of sums or products of numbers, that a text may stand for. */
export const numbersOf = (text: string): number[] =>
  readingsOf(text.replace(/\s*(°|deg)\s*$/, ""), 1)
    .filter(({ length }) => length === 0)
    .map(({ value }) => value);

const single = (found: number[]): number | null => (found.length === 1 ? found[0] : null);

/** Null if the text is no length in a unit (its length in m), or may be two. */
export const parseLength = (text: string, unit: number): number | null => single(lengthsOf(text, unit));

/** A number or a sum or product of numbers; null if the text may be two. */
export const parseNumber = (text: string): number | null => single(numbersOf(text));
