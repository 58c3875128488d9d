// Why a file is refused. The page has the sentences.

import type { DxfNote } from "./drawing";

export type DxfErrorCode =
  /** A binary DXF file. */
  | "binary"
  /** A DWG file; `version`. */
  | "dwg"
  | "not_dxf"
  /** The file ends early, at `line`. */
  | "truncated"
  /** `line` is not a group code. */
  | "bad_code"
  /** The value of group `code` on `line` is not a finite number. */
  | "bad_number"
  /** `bytes` of at most `limit`. */
  | "too_large"
  /** `block` leads to more than `limit` lines; it is *Model_Space if the drawing itself does. */
  | "too_many"
  /** `block` has blocks in blocks on more than `limit` levels. */
  | "too_deep"
  /** More than `limit` layers. */
  | "too_many_layers"
  /** Nothing in model space; `paper` counts the entities of paper space. */
  | "empty"
  /** Model space has only what cannot be shown; the notes name it. */
  | "unshown";

export class DxfError extends Error {
  constructor(
    readonly code: DxfErrorCode,
    readonly values: Readonly<Record<string, string | number>> = {},
    readonly notes: readonly DxfNote[] = [],
  ) {
    super(code);
    this.name = "DxfError";
  }
}
