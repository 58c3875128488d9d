// What the pointer is doing. One value at a time, so that gestures cannot mix.

import type { EditOp } from "../document/json";
import type { Point } from "../document/messages";
import type { Preview } from "../document/preview";
import type { Context } from "../elements/context";
import type { Stroke } from "../draw/stroke";
import type { StoreElement } from "../elements/kinds";
import type { Guide, Snapped } from "../snap/choice";
import type { Item } from "../view/selection";

/** Places on the screen are pixels, others m. */
export type Scope =
  | { kind: "idle" }
  /** Pressed, and not yet moved far enough for a drag. */
  | { kind: "pressed"; screen: Point; world: Point; item: Item | null; isTouch: boolean }
  /** `before`: to which it returns. */
  | { kind: "panning"; screen: Point; button: number; hasMoved: boolean; before: Scope }
  | { kind: "pinching" }
  | { kind: "marquee"; from: Point; to: Point; kept: readonly Item[]; before: readonly Item[] }
  | {
      kind: "moving";
      elements: readonly StoreElement[];
      from: Point;
      shift: Point;
      guides: readonly Guide[];
      isCopying: boolean;
    }
  | { kind: "rotating"; elements: readonly StoreElement[]; middle: Point; from: number; turn: number }
  | { kind: "resizing"; context: Context; handle: string; ops: readonly EditOp[]; preview: Preview }
  | { kind: "measuring"; from: Point | null; to: Snapped }
  /**
   * A line of the picture, in its pixels: `at` is under the cross, perhaps where `mark` attracts it; the length of a line
   * with both ends is typed.
   */
  | { kind: "scaling"; from: Point | null; at: Point | null; to: Point | null; mark?: Snapped }
  /** A part of the picture, in its pixels. */
  | { kind: "cropping"; from: Point; to: Point }
  /** `end`: where the edge from the last corner ends; `pressed`: the button is down, at a place of the plan. */
  | {
      kind: "drawing";
      stroke: Stroke;
      end: Snapped | null;
      pressed: { screen: Point; at: Point } | null;
      typed: { length: string; angle: string };
      /** Arrow keys have moved the cross to `end`. */
      byKeys: boolean;
      /** Nothing attracts the end. */
      isFree: boolean;
      isShift: boolean;
    }
  /** A unit moves along its surface; it began at `start`, and the pointer at `from`. */
  | { kind: "carrying"; from: Point; start: Point }
  /** The picture moves. */
  | { kind: "shifting"; from: Point; to: Point };

export const idle: Scope = { kind: "idle" };

/** Scopes in which the pointer is changing something or about to. */
export const busy: ReadonlySet<Scope["kind"]> = new Set([
  "pressed",
  "marquee",
  "moving",
  "rotating",
  "resizing",
  "carrying",
  "cropping",
  "shifting",
]);

/** The elements that a gesture works on. */
export function pathsOf(scope: Scope): string[] {
  const itemPaths = (items: readonly (Item | null)[]) => items.flatMap((item) => item?.path ?? []);
  switch (scope.kind) {
    case "moving":
    case "rotating":
      return scope.elements.map(({ path }) => path);
    case "resizing":
      return [scope.context.path];
    case "pressed":
      return itemPaths([scope.item]);
    case "marquee":
      return itemPaths([...scope.kept, ...scope.before]);
    default:
      return [];
  }
}
