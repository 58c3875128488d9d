// The groups of a DXF file, which are pairs of lines: a code, and a value. They stay bytes until a value is wanted,
// because large drawings have millions.

import { DxfError } from "../error";
import { characters } from "../text";
import type { Decode } from "./charset";

const [tab, newline, carriageReturn, space, plus, minus, dot] = [9, 10, 13, 32, 43, 45, 46];
const highestCode = 1071;
/** Exact as doubles. */
const powers = Array.from({ length: 23 }, (_, exponent) => 10 ** exponent);
const power = (exponent: number): number => (exponent < powers.length ? powers[exponent] : 10 ** exponent);

const isBlank = (byte: number): boolean => byte === space || byte === tab;

export class Groups {
  /** Of the group that was read last. */
  code = -1;
  /** The line of its code. */
  line = -1;
  private start = 0;
  private end = 0;
  private next: number;
  private readonly names = new Map<number, { start: number; end: number; name: string }>();

  constructor(
    private readonly bytes: Uint8Array,
    begin: number,
    private decode: Decode,
  ) {
    this.next = begin;
  }

  decodeBy(decode: Decode): void {
    this.decode = decode;
    this.names.clear();
  }

  /** Reads the next group. */
  advance(): void {
    const { bytes } = this;
    const { length } = bytes;
    this.line += 2;
    let at = this.next;
    while (at < length && isBlank(bytes[at])) ++at;
    const first = at;
    let code = 0;
    for (; at < length && bytes[at] >= 48 && bytes[at] <= 57; ++at) code = 10 * code + bytes[at] - 48;
    const hasDigits = at > first;
    while (at < length && isBlank(bytes[at])) ++at;
    if (at >= length) throw new DxfError("truncated", { line: this.line });
    if (!hasDigits || code > highestCode || (bytes[at] !== newline && bytes[at] !== carriageReturn))
      throw new DxfError("bad_code", { line: this.line });
    this.code = code;
    at = this.start = this.afterLineEnd(at);
    while (at < length && bytes[at] !== newline && bytes[at] !== carriageReturn) ++at;
    this.end = at;
    if (at < length) this.next = this.afterLineEnd(at);
    // Only the last line of all may lack its end.
    else if (this.isAt("EOF")) this.next = at;
    else throw new DxfError("truncated", { line: at > this.start ? this.line + 1 : this.line });
  }

  private afterLineEnd(at: number): number {
    return this.bytes[at] === carriageReturn && this.bytes[at + 1] === newline ? at + 2 : at + 1;
  }

  /** Whether the group begins an entity, section or the like, of this type. */
  isAt(type: string): boolean {
    return this.code === 0 && this.name() === type;
  }

  /** The value without blanks around it, and with the characters that its code page lacks. Equal values are one string. */
  name(): string {
    let { start, end } = this;
    const { bytes } = this;
    while (start < end && isBlank(bytes[start])) ++start;
    while (start < end && isBlank(bytes[end - 1])) --end;
    let hash = end - start;
    for (let at = start; at < end; ++at) hash = Math.imul(hash ^ bytes[at], 0x01000193);
    const known = this.names.get(hash);
    if (known && this.isSame(known, start, end)) return known.name;
    const name = characters(this.decode(bytes.subarray(start, end)));
    this.names.set(hash, { start, end, name });
    return name;
  }

  private isSame(known: { start: number; end: number }, start: number, end: number): boolean {
    if (known.end - known.start !== end - start) return false;
    for (let at = start, other = known.start; at < end; ++at, ++other)
      if (this.bytes[at] !== this.bytes[other]) return false;
    return true;
  }

  text(): string {
    return this.decode(this.bytes.subarray(this.start, this.end));
  }

  /** The value as a number: of its digits, those that a double can hold. */
  number(): number {
    const { bytes, end } = this;
    let at = this.start;
    while (at < end && isBlank(bytes[at])) ++at;
    const isNegative = bytes[at] === minus;
    if (isNegative || bytes[at] === plus) ++at;
    let [mantissa, exponent, digits] = [0, 0, 0];
    let hasDot = false;
    for (; at < end; ++at) {
      const digit = bytes[at] - 48;
      if (digit >= 0 && digit <= 9) {
        ++digits;
        if (mantissa < 9e14) {
          mantissa = 10 * mantissa + digit;
          if (hasDot) --exponent;
        } else if (!hasDot) ++exponent;
      } else if (bytes[at] === dot && !hasDot) hasDot = true;
      else break;
    }
    if (at < end && digits > 0 && (bytes[at] | 32) === 101) {
      const begin = ++at;
      const isSmall = bytes[at] === minus;
      if (isSmall || bytes[at] === plus) ++at;
      const firstDigit = at;
      let given = 0;
      for (; at < end && bytes[at] >= 48 && bytes[at] <= 57; ++at) given = 10 * given + bytes[at] - 48;
      if (at === firstDigit) at = begin - 1;
      exponent += isSmall ? -given : given;
    }
    while (at < end && isBlank(bytes[at])) ++at;
    let value = mantissa;
    if (exponent < 0) value = mantissa / power(-exponent);
    else if (exponent > 0 && mantissa > 0) value = mantissa * power(exponent);
    if (at !== end || digits === 0 || !Number.isFinite(value))
      throw new DxfError("bad_number", { line: this.line + 1, code: this.code });
    return isNegative ? -value : value;
  }
}
