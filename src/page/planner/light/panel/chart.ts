// The histogram of margins as a picture, and in words.

import { decibelText } from "../../../data/format";
import { svg } from "../../plan/svg";
import { say, text } from "../../text";
import type { Histogram } from "../histogram";
import { bandColour, otherColours, type PaletteName } from "../looks";
import { bandOf } from "../verdicts";

const [width, height] = [224, 84];
const foot = 14; // for numbers
const ticks = [-10, 0, 10, 20]; // dB

const marginText = (margin: number): string => (Number.isFinite(margin) ? decibelText(margin) : text.light.no_signal);

/** `isLeast`: margins may be larger, so that those below 0 are undecided. */
export function chartOf(
  { from, width: step, counts, weakest, median }: Histogram,
  palette: PaletteName,
  isLeast: boolean,
): SVGSVGElement {
  const words = say(text.light.chart, marginText(weakest), marginText(median));
  const size = width / counts.length;
  const most = counts.reduce((high, count) => Math.max(high, count), 1);
  const x = (margin: number) => ((margin - from) / step) * size;
  const colourAt = (margin: number) =>
    isLeast && margin < 0 ? otherColours.undecided : bandColour(bandOf(margin), palette);
  const bars = [...counts].flatMap((count, bin) => {
    if (count === 0) return [];
    const tall = Math.max(((height - foot - 2) * count) / most, 1);
    return [
      svg("rect", {
        x: bin * size,
        y: height - foot - tall,
        width: size - 0.8,
        height: tall,
        fill: `var(${colourAt(from + bin * step)})`,
      }),
    ];
  });
  return svg(
    "svg",
    { viewBox: `0 0 ${width} ${height}`, class: "margins", role: "img", "aria-label": words },
    ...bars,
    svg("path", { class: "base", d: `M0 ${height - foot}H${width}` }),
    svg("path", { class: "zero", d: `M${x(0)} 0V${height - foot}` }),
    ...ticks.map((margin) => {
      const label = svg("text", { x: x(margin), y: height - 3 });
      label.textContent = margin > 0 ? `+${margin}` : String(margin).replace("-", "−");
      return label;
    }),
  );
}
