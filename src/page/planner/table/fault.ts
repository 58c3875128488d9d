// Why a file cannot be read as a table.

/** binary: no text; column: a single column; empty: nothing below the header; large, long: beyond the limits. */
export type Fault = "binary" | "column" | "empty" | "large" | "long";

export class NotATable extends Error {
  constructor(readonly fault: Fault) {
    super(fault);
  }
}

export const mostBytes = 20_000_000;
export const mostLines = 200_000;
