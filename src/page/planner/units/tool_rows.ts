// The panels of the tools that draw units, rails, and candidates on faces.

import type { ToolFields } from "../draw/fields";
import { siteOf } from "../draw/finish";
import { freeId } from "../make/site";
import { text } from "../text";

export type MountTool = "unit" | "rail" | "faces";

/** A unit that looks straight down has no direction. */
function unitRows(fields: ToolFields): HTMLElement[] {
  const { settings } = text.draw;
  const { unitTilt, attracts, isInstalled } = fields.now;
  return [
    fields.unitType(),
    fields.either(settings.attracts, text.draw.attracts, attracts, (now) => fields.set({ attracts: now })),
    fields.either(settings.isInstalled, text.draw.installed, isInstalled, (now) => fields.set({ isInstalled: now })),
    fields.angle("unitTilt", 0, 180),
    ...(unitTilt === 0 ? [] : [fields.angle("heading", -360, 360)]),
    ...(attracts ? [fields.angle("faceTilt", -90, 90)] : []),
  ];
}

function railRows(fields: ToolFields): HTMLElement[] {
  return [
    fields.typed("railId", {
      shown: fields.now.railId ?? "",
      placeholder: freeId(siteOf(fields.planner), "R"),
      isRequired: false,
      read: (typed) => typed,
      commit: (value) => fields.set({ railId: typeof value === "string" ? value : null }),
    }),
    fields.unitType(),
    fields.length("below"),
    fields.length("railSpacing"),
  ];
}

function faceRows(fields: ToolFields): HTMLElement[] {
  const { isAround } = fields.now;
  return [
    fields.either(text.draw.settings.isAround, text.draw.faces, isAround, (now) => fields.set({ isAround: now })),
    fields.unitType(),
    fields.length("faceHeight"),
    fields.length("faceSpacing"),
    fields.angle("faceTilt", -90, 90),
  ];
}

const rows = { unit: unitRows, rail: railRows, faces: faceRows };

export const mountRows = (fields: ToolFields, tool: MountTool): HTMLElement[] => rows[tool](fields);
