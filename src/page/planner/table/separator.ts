// The character between the fields of a table: what a line `sep=;` says, or what gives most lines the width of the header.

import { splitLines, type Line } from "./split";

const separators = [";", ",", "\t", "|"];
const sampled = 100;
const sampleLength = 100_000; // characters

/** The first line with several fields; titles may stand above it. */
export const headerIn = (lines: readonly Line[]): number =>
  lines.findIndex(({ fields }) => fields.filter((field) => field !== "").length > 1);

const widthOf = ({ fields }: Line): number => fields.length - [...fields].reverse().findIndex((field) => field !== "");

/** A separator that would make the first lines titles is less likely. */
const costOfTitles = 0.1;

/** The share of lines as wide as the header, and its width. */
function fitOf(text: string, separator: string): [number, number] {
  const lines = splitLines(text, separator, sampled);
  const first = headerIn(lines);
  if (first < 0) return [0, 0];
  const width = lines[first].fields.length;
  const below = lines.slice(first + 1);
  const same = below.filter((line) => line.fields.length === width || widthOf(line) === width).length;
  return [(below.length === 0 ? 1 : same / below.length) - (first > 0 ? costOfTitles : 0), width];
}

/** The separator, and the text below a line `sep=`; null if there is a single column. */
export function separatorOf(text: string): { separator: string; from: number } | null {
  const stated = /^"?sep=(.)"?(\r\n|\r|\n|$)/i.exec(text);
  if (stated) return { separator: stated[1], from: stated[0].length };
  const sample = text.slice(0, sampleLength);
  let best: { separator: string; fit: [number, number] } | null = null;
  for (const separator of separators) {
    const fit = fitOf(sample, separator);
    const isBetter = !best || fit[0] > best.fit[0] || (fit[0] === best.fit[0] && fit[1] > best.fit[1]);
    if (fit[1] > 1 && isBetter) best = { separator, fit };
  }
  return best && { separator: best.separator, from: 0 };
}
