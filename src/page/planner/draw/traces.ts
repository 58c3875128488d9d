// How the plan shows a stroke: set edges, the edge to the pointer, what a drag draws, and edges that cross.

import type { Point } from "../document/messages";
import { outlineOf } from "../geometry/rigid";
import { minus, plus, times } from "../geometry/vector";
import { runAlong } from "../make/run";
import { wallLines } from "../make/walls";
import { guidesOf, reading } from "../plan/guides";
import { leanPath, pathOf, svg } from "../plan/svg";
import type { Planner } from "../planner";
import { aisleGuides } from "../snap/gaps";
import { placeWords } from "../units/mount";
import { carrierUnder } from "./mounts";
import { draggedSoFar, freedomOf, type Drawing } from "./pen";
import { templateOf } from "./template";
import { formOf } from "./tools";

const ghostSize = 8; // pixels

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

/** The unit that a click places, in words, and a line to it from the pointer. */
function ghostTraces({ unitTool, viewport, document, pointer }: Planner, { end, byKeys }: Drawing): Node[] {
  const { ghost } = unitTool;
  if (!ghost || !end || (!pointer && !byKeys)) return [];
  const { mount } = ghost;
  const [x, y] = viewport.toScreen([mount.position[0], mount.position[1]]);
  const [dx, dy] = unitTool.axisAt(mount).slice(0, 2);
  const leaning = Math.hypot(dx, dy) > 1e-3 ? [svg("path", { class: "lean", d: leanPath([x, y], [dx, -dy]) })] : [];
  return [
    svg("path", { class: "trace", d: pathOf([viewport.toScreen(end.at), [x, y]], true) }),
    svg("circle", { class: "ghost", cx: x, cy: y, r: ghostSize }),
    ...leaning,
    reading([x, y + 34], placeWords(mount, document.unit)),
  ];
}

/** The faces on which a click puts candidates. */
function faceTraces(planner: Planner, { end }: Drawing): Node[] {
  const carrier = end && carrierUnder(planner, end.at);
  if (!carrier) return [];
  const edges = planner.settings.now.isAround ? carrier.edges : carrier.faceEdges;
  const screen = (edge: readonly Point[]) => edge.map((point) => planner.viewport.toScreen(point));
  return edges.map((edge) => svg("path", { class: "trace face", d: pathOf(screen(edge), true) }));
}

export function traces(planner: Planner, scope: Drawing): Node[] {
  const screen = (points: readonly Point[]) => points.map((point) => planner.viewport.toScreen(point));
  const { tool, points, crossings } = scope.stroke;
  const all = corners(planner, scope);
  const isClosed = formOf[tool] === "outline" && all.length > 2;
  const rows = tool === "rows" ? rowOutlines(planner, all) : [];
  return [
    ...(tool === "unit" ? ghostTraces(planner, scope) : tool === "faces" ? faceTraces(planner, scope) : []),
    ...(tool === "run" ? runTraces(planner, scope, all) : rows.map((outline) => outlined(planner, outline))),
    ...(all.length > 1
      ? [svg("path", { class: isClosed ? "trace closed" : "trace", d: pathOf(screen(all), !isClosed) })]
      : []),
    ...screen(points).map(([cx, cy], k) => svg("circle", { class: k === 0 ? "corner first" : "corner", cx, cy, r: 4 })),
    ...crossings.map((edge) => svg("path", { class: "crossing", d: pathOf(screen(edge), true) })),
  ];
}
