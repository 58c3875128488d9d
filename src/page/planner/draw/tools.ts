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
  "unit",
  "rail",
  "faces",
] as const;

export type DrawTool = (typeof drawTools)[number];

/** An outline closes; a chain ends where it likes; a segment has two ends; a point is one click. */
export type StrokeForm = "outline" | "chain" | "segment" | "point";

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
  unit: "point",
  rail: "chain",
  faces: "point",
};

export const isDrawTool = (tool: string): tool is DrawTool => (drawTools as readonly string[]).includes(tool);

/** Whether the next keys are for the plan; rows begin with their number. */
export const beginsInPlan = (tool: string): boolean =>
  tool === "scale" || tool === "check" || (isDrawTool(tool) && tool !== "rows");
