// What the plan shows of a change before the server has resolved it.

import type { Motion } from "../geometry/rigid";
import type { Part } from "./messages";

export interface Preview {
  /** Changed outlines, by the key of their part. */
  parts: ReadonlyMap<string, Part>;
  /** Movements of the labels and units of elements, by the path of the element. */
  devices: ReadonlyMap<string, Motion>;
  /** Parts that are new. */
  added: readonly Part[];
  /** Keys of parts that are removed. */
  hidden: ReadonlySet<string>;
}

export const noPreview: Preview = { parts: new Map(), devices: new Map(), added: [], hidden: new Set() };

export const joinPreviews = (all: readonly Preview[]): Preview =>
  all.length === 0
    ? noPreview
    : {
        parts: new Map(all.flatMap(({ parts }) => [...parts])),
        devices: new Map(all.flatMap(({ devices }) => [...devices])),
        added: all.flatMap(({ added }) => [...added]),
        hidden: new Set(all.flatMap(({ hidden }) => [...hidden])),
      };
