// The marks and lines of the plan without WebGL, drawn by the processor with the looks of the shaders.

import type { Color, IUniform } from "three";

import type { Link, Links } from "./links";
import { type Marks, patterns, shapes } from "./marks";

type Point = [number, number];

/** Where the plan lies: its middle in m, pixels per m, and its size in pixels. */
export interface FlatView {
  middle: Point;
  scale: number;
  width: number;
  height: number;
}

/** Corners in radii, y down; a disc has none. */
const cornersOf: Record<number, Point[]> = {
  [shapes.triangle]: [
    [0, -1.1],
    [0.953, 0.55],
    [-0.953, 0.55],
  ],
  [shapes.square]: around([-0.85, -0.85]),
  [shapes.diamond]: around([0, -1.15]),
  [shapes.cross]: around([-0.16, -0.9], [0.16, -0.9], [0.16, -0.16]),
};
/** From the outline to the middle, radii. */
const depths: Record<number, number> = { [shapes.triangle]: 0.55, [shapes.square]: 0.85, [shapes.diamond]: 0.81 };

/** A quarter of the corners, and the other three. */
function around(...quarter: Point[]): Point[] {
  const half = [...quarter, ...quarter.map(([x, y]): Point => [-y, x])];
  return [...half, ...half.map(([x, y]): Point => [-x, -y])];
}

const css = (colour: Color): string => `#${colour.getHexString()}`;

export class FlatPlan {
  /** Of its own, because a canvas that has had WebGL draws nothing else. */
  private readonly canvas = document.createElement("canvas");

  /** `lost`: the canvas of WebGL. */
  constructor(private readonly lost: HTMLCanvasElement) {}

  hide(): void {
    this.canvas.hidden = true;
  }

  draw(all: readonly Marks[], links: Links, view: FlatView): void {
    const { canvas } = this;
    const context = canvas.getContext("2d");
    if (!context) return;
    if (!canvas.isConnected) this.lost.after(canvas);
    canvas.hidden = false;
    const ratio = Math.min(devicePixelRatio, 2);
    canvas.width = Math.round(view.width * ratio); // also clears it
    canvas.height = Math.round(view.height * ratio);
    context.scale(ratio, ratio);
    // What is selected or must not be hidden is in front of all others.
    for (const isFront of [false, true])
      for (const marks of all) if (marks.mesh.visible) this.drawMarks(context, marks, isFront, view);
    for (const link of links.shown) this.drawLink(context, link, links.mesh.material.uniforms, view);
  }

  private drawMarks(context: CanvasRenderingContext2D, marks: Marks, isFront: boolean, view: FlatView): void {
    const { places, facings, looks } = marks;
    const [lift, spread] = ["lift", "spread"].map((name) => marks.uniform(name).value as number);
    const byLook = new Map<number, number[]>();
    for (let at = 0; at < 4 * marks.count; at += 4) {
      const [colour, shape, emphasis, level] = looks.subarray(at, at + 4);
      if (emphasis >= 2 !== isFront || shape === shapes.none) continue;
      const away = lift + spread * level;
      const [x, y] = onScreen([places[at] + away * facings[at], places[at + 1] + away * facings[at + 1]], view);
      if (x < -20 || y < -20 || x > view.width + 20 || y > view.height + 20) continue;
      const look = colour | (shape << 8) | (emphasis << 16) | (places[at + 3] < 0 ? 0 : 1 << 24);
      const drawn = byLook.get(look);
      if (drawn) drawn.push(x, y);
      else byLook.set(look, [x, y]);
    }
    for (const [look, drawn] of byLook) this.drawLook(context, marks, look, drawn, view.scale);
  }

  /** Marks that look the same. */
  private drawLook(
    context: CanvasRenderingContext2D,
    marks: Marks,
    look: number,
    drawn: number[],
    scale: number,
  ): void {
    const value = <Value>(name: string) => marks.uniform(name).value as Value;
    const [coded, emphasis, isUnit] = [(look >> 8) & 255, (look >> 16) & 255, look >> 24 !== 0];
    const shape = coded & 15;
    const isSpecial = shape === shapes.triangle || (shape === shapes.square && !isUnit);
    const isSelected = emphasis === 2;
    const { x: least, y: most } = value<{ x: number; y: number }>("pixelRadius");
    let radius = Math.min(Math.max(value<number>("worldRadius") * scale, least), most);
    if (isSpecial) radius = Math.max(1.6 * radius, 5);
    if (shape === shapes.cross) radius *= 0.42;
    if (emphasis === 0) radius *= 0.75;
    if (isSelected) radius = Math.max(1.5 * radius, 7);
    const usual = isSpecial ? 1.4 : radius > 3 ? 0.8 : 0;
    const line = isSelected ? 2.5 : shape === shapes.cross ? 0 : coded & patterns.hollow ? Math.min(usual, 0.9) : usual;

    const paper = value<Color>("paper");
    const faint = (emphasis === 0 ? 0.55 : 1) * (coded & patterns.pale ? 0.38 : 1);
    const shown = (colour: Color) => css(paper.clone().lerp(colour, faint));
    const fill = shown(value<Color[]>("palette")[look & 255]);
    const deep = radius * (depths[shape] ?? 1);
    const trace = (inset: number) => tracePath(context, shape, radius * Math.max(1 - inset / deep, 0), drawn);
    trace(0.5 * line);
    context.fillStyle = coded & patterns.hatched ? (stripes(context, fill, css(paper)) ?? fill) : fill;
    context.fill();
    if (coded & patterns.hollow) {
      trace(deep - Math.max(0.9, 0.38 * deep));
      context.fillStyle = css(paper);
      context.fill();
      trace(0.5 * line);
    }
    if (line === 0) return;
    context.strokeStyle = isSelected || isSpecial ? shown(value("strong")) : isUnit ? css(paper) : shown(value("edge"));
    context.lineWidth = line;
    context.stroke();
  }

  private drawLink(
    context: CanvasRenderingContext2D,
    { from, to, solid, width }: Link,
    { direct, reflected, unknown }: Record<string, IUniform<Color>>,
    view: FlatView,
  ): void {
    const share = solid ?? 1;
    const [a, b] = [onScreen(from, view), onScreen(to, view)];
    const between: Point = [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])];
    context.lineWidth = width;
    for (const [start, end, colour, dashes] of [
      [a, between, solid === null ? unknown : direct, []],
      [between, b, reflected, [6, 4]],
    ] as const) {
      context.beginPath();
      context.setLineDash(dashes);
      context.strokeStyle = css(colour.value);
      context.moveTo(...start);
      context.lineTo(...end);
      if (start !== end) context.stroke();
    }
    context.setLineDash([]);
  }
}

const onScreen = ([x, y]: readonly number[], { middle, scale, width, height }: FlatView): Point => [
  0.5 * width + (x - middle[0]) * scale,
  0.5 * height - (y - middle[1]) * scale,
];

function tracePath(context: CanvasRenderingContext2D, shape: number, radius: number, drawn: number[]): void {
  const corners = cornersOf[shape];
  context.beginPath();
  for (let k = 0; k < drawn.length; k += 2) {
    const [x, y] = [drawn[k], drawn[k + 1]];
    if (!corners) {
      context.moveTo(x + radius, y);
      context.arc(x, y, radius, 0, 2 * Math.PI);
      continue;
    }
    corners.forEach(([u, v], n) => {
      if (n === 0) context.moveTo(x + radius * u, y + radius * v);
      else context.lineTo(x + radius * u, y + radius * v);
    });
    context.closePath();
  }
}

function stripes(context: CanvasRenderingContext2D, colour: string, paper: string): CanvasPattern | null {
  const tile = document.createElement("canvas");
  tile.width = tile.height = 4;
  const drawn = tile.getContext("2d");
  if (!drawn) return null;
  for (let k = 0; k < 16; ++k) {
    const [x, y] = [k % 4, k >> 2];
    drawn.fillStyle = (x - y + 4) % 4 < 2 ? colour : paper;
    drawn.fillRect(x, y, 1, 1);
  }
  return context.createPattern(tile, "repeat");
}
