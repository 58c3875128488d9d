// What the page and the worker of a DXF drawing tell each other.

import type { Lines, Region, SheetLayer } from "../../sheet/sheet";
import type { DxfNote } from "../drawing";
import type { DxfErrorCode } from "../error";
import type { ProposedUnit } from "../unit";

export interface DxfFacts {
  layers: SheetLayer[];
  /** Of the extents, in the unit of the file. */
  size: [number, number];
  /** The lower left corner of the extents in the file. */
  origin: [number, number];
  /** The size of most of the drawing. */
  bulk: [number, number];
  proposal: ProposedUnit;
  /** By the header. */
  unit: string | null;
  notes: DxfNote[];
}

export type Request = { read: ArrayBuffer } | { render: Region; scale: number; hidden: number[] } | { lines: true };

export type Answer =
  | { facts: DxfFacts }
  | { bitmap: ImageBitmap }
  | { lines: Lines }
  | {
      fault: DxfErrorCode | "memory" | "slow" | "stopped";
      values: Readonly<Record<string, string | number>>;
      /** Of what is not shown. */
      notes?: readonly DxfNote[];
    };
