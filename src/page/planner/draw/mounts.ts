// Rails and faces with candidates, as their tools draw them.

import type { EditBuilder } from "../document/edit";
import type { Point } from "../document/messages";
import type { Planner } from "../planner";
import { say, text } from "../text";
import { addFaces, carrierAt, type Carrier } from "../make/faces";
import { addRail } from "../make/rail";
import { freeId, type Site } from "../make/site";
import { wallLines } from "../make/walls";

export const carrierUnder = ({ document }: Planner, point: Point): Carrier | null =>
  carrierAt(document.parts.all, wallLines(document), point);

/** The path of the new element, or why there is none. */
export function addMounts(
  planner: Planner,
  site: Site,
  builder: EditBuilder,
  tool: "rail" | "faces",
  points: readonly Point[],
): string {
  const { settings } = planner;
  const { type } = planner.unitTool;
  if (type === undefined) return text.draw.no_type;
  const { railId, below, railSpacing, isAround, faceHeight, faceSpacing, faceTilt } = settings.now;
  if (tool === "rail") {
    const isTaken = railId !== null && site.taken.has(railId);
    if (isTaken) planner.say(say(text.draw.taken, railId), true);
    const id = railId === null || isTaken ? freeId(site, "R") : railId;
    settings.set({ railId: null });
    return addRail(builder, site, points, { id, type, below, spacing: railSpacing }) ?? text.draw.no_room;
  }
  const carrier = carrierUnder(planner, points[0]);
  if (!carrier) return text.draw.no_carrier;
  if (!isAround && carrier.key !== "wall" && carrier.face === null) return text.draw.no_face;
  return addFaces(builder, site, carrier, { type, isAround, z: faceHeight, spacing: faceSpacing, tilt: faceTilt });
}
