// What begins when the pointer drags something that it has pressed.

import { dragPicture, isOnFreePicture } from "../backdrop/strokes";
import type { Point } from "../document/messages";
import { minus } from "../geometry/vector";
import type { Planner } from "../planner";
import { text } from "../text";
import { canGrab, unitOf } from "../units/chosen";
import { itemOf, partAt } from "../view/hit";
import type { Item } from "../view/selection";
import { carry, dragMove, type Keys } from "./drags";
import { idle, type Scope } from "./scope";

const reach = 9; // pixels

/** From which the pointer finds things, m. */
export const reachOf = ({ viewport }: Planner): number => reach / viewport.scale;

/** What a drag takes along: the element of a label or candidate, and the row that is selected for one of its copies. */
function draggedItem(planner: Planner, pressed: Item | null, world: Point): Item | null {
  const { selection, document, layers } = planner;
  let item = pressed;
  if (item?.kind === "device") {
    const part = partAt(document.parts.all, world, 0.6 * reachOf(planner), layers);
    item = part && itemOf(part);
  }
  if (item?.kind !== "copy" || item.path === null) return item;
  const row: Item = { kind: "element", path: item.path };
  return selection.has(row) ? row : item;
}

/** The unit that a drag moves along its surface. Several elements, and copies, move as they are. */
function draggedUnit(planner: Planner, pressed: Item | null, { alt }: Keys): number | undefined {
  const { document, selection } = planner;
  if (!pressed || (alt && pressed.kind === "element")) return undefined;
  const isOfSeveral = pressed.kind === "element" && selection.items.length > 1 && selection.has(pressed);
  const unit = isOfSeveral ? undefined : unitOf(document, pressed);
  return unit !== undefined && canGrab(planner, unit) ? unit : undefined;
}

export function dragScope(
  planner: Planner,
  scope: Extract<Scope, { kind: "pressed" }>,
  screen: Point,
  world: Point,
  keys: Keys,
): Scope {
  const { selection, document, mover } = planner;
  if (scope.isTouch) {
    planner.viewport.pan(...minus(screen, scope.screen));
    return { kind: "panning", screen: scope.screen, button: 0, hasMoved: true, before: idle };
  }
  const unit = draggedUnit(planner, scope.item, keys);
  if (unit !== undefined) {
    planner.selection.set([scope.item as Item]);
    const [x, y] = mover.placeOf(unit);
    if (!mover.begin(unit)) return idle;
    return carry(planner, { kind: "carrying", from: scope.world, start: [x, y] }, world, keys);
  }
  const item = draggedItem(planner, scope.item, scope.world);
  if (!item && isOnFreePicture(planner, scope.world))
    return dragPicture(planner, { kind: "shifting", from: scope.world, to: scope.world }, world);
  if (!item) {
    const before = [...selection.items];
    return { kind: "marquee", from: scope.world, to: world, kept: keys.shift ? before : [], before };
  }
  if (!selection.has(item)) {
    if (keys.shift) selection.add([item]);
    else selection.set([item]);
  }
  const why = item.kind === "copy" ? text.why_not.copy : null;
  if (why !== null || document.locked) {
    planner.say(why ?? text.why_not.locked, true);
    return idle;
  }
  const elements = planner.selected;
  const moving: Scope = { kind: "moving", elements, from: scope.world, shift: [0, 0], guides: [], isCopying: keys.alt };
  return dragMove(planner, moving, world, { ...keys, shift: false });
}
