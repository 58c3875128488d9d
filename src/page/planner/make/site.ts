// What the makers of new elements know of a shop, and how they write places and ids.

import { valueAt, type Json, type JsonObject } from "../document/json";
import type { Point } from "../document/messages";
import { firstFree } from "../elements/row_ids";
import { tidy, type LengthUnit } from "../geometry/units";

export interface Site {
  json: Json;
  unit: LengthUnit;
  /** Ids that elements have. */
  taken: ReadonlySet<string>;
}

/** A length in m as the file has it. */
export const inFile = ({ unit }: Site, metres: number): number => tidy(metres / unit.factor, unit);

export const pointInFile = (site: Site, point: Point): Json => point.map((value) => inFile(site, value));

/** The first free one of W1, W2, ... */
export const freeId = ({ taken }: Site, prefix: string): string => `${prefix}${firstFree(taken, `${prefix}{n}`, 1)}`;

/** The first name of a list of the store, for keys that need one. */
export function firstName(json: Json, list: "materials" | "label_types" | "transceiver_types"): string | undefined {
  const named = valueAt(json, `/${list}`) as JsonObject | undefined;
  return named && Object.keys(named)[0];
}
