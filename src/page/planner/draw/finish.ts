// What a finished stroke adds to the store.

import { EditBuilder } from "../document/edit";
import { pointerTo, type Json } from "../document/json";
import type { Part, Point } from "../document/messages";
import { noPreview, type Preview } from "../document/preview";
import { idsOf } from "../elements/copies";
import { elementAround } from "../elements/kinds";
import { drawingPath } from "../backdrop/drawing";
import { shifted } from "../backdrop/transform";
import { outlineOf } from "../geometry/rigid";
import { minus, times } from "../geometry/vector";
import { addArea, addBlock, addKeepOut } from "../make/block";
import { addHole, addZone, losesWalls, setRoom } from "../make/room";
import { addRun, runAlong, setRows } from "../make/run";
import { inFile, type Site } from "../make/site";
import { addOpening, addWalls, along, wallLines, wallNear } from "../make/walls";
import type { Planner } from "../planner";
import { say, text } from "../text";
import { materialFor } from "./materials";
import { addMounts } from "./mounts";
import { templateOf, withDepth } from "./template";
import type { DrawTool } from "./tools";

const openingReach = 0.6; // m from a wall
const leastWidth = 0.05; // m

export const siteOf = ({ document }: Planner): Site => ({
  json: document.json,
  unit: document.unit,
  taken: idsOf(
    document.json,
    document.parts.all.map(({ id }) => id),
  ),
});

/** The outline in the plan until the server has resolved it. */
const ghost = (kind: Part["kind"], outline: readonly Point[]): Preview => ({
  ...noPreview,
  added: [{ key: "drawn", path: null, kind, id: "", outline: [...outline] }],
});

interface Made {
  paths: readonly string[];
  preview: Preview;
  /** By how much the plan moves under everything drawn. */
  origin?: Point;
}

/** `isExact`: a fixture is as long as its line; `isFree`: it clings to no wall; `depth`: that of the fixture, m. */
export interface Freedom {
  isExact: boolean;
  isFree: boolean;
  depth?: number;
  /** Shift is held. */
  isShift?: boolean;
}

/** A tool of which the page itself knows what its stroke makes; the server places units. */
export type MakingTool = Exclude<DrawTool, "unit">;

function make(
  planner: Planner,
  site: Site,
  builder: EditBuilder,
  tool: MakingTool,
  points: readonly Point[],
  freedom: Freedom,
): Made | string {
  const { settings } = planner;
  const { thickness, zoneHeight, blockHeight, isColumn, spacing } = settings.now;
  const one = (path: string, kind: Part["kind"], outline = points): Made => ({
    paths: [path],
    preview: ghost(kind, outline),
  });
  switch (tool) {
    case "room": {
      if (losesWalls(site.json)) planner.say(text.draw.lost_walls, true);
      const origin = setRoom(builder, site, points);
      return { paths: ["/room"], preview: noPreview, origin };
    }
    case "hole":
      addHole(builder, site, points);
      return { paths: ["/room"], preview: noPreview };
    case "zone":
      return one(addZone(builder, site, points, zoneHeight), "zone");
    case "wall":
      return { paths: addWalls(builder, site, points, thickness), preview: ghost("wall", points) };
    case "opening": {
      const ends: [Point, Point] = [points[0], points[1]];
      const wall = wallNear(wallLines(site), ends, openingReach);
      if (!wall) return text.draw.no_wall;
      if (Math.abs(along(wall, ends[1]) - along(wall, ends[0])) < leastWidth) return text.draw.not_along;
      const path = addOpening(builder, site, wall, ends, openingForm(planner), freedom.isExact);
      return { paths: [elementAround(path) ?? path], preview: noPreview };
    }
    case "run": {
      const known = templateOf(planner);
      const template = known && freedom.depth !== undefined ? withDepth(known, inFile(site, freedom.depth)) : known;
      const run = template && runAlong(site, template, wallLines(site), [points[0], points[1]], freedom);
      if (!template || !run) return text.draw.no_preset;
      settings.set({ isLike: true, preset: template.preset });
      return one(addRun(builder, site, template, run), "fixture", outlineOf(run));
    }
    case "block": {
      const material = materialFor(planner, "block");
      if (material === undefined) return text.draw.no_material;
      return one(addBlock(builder, site, points, isColumn ? "ceiling" : blockHeight, material), "fixture");
    }
    case "rows": {
      const [row] = planner.selected;
      if (row?.kind !== "fixture" || row.value.against !== undefined) return text.draw.no_row;
      setRows(builder, site, row.path, settings.now.count, minus(points[1], points[0]));
      return { paths: [row.path], preview: noPreview };
    }
    case "keep_out":
      return one(addKeepOut(builder, site, points), "keep_out");
    case "area": {
      const { type } = planner.unitTool;
      if (type === undefined) return text.draw.no_type;
      return one(addArea(builder, site, points, type, spacing), "area");
    }
    case "rail":
    case "faces": {
      const path = addMounts(planner, site, builder, tool, points);
      return path.startsWith("/") ? one(path, tool) : path;
    }
  }
}

/** The picture and the view follow the origin, so that nothing moves on the screen. */
function moveOrigin({ drawing, document, viewport }: Planner, builder: EditBuilder, origin: Point): void {
  const back = times(origin, -1);
  if (drawing) builder.set(pointerTo(drawingPath, "at"), shifted(drawing, document.unit, back).at as Json);
  viewport.shift(back);
}

function openingForm(planner: Planner) {
  const { opening, doorHeight, sill, lintel } = planner.settings.now;
  const material = opening === "open" ? undefined : materialFor(planner, opening);
  return opening === "window" ? { bottom: sill, top: lintel, material } : { bottom: 0, top: doorHeight, material };
}

/** What a tool makes of a stroke. */
export interface Finished {
  tool: MakingTool;
  points: readonly Point[];
  freedom: Freedom;
}

/** Adds the drawn elements in one step, and selects them. */
export async function finishAll(planner: Planner, strokes: readonly Finished[], label: string): Promise<boolean> {
  const { document } = planner;
  if (document.locked) {
    planner.say(text.why_not.locked, true);
    return false;
  }
  const builder = new EditBuilder(document.json);
  const site = siteOf(planner);
  const taken = new Set(site.taken);
  const all: Made[] = [];
  for (const { tool, points, freedom } of strokes) {
    const made = make(planner, { ...site, taken }, builder, tool, points, freedom);
    if (typeof made === "string") {
      planner.say(made, true);
      return false;
    }
    all.push(made);
    for (const path of made.paths) taken.add(String(builder.get(`${path}/id`)));
    if (made.origin) moveOrigin(planner, builder, made.origin);
  }
  const added = all.flatMap(({ preview }) => preview.added).map((part, k) => ({ ...part, key: `drawn${k}` }));
  const done = document.edit({ label, ops: builder.ops }, { ...noPreview, added });
  planner.selection.setPaths(all.flatMap(({ paths }) => paths));
  return done;
}

/** Adds the drawn element, and selects it. */
export function finish(planner: Planner, tool: DrawTool, points: readonly Point[], freedom: Freedom): Promise<boolean> {
  if (tool === "unit") {
    const isInstalled = planner.settings.now.isInstalled || freedom.isShift === true;
    return planner.unitTool.place(points[0], freedom.isFree, isInstalled);
  }
  const done = finishAll(planner, [{ tool, points, freedom }], say(text.edits.draw, text.drawn[tool]));
  if (tool === "rows") planner.setTool("select");
  return done;
}
