// Margins as the rest of the report writes them (report/data/text_format.cpp).

import { decibelText } from "../../data/format";
import { text } from "./text";

export function decibels(value: number): string {
  if (!Number.isFinite(value)) return value < 0 ? text.numbers.no_signal : text.numbers.no_requirement;
  return decibelText(value);
}
