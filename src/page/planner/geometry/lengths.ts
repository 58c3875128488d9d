// Lengths as people type them: 1.33, 3*1.33, 180cm, 6ft, 5'11", 2m + 40cm.

const metres: Record<string, number> = {
  m: 1,
  cm: 0.01,
  mm: 0.001,
  km: 1000,
  ft: 0.3048,
  in: 0.0254,
  "'": 0.3048,
  '"': 0.0254,
  "′": 0.3048,
  "″": 0.0254,
};

/** `length`: 1 for a length in m, 0 for a number without a unit. */
interface Quantity {
  value: number;
  length: 0 | 1;
}

const tokenPattern = /\s*(?:(\d+(?:[.,]\d*)?(?:e-?\d+)?|[.,]\d+)|(km|mm|cm|ft|in|m|'|"|′|″)|([-−+*/×x()]))/giy;

function tokensOf(text: string): string[] | null {
  const tokens: string[] = [];
  tokenPattern.lastIndex = 0;
  const trimmed = text.trim();
  while (tokenPattern.lastIndex < trimmed.length) {
    const found = tokenPattern.exec(trimmed);
    if (!found) return null;
    tokens.push(found[0].trim().toLowerCase());
  }
  return tokens;
}

/** sum = product {(+ | -) product}, product = factor {(* | /) factor}, factor = number [unit] ... | ( sum ) | - factor */
class Parser {
  private at = 0;

  constructor(
    private readonly tokens: string[],
    /** The length of a number without a unit next to lengths, m. */
    private readonly unit: number,
  ) {}

  parse(): Quantity | null {
    const sum = this.sum();
    return this.at === this.tokens.length ? sum : null;
  }

  private take(...wanted: string[]): string | null {
    return wanted.includes(this.tokens[this.at]) ? this.tokens[this.at++] : null;
  }

  private metres({ value, length }: Quantity): number {
    return length === 1 ? value : value * this.unit;
  }

  private sum(): Quantity | null {
    let left = this.product();
    for (let sign = this.take("+", "-", "−"); left && sign; sign = this.take("+", "-", "−")) {
      const right = this.product();
      if (!right) return null;
      const factor = sign === "+" ? 1 : -1;
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
    if (this.take("-", "−")) {
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

  /** A number with its unit; several of them add up, as in 5'11". */
  private number(): Quantity | null {
    let total: number | null = null;
    while (/^[\d.,]/.test(this.tokens[this.at] ?? "")) {
      const value = Number(this.tokens[this.at++].replace(",", "."));
      const unit = this.take(...Object.keys(metres));
      if (unit === null) return total === null ? { value, length: 0 } : null;
      total = (total ?? 0) + value * metres[unit];
    }
    return total === null ? null : { value: total, length: 1 };
  }
}

/** A length in a unit (its length in m); null if the text is no length. */
export function parseLength(text: string, unit: number): number | null {
  const tokens = tokensOf(text);
  const found = tokens?.length ? new Parser(tokens, unit).parse() : null;
  if (!found || !Number.isFinite(found.value)) return null;
  return found.length === 1 ? found.value / unit : found.value;
}

/** A number or a sum or product of numbers. */
export function parseNumber(text: string): number | null {
  const tokens = tokensOf(text.replace(/\s*(°|deg)\s*$/, ""));
  const found = tokens?.length ? new Parser(tokens, 1).parse() : null;
  return found && found.length === 0 && Number.isFinite(found.value) ? found.value : null;
}
