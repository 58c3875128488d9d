// How the plan shows a stroke: set edges, the edge to the pointer, what a drag draws, and edges that cross.

import type { Point } from "../document/messages";
import { outlineOf } from "../geometry/rigid";
import { minus, plus, times } from "../geometry/vector";
import { runAlong, sizeOf } from "../make/run";
import { wallLines } from "../make/walls";
import { pathOf, svg } from "../plan/svg";
import type { Planner } from "../planner";
import { siteOf } from "./finish";
import { draggedSoFar, type Drawing } from "./pen";
import { formOf } from "./tools";

/** The corners so far, with the one at the pointer. */
function corners(planner: Planner, scope: Drawing): readonly Point[] {
  const { stroke, end } = scope;
  return draggedSoFar(planner, scope) ?? (end ? [...stroke.points, end.at] : stroke.points);
}

/** The fixture that a line means. */
function runOutline(planner: Planner, points: readonly Point[]): Point[] | null {
  const { preset } = planner.settings.now;
  const chosen = preset === null ? null : planner.presets.get(preset);
  if (!chosen || points.length < 2) return null;
  const site = siteOf(planner);
  const run = sizeOf(site, chosen) && runAlong(site, chosen, wallLines(site), [points[0], points[1]]);
  return run ? outlineOf(run) : null;
}

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
  const run = tool === "run" ? runOutline(planner, all) : null;
  const fixtures = run ? [run] : tool === "rows" ? rowOutlines(planner, all) : [];
  return [
    ...fixtures.map((outline) => svg("path", { class: "trace run", d: pathOf(screen(outline)) })),
    ...(all.length > 1
      ? [svg("path", { class: isClosed ? "trace closed" : "trace", d: pathOf(screen(all), !isClosed) })]
      : []),
    ...screen(points).map(([cx, cy], k) => svg("circle", { class: k === 0 ? "corner first" : "corner", cx, cy, r: 4 })),
    ...crossings.map((edge) => svg("path", { class: "crossing", d: pathOf(screen(edge), true) })),
  ];
}
