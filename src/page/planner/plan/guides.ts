// The marks of snapping: what the pointer holds on to, with a word, and the lines that lead to it, with distances. Every
// line has an outline, so that it is visible on any picture.

import type { Point } from "../document/messages";
import { lengthText } from "../geometry/units";
import { between, directionOf, distance, minus, unitAt } from "../geometry/vector";
import type { Planner } from "../planner";
import type { Guide, Snapped, SnapKind } from "../snap/choice";
import { text } from "../text";
import { pathOf, svg } from "./svg";

/** Pixels of a guide, at most: dashes of longer lines take seconds to draw. */
const longest = 3000;
const tick = 5; // pixels
const shortest = 75; // pixels of a line with its length on it

const circle = (r: number): string => `M${-r} 0a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0Z`;
const dot = circle(3.5);

/** Around the origin, in pixels. */
const marks: Record<SnapKind, string> = {
  end: "M-6 -6H6V6H-6Z",
  close: circle(11),
  crossing: "M-6 -6L6 6M-6 6L6 -6",
  middle: "M0 -7L7 5H-7Z",
  line: "M-6 -6H6L-6 6H6Z",
  perpendicular: "M-6 -7V6H7M-6 0H0V6",
  parallel: "M-6 5L0 -7M0 7L6 -5",
  extension: dot,
  align: dot,
  gap: dot,
  length: "M-6 -6V6M6 -6V6M-6 0H6",
  angle: dot,
};

const outlined = (className: string, d: string, transform?: string): Node[] =>
  ["halo", className].map((name) => svg("path", { class: name, d, transform }));

/** A length or an angle at a place of the screen. */
export function reading([x, y]: Point, words: string, className = "reading"): SVGGElement {
  const width = 7.2 * words.length + 14;
  const label = svg("text", { x, y: y + 4.5 });
  label.textContent = words;
  return svg(
    "g",
    { class: className },
    svg("rect", { x: x - 0.5 * width, y: y - 11, width, height: 22, rx: 5 }),
    label,
  );
}

function mark([x, y]: Point, kind: SnapKind): Node[] {
  const word = svg("text", { class: "word", x: x + 15, y: y - 11 });
  word.textContent = text.snap[kind];
  return [...outlined(`mark ${kind}`, marks[kind], `translate(${x} ${y})`), word];
}

/** The ends of a width: both ends have a tick. */
function ticks(from: Point, to: Point): string {
  const [nx, ny] = unitAt(directionOf(minus(to, from)) + 90).map((value) => tick * value);
  return [from, to]
    .map(([x, y]) =>
      pathOf(
        [
          [x - nx, y - ny],
          [x + nx, y + ny],
        ],
        true,
      ),
    )
    .join("");
}

/** Where the distance is written: on the line, or beside it if it would cover the line. */
function placeOf(start: Point, end: Point): Point {
  const [x, y] = between(start, end);
  const [width, height] = minus(end, start).map(Math.abs);
  if (Math.max(width, height) > shortest) return [x, y];
  return width > height ? [x, y - 20] : [x + 40, y];
}

/** A guide without length is the mark of its kind. */
function guide(planner: Planner, { from, to, kind, distance: metres }: Guide): Node[] {
  const [start, end] = [from, to].map((point) => planner.viewport.toScreen(point));
  const length = distance(start, end);
  if (length === 0) return mark(end, kind);
  const begin = length > longest ? between(end, start, longest / length) : start;
  const d = pathOf([begin, end], true) + (kind === "gap" || kind === "length" ? ticks(begin, end) : "");
  const words = metres === undefined ? [] : [lengthText(metres, planner.document.unit)];
  return [...outlined(`guide ${kind}`, d), ...words.map((word) => reading(placeOf(begin, end), word, "distance"))];
}

export const guidesOf = (planner: Planner, guides: readonly Guide[]): Node[] =>
  guides.flatMap((one) => guide(planner, one));

/** What holds a place, its guides first; a cross marks a place that nothing attracts. */
export function snapMarks(planner: Planner, { at, kind, guides }: Snapped): Node[] {
  const place = planner.viewport.toScreen(at);
  const cross = outlined("cross", "M-9 0H9M0 -9V9", `translate(${place[0]} ${place[1]})`);
  return [...guidesOf(planner, guides), ...(kind === null ? cross : mark(place, kind))];
}
