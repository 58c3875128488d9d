// Closed outlines of the drawing beneath the shop become the room, columns, fixtures and areas.

import { counted } from "../../data/format";
import type { CommandId } from "../access/commands";
import type { Point } from "../document/messages";
import { finishAll, siteOf, type Finished } from "../draw/finish";
import { templateOf } from "../draw/template";
import type { DrawTool } from "../draw/tools";
import { fixtureLine, simplified } from "../make/outline";
import { isOneSided } from "../make/run";
import { wallLines } from "../make/walls";
import type { Planner } from "../planner";
import { selfCrossings } from "../snap/crossings";
import { say, text } from "../text";

export const outlineUses = ["room", "column", "block", "fixture", "zone", "hole", "keep_out", "area"] as const;

export type OutlineUse = (typeof outlineUses)[number];

export const outlineMenu: CommandId[] = outlineUses.map((use): CommandId => `outline_${use}`);

const toolOf: Record<OutlineUse, DrawTool> = {
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

/** Null: the outline is no rectangle, and becomes a block. */
function fixtureOf(planner: Planner, outline: readonly Point[]): Finished | null {
  const template = templateOf(planner);
  const walls = wallLines(siteOf(planner)).filter(({ number }) => number !== null);
  const found = fixtureLine(outline, template !== null && isOneSided(template.effective), walls);
  return found && { tool: "run", points: found.line, freedom: { ...exact, depth: found.depth } };
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
  if (use === "fixture" && !templateOf(planner)) {
    planner.setTool("run");
    planner.say(text.draw.no_preset, true);
    return;
  }
  if (use === "column" || use === "block" || use === "fixture") planner.settings.set({ isColumn: use === "column" });
  const strokes = outlines.map(
    (points): Finished =>
      (use === "fixture" ? fixtureOf(planner, points) : null) ?? {
        tool: use === "fixture" ? "block" : toolOf[use],
        points,
        freedom: exact,
      },
  );
  const done = await finishAll(planner, strokes, say(text.edits.take, text.drawn[toolOf[use]]));
  if (done) sayLeftOut(planner, use, found.length - outlines.length, strokes);
}
