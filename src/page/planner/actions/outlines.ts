// Closed outlines of the drawing beneath the shop become the room, columns, fixtures and areas.

import { counted } from "../../data/format";
import type { CommandId } from "../access/commands";
import type { Point } from "../document/messages";
import { finishAll, siteOf, type Finished, type MakingTool } from "../draw/finish";
import { templateOf } from "../draw/template";
import { fixtureLine, simplified } from "../make/outline";
import { isOneSided, type Template } from "../make/run";
import { wallLines } from "../make/walls";
import type { Planner } from "../planner";
import { selfCrossings } from "../snap/crossings";
import { say, text } from "../text";

export const outlineUses = ["room", "column", "block", "fixture", "zone", "hole", "keep_out", "area"] as const;

export type OutlineUse = (typeof outlineUses)[number];

export const outlineMenu: CommandId[] = outlineUses.map((use): CommandId => `outline_${use}`);

const toolOf: Record<OutlineUse, MakingTool> = {
  room: "room",
  column: "block",
  block: "block",
  fixture: "run",
  zone: "zone",
  hole: "hole",
  keep_out: "keep_out",
  area: "area",
};

const exact = { isExact: true, isFree: true };

/** The outlines of an open menu, or the one under the pointer. */
function outlinesAt({ outlines, pointer, traced, isPlan }: Planner): readonly (readonly Point[])[] {
  if (outlines) return outlines;
  const found = pointer && isPlan ? traced.outlineAt(pointer) : null;
  return found ? [found] : [];
}

export function canTake(planner: Planner, use: OutlineUse): boolean {
  const count = outlinesAt(planner).length;
  return use === "room" ? count === 1 : count > 0;
}

/** Fixtures of the preset; outlines that are not rectangles become blocks. */
function fixturesOf(planner: Planner, template: Template, outlines: readonly (readonly Point[])[]): Finished[] {
  const walls = wallLines(siteOf(planner)).filter(({ number }) => number !== null);
  return outlines.map((points) => {
    const found = fixtureLine(points, isOneSided(template.effective), walls);
    if (!found) return { tool: "block", points, freedom: exact };
    return { tool: "run", points: found.line, freedom: { ...exact, depth: found.depth } };
  });
}

/** What became of outlines that could not be used as they were meant. */
function sayLeftOut(planner: Planner, use: OutlineUse, leftOut: number, strokes: readonly Finished[]): void {
  const blocks = use === "fixture" ? strokes.filter(({ tool }) => tool === "block").length : 0;
  const words = [
    ...(leftOut > 0 ? [counted(text.draw.left_out, leftOut)] : []),
    ...(blocks > 0 ? [counted(text.draw.no_rectangles, blocks)] : []),
  ];
  if (words.length > 0) planner.say(words.join(" "), true);
}

export async function takeOutlines(planner: Planner, use: OutlineUse): Promise<void> {
  const found = outlinesAt(planner).map(simplified);
  const outlines = found.filter((outline) => outline.length > 2 && selfCrossings(outline, true).length === 0);
  if (outlines.length === 0) {
    planner.say(text.draw.crossing, true);
    return;
  }
  const template = use === "fixture" ? templateOf(planner) : null;
  if (use === "fixture" && !template) {
    planner.setTool("run");
    planner.say(text.draw.no_preset, true);
    return;
  }
  if (use === "column" || use === "block" || use === "fixture") planner.settings.set({ isColumn: use === "column" });
  const strokes = template
    ? fixturesOf(planner, template, outlines)
    : outlines.map((points): Finished => ({ tool: toolOf[use], points, freedom: exact }));
  const done = await finishAll(planner, strokes, say(text.edits.take, text.drawn[toolOf[use]]));
  if (done) sayLeftOut(planner, use, found.length - outlines.length, strokes);
}
