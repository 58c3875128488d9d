// The visible lines of a PDF page, from the operations that draw it. Curves become chords. Lines do not end beneath images
// and patterns, nor at clips by text; the edge that a clip gives a fill is no line.

import type { Point } from "../document/messages";
import { combined, type Matrix } from "../dxf/shape/matrix";
import type { Lines } from "../sheet/sheet";
import { loopsOf, placed } from "./loops";
import { clipped, Region } from "./region";
import { unknownPaint, VisibleLines, type Paint } from "./visible_lines";

/** The numbers of the operations that matter, as the reader of the file numbers them. */
export type Operations = Record<
  | "save"
  | "restore"
  | "transform"
  | "setGState"
  | "setFillRGBColor"
  | "setStrokeRGBColor"
  | "setFillColorN"
  | "setStrokeColorN"
  | "setFillTransparent"
  | "setStrokeTransparent"
  | "shadingFill"
  | "paintImageXObject"
  | "paintInlineImageXObject"
  | "constructPath"
  | "stroke"
  | "closeStroke"
  | "fill"
  | "eoFill"
  | "fillStroke"
  | "eoFillStroke"
  | "closeFillStroke"
  | "closeEOFillStroke"
  | "clip"
  | "eoClip"
  | "paintFormXObjectBegin"
  | "paintFormXObjectEnd"
  | "beginGroup"
  | "endGroup"
  | "beginMarkedContent"
  | "beginMarkedContentProps"
  | "endMarkedContent",
  number
>;

export interface OperatorList {
  fnArray: readonly number[];
  argsArray: readonly unknown[];
}

/** Whether a colour is as that of the paper, or nearly so: lines of it are seen on other colours only. */
const isPaper = (colour: unknown): boolean => typeof colour === "string" && /^#(f[a-f]){3}$/i.test(colour);

/** What a save keeps. */
interface State {
  matrix: Matrix;
  clips: readonly Region[];
  /** Null: a pattern, or nothing. */
  fill: string | null;
  stroke: string | null;
  alpha: unknown;
  blend: unknown;
  mask: unknown;
  /** In a group that others shine through. */
  isVeiled: boolean;
}

const paintOf = ({ fill, alpha, blend, mask, isVeiled }: State): Paint => ({
  isOpaque: fill !== null && alpha === 1 && blend === "source-over" && mask === false && !isVeiled,
  isPaper: isPaper(fill),
});

/**
 * `page`: the place of the page's coordinates in the picture, which has a `size`. `isVisible`: whether a layer of the file
 * is shown, by what the operation says of it.
 */
export function linesOf(
  { fnArray, argsArray }: OperatorList,
  ops: Operations,
  { page, size }: { page: Matrix; size: Point },
  isVisible: (layer: unknown) => boolean,
): Lines {
  const into = new VisibleLines();
  let now: State = {
    matrix: page,
    clips: [new Region([[0, 0, size[0], 0, size[0], size[1], 0, size[1]]], false)],
    fill: "#000000",
    stroke: "#000000",
    alpha: 1,
    blend: "source-over",
    mask: false,
    isVeiled: false,
  };
  const saved: State[] = [];
  const marked: boolean[] = [];
  let hidden = 0;
  let clipRule = 0; // of the path to come
  const enter = (matrix: unknown, bounds: unknown) => {
    if (matrix) now = { ...now, matrix: combined(now.matrix, matrix as Matrix) };
    if (bounds) now = { ...now, clips: clipped(now.clips, placed(bounds as number[], now.matrix)) };
  };
  const strokes = [
    ops.stroke,
    ops.closeStroke,
    ops.fillStroke,
    ops.eoFillStroke,
    ops.closeFillStroke,
    ops.closeEOFillStroke,
  ];
  const evenOdd = [ops.eoFill, ops.eoFillStroke, ops.closeEOFillStroke];
  const fills = [ops.fill, ops.fillStroke, ops.closeFillStroke, ...evenOdd];
  const construct = (paint: number, path: ArrayLike<number> | null) => {
    const [isStroked, isFilled] = [strokes.includes(paint), fills.includes(paint)];
    const loops = loopsOf(path ?? [], now.matrix, isFilled);
    if (hidden === 0 && (isStroked || isFilled)) {
      const before = into.drawn;
      into.draw(loops, now.clips, (!isStroked || isPaper(now.stroke)) && (!isFilled || isPaper(now.fill)));
      if (isFilled) into.fill([new Region(loops, evenOdd.includes(paint)), ...now.clips], paintOf(now), before);
    }
    if (clipRule !== 0) now = { ...now, clips: clipped(now.clips, new Region(loops, clipRule === ops.eoClip)) };
    clipRule = 0;
  };
  fnArray.forEach((operation, k) => {
    if (into.isFull) return;
    const args = argsArray[k] as unknown[];
    switch (operation) {
      case ops.save:
        saved.push(now);
        break;
      case ops.restore:
      case ops.paintFormXObjectEnd:
        now = saved.pop() ?? now;
        break;
      case ops.transform:
        now = { ...now, matrix: combined(now.matrix, args as unknown as Matrix) };
        break;
      case ops.setGState:
        for (const [key, value] of args[0] as [string, unknown][])
          if (key === "ca") now = { ...now, alpha: value };
          else if (key === "BM") now = { ...now, blend: value };
          else if (key === "SMask") now = { ...now, mask: value };
        break;
      case ops.setFillRGBColor:
        now = { ...now, fill: String(args[0]) };
        break;
      case ops.setStrokeRGBColor:
        now = { ...now, stroke: String(args[0]) };
        break;
      case ops.setFillColorN:
      case ops.setFillTransparent:
        now = { ...now, fill: null };
        break;
      case ops.setStrokeColorN:
      case ops.setStrokeTransparent:
        now = { ...now, stroke: null };
        break;
      case ops.paintImageXObject:
      case ops.paintInlineImageXObject:
      case ops.shadingFill: {
        const all = operation === ops.shadingFill ? now.clips : [placed([0, 0, 1, 1], now.matrix), ...now.clips];
        if (hidden === 0) into.fill(all, unknownPaint, into.drawn);
        break;
      }
      case ops.paintFormXObjectBegin:
        saved.push(now);
        enter(args[0], args[1]);
        break;
      case ops.beginGroup: {
        saved.push(now);
        const { bbox, matrix, smask } = args[0] as { bbox?: unknown; matrix?: unknown; smask?: unknown };
        const before = now.matrix;
        enter(matrix, bbox);
        const isVeiled = !paintOf({ ...now, fill: "" }).isOpaque;
        now = { ...now, matrix: before, alpha: 1, blend: "source-over", mask: false, isVeiled };
        if (smask) ++hidden; // not drawn itself
        break;
      }
      case ops.endGroup:
        now = saved.pop() ?? now;
        if ((args[0] as { smask?: unknown }).smask) --hidden;
        break;
      case ops.beginMarkedContent:
      case ops.beginMarkedContentProps: {
        const isShown = args[0] !== "OC" || isVisible(args[1]);
        marked.push(isShown);
        if (!isShown) ++hidden;
        break;
      }
      case ops.endMarkedContent:
        if (marked.pop() === false) --hidden;
        break;
      case ops.clip:
      case ops.eoClip:
        clipRule = operation;
        break;
      case ops.constructPath: {
        const [paint, [path]] = args as [number, [ArrayLike<number> | null]];
        construct(paint, path);
      }
    }
  });
  return into.finished();
}
