// How the plan shows a stroke: set edges, the edge to the pointer, what a drag draws, and edges that cross.

import type { Point } from "../document/messages";
import { outlineOf } from "../geometry/rigid";
import { minus, plus, times } from "../geometry/vector";
import { runAlong } from "../make/run";
import { wallLines } from "../make/walls";
import { guidesOf } from "../plan/guides";
import { pathOf, svg } from "../plan/svg";
import type { Planner } from "../planner";
import { aisleGuides } from "../snap/gaps";
import { draggedSoFar, freedomOf, type Drawing } from "./pen";
import { templateOf } from "./template";
import { formOf } from "./tools";

/** The corners so far, with the one at the pointer. */
function corners(planner: Planner, scope: Drawing): readonly Point[] {
  const { stroke, end } = scope;
  return draggedSoFar(planner, scope) ?? (end ? [...stroke.points, end.at] : stroke.points);
}

/** The fixture that a line means, with the aisles beside it. */
function runTraces(planner: Planner, scope: Drawing, points: readonly Point[]): Node[] {
  const template = templateOf(planner);
  if (!template || points.length < 2) return [];
  const { document } = planner;
  const run = runAlong(document, template, wallLines(document), [points[0], points[1]], freedomOf(scope));
  if (!run) return [];
  const outline = outlineOf(run);
  const guides = aisleGuides(planner.snapping.without(new Set()).index, outline, run.rotation);
  return [outlined(planner, outline), ...guidesOf(planner, guides)];
}

const outlined = ({ viewport }: Planner, outline: readonly Point[]): Node =>
  svg("path", { class: "trace run", d: pathOf(outline.map((point) => viewport.toScreen(point))) });

/** The copies that a step makes, for the outlines of the selected fixture. */
function rowOutlines(planner: Planner, [from, to]: readonly Point[]): Point[][] {
  if (!to) return [];
  const step = minus(to, from);
  const [row] = planner.selected;
  const parts = row ? planner.document.parts.of(row.path).slice(0, 1) : [];
  return Array.from({ length: planner.settings.now.count - 1 }, (_, k) =>
    parts.map(({ outline }) => outline.map((corner) => plus(corner, times(step, k + 1)))),
  ).flat();
}

export function traces(planner: Planner, scope: Drawing): Node[] {
  const screen = (points: readonly Point[]) => points.map((point) => planner.viewport.toScreen(point));
  const { tool, points, crossings } = scope.stroke;
  const all = corners(planner, scope);
  const isClosed = formOf[tool] === "outline" && all.length > 2;
  const rows = tool === "rows" ? rowOutlines(planner, all) : [];
  return [
    ...(tool === "run" ? runTraces(planner, scope, all) : rows.map((outline) => outlined(planner, outline))),
    ...(all.length > 1
      ? [svg("path", { class: isClosed ? "trace closed" : "trace", d: pathOf(screen(all), !isClosed) })]
      : []),
    ...screen(points).map(([cx, cy], k) => svg("circle", { class: k === 0 ? "corner first" : "corner", cx, cy, r: 4 })),
    ...crossings.map((edge) => svg("path", { class: "crossing", d: pathOf(screen(edge), true) })),
  ];
}
