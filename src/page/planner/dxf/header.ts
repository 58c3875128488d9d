// The variables of the header that matter for a drawing.

import type { Groups } from "./file/groups";

export interface Header {
  version: string | null;
  page: string | null;
  unit: string | null;
  measurement: "metric" | "imperial" | null;
}

/** By $INSUNITS; 0 is none. The American survey units differ from these by two millionths. */
const units: readonly (string | null)[] = [
  ...[null, "in", "ft", "mi", "mm", "cm", "m", "km", "uin", "mil", "yd", "angstrom", "nm", "um", "dm", "dam", "hm"],
  ...["Gm", "au", "ly", "pc", "ft", "in", "yd", "mi"],
];

/** Reads up to the end of the section. */
export function readHeader(groups: Groups): Header {
  const header: Header = { version: null, page: null, unit: null, measurement: null };
  let variable = "";
  for (; groups.code !== 0; groups.advance()) {
    if (groups.code === 9) variable = groups.name();
    else if (variable === "$ACADVER" && groups.code === 1) header.version = groups.name();
    else if (variable === "$DWGCODEPAGE" && groups.code === 3) header.page = groups.name();
    else if (variable === "$INSUNITS" && groups.code === 70) header.unit = units[groups.number()] ?? null;
    else if (variable === "$MEASUREMENT" && groups.code === 70)
      header.measurement = groups.number() === 0 ? "imperial" : "metric";
  }
  return header;
}
