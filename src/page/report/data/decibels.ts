// Margins as the rest of the report writes them (report/data/text_format.cpp).

import { fixed } from "../../data/format";
import { text } from "./text";

export function decibels(value: number): string {
  if (!Number.isFinite(value)) return value < 0 ? text.numbers.no_signal : text.numbers.no_requirement;
  const digits = fixed(value, Math.abs(value) < 0.095 ? 2 : 1);
  return `${value > 0 && digits !== "0.00" ? "+" : ""}${digits}\u00a0dB`;
}
