// Numbers with their group codes, in the order of the file.

export class Numbers {
  count = 0;
  codes = new Uint16Array(64);
  numbers = new Float64Array(64);

  clear(): void {
    this.count = 0;
  }

  add(code: number, value: number): void {
    if (this.count === this.codes.length) {
      const [codes, numbers] = [this.codes, this.numbers];
      this.codes = new Uint16Array(2 * this.count);
      this.codes.set(codes);
      this.numbers = new Float64Array(2 * this.count);
      this.numbers.set(numbers);
    }
    this.codes[this.count] = code;
    this.numbers[this.count++] = value;
  }

  /** The first number with a code. */
  number(code: number, otherwise = 0): number {
    for (let k = 0; k < this.count; ++k) if (this.codes[k] === code) return this.numbers[k];
    return otherwise;
  }

  has(code: number): boolean {
    return !Number.isNaN(this.number(code, Number.NaN));
  }

  point(code: number): [number, number] {
    return [this.number(code), this.number(code + 10)];
  }

  all(code: number): number[] {
    const found: number[] = [];
    for (let k = 0; k < this.count; ++k) if (this.codes[k] === code) found.push(this.numbers[k]);
    return found;
  }

  /** All points with a code. */
  points(code: number): [number, number][] {
    const y = this.all(code + 10);
    return this.all(code).map((x, k) => [x, y[k] ?? 0]);
  }
}
