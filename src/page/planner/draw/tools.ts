// The tools that draw, and the form of what each draws.

export const drawTools = [
  "room",
  "wall",
  "opening",
  "zone",
  "run",
  "block",
  "hole",
  "keep_out",
  "area",
  "rows",
] as const;

export type DrawTool = (typeof drawTools)[number];

/** An outline closes; a chain ends where it likes; a segment has two ends. */
export type StrokeForm = "outline" | "chain" | "segment";

export const formOf: Record<DrawTool, StrokeForm> = {
  room: "outline",
  wall: "chain",
  opening: "segment",
  zone: "outline",
  run: "segment",
  block: "outline",
  hole: "outline",
  keep_out: "outline",
  area: "outline",
  rows: "segment",
};

export const isDrawTool = (tool: string): tool is DrawTool => (drawTools as readonly string[]).includes(tool);
