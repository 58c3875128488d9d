// Splits the text of a table into records (RFC 4180: fields may be quoted, also over several lines).

export interface Line {
  /** Where it begins in the file, from 1. */
  line: number;
  fields: string[];
  /** A quote is not closed, or text follows it: `fields` has the whole line. */
  isBroken?: boolean;
}

/** A longer field has lost its closing quote. */
const longestField = 10_000;

const endsLine = (text: string, at: number): boolean => text[at] === "\n" || text[at] === "\r";

function endOfField(text: string, from: number, separator: string): number {
  let at = from;
  while (at < text.length && text[at] !== separator && !endsLine(text, at)) ++at;
  return at;
}

function endOfLine(text: string, from: number): number {
  let at = from;
  while (at < text.length && !endsLine(text, at)) ++at;
  return at;
}

/** The place of the closing quote; -1 without one. */
function closingQuote(text: string, from: number): number {
  for (let at = text.indexOf('"', from); at >= 0 && at - from <= longestField; at = text.indexOf('"', at + 2))
    if (text[at + 1] !== '"') return at;
  return -1;
}

const linesIn = (text: string): number => text.match(/\r\n|\r|\n/g)?.length ?? 0;

class Splitter {
  private at = 0;
  private line = 1;

  constructor(
    private readonly text: string,
    private readonly separator: string,
  ) {}

  /** Null at the end. */
  next(): Line | null {
    const { text } = this;
    if (this.at >= text.length) return null;
    const [start, line] = [this.at, this.line];
    let fields = this.fields();
    const isBroken = fields === null;
    if (fields === null) {
      // The quote is a mistake of this line alone.
      this.at = endOfLine(text, start);
      this.line = line;
      fields = [text.slice(start, this.at).trim()];
    }
    if (this.at < text.length) {
      this.at += text.startsWith("\r\n", this.at) ? 2 : 1;
      ++this.line;
    }
    return isBroken ? { line, fields, isBroken } : { line, fields };
  }

  /** Null if a quoted field is broken. */
  private fields(): string[] | null {
    const { text, separator } = this;
    const blanks = separator === "\t" ? " " : " \t";
    const fields: string[] = [];
    for (;;) {
      let first = this.at;
      while (first < text.length && blanks.includes(text[first])) ++first;
      if (text[first] === '"') {
        const close = closingQuote(text, first + 1);
        if (close < 0) return null;
        const content = text.slice(first + 1, close);
        this.at = endOfField(text, close + 1, separator);
        if (text.slice(close + 1, this.at).trim() !== "") return null;
        this.line += linesIn(content);
        fields.push(content.replaceAll('""', '"').trim());
      } else {
        const end = endOfField(text, this.at, separator);
        fields.push(text.slice(this.at, end).trim());
        this.at = end;
      }
      if (this.at >= text.length || endsLine(text, this.at)) return fields;
      ++this.at;
    }
  }
}

/** All lines that are not empty, at most `most`. */
export function splitLines(text: string, separator: string, most = Infinity): Line[] {
  const splitter = new Splitter(text, separator);
  const lines: Line[] = [];
  for (let line = splitter.next(); line && lines.length < most; line = splitter.next())
    if (line.fields.some((field) => field !== "")) lines.push(line);
  return lines;
}
