// Turns the events of the pointer into gestures.

import * as picture from "../backdrop/strokes";
import {
  endStroke,
  hasBegun,
  leave,
  moveCrossOf,
  penDown,
  penMove,
  penUp,
  setCorner,
  takeBack,
  undrawn,
  withTyped,
} from "../draw/pen";
import { isDrawTool } from "../draw/tools";
import type { Point } from "../document/messages";
import { noPreview } from "../document/preview";
import { contextOf } from "../elements/context";
import { boundsBetween, middleOf } from "../geometry/bounds";
import { directionOf, distance, minus } from "../geometry/vector";
import type { Planner } from "../planner";
import { itemAt, itemsWithin } from "../view/hit";
import type { Item, Place } from "../view/selection";
import { dragScope, reachOf } from "./begin";
import { carry, dragMove, dragSize, dragTurn, drop, type Keys } from "./drags";
import { gripAt, gripsOf } from "./grips";
import { aimMeasure, setMeasure, unmeasured } from "./measuring";
import { busy, idle, pathsOf, type Scope } from "./scope";
import { Touches } from "./touches";

const slack = 4; // pixels between a click and a drag
/** Scopes that the press of a button does not end. */
const resting: ReadonlySet<Scope["kind"]> = new Set(["idle", "measuring", "scaling", "drawing"]);
const buttons = { left: 0, middle: 1, right: 2, none: -1 };

const noKeys: Keys = { shift: false, alt: false };
const keysOf = ({ shiftKey, altKey }: MouseEvent): Keys => ({ shift: shiftKey, alt: altKey });

export class Gestures {
  scope: Scope = idle;
  /** Finished measurements; they stay until the tool is left. */
  measured: [Point, Point][] = [];
  /** The item under the pointer. */
  hovered: Item | null = null;
  onMenu: (screen: Point) => void = () => {};
  onOpen: () => void = () => {};

  private isSpaceHeld = false;
  private last: Point = [0, 0];
  private readonly touches: Touches;

  constructor(
    private readonly planner: Planner,
    private readonly surface: HTMLElement,
  ) {
    this.touches = new Touches(planner.viewport);
    surface.addEventListener("pointerdown", (event) => this.down(event));
    surface.addEventListener("pointermove", (event) => this.move(event));
    surface.addEventListener("pointerup", (event) => this.up(event));
    surface.addEventListener("pointercancel", (event) => {
      this.touches.release(event);
      this.cancel();
    });
    surface.addEventListener("pointerleave", () => {
      planner.pointer = null;
      this.hover(null);
    });
    surface.addEventListener("dblclick", () => this.scope.kind === "idle" && this.onOpen());
    surface.addEventListener("contextmenu", (event) => event.preventDefault());
    surface.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    planner.follow((place) => this.follow(place));
  }

  /** Whether the pointer is changing something or about to. */
  get isBusy(): boolean {
    return busy.has(this.scope.kind) || this.planner.mover.isDragging;
  }

  /** After a change that is not from the gesture: it goes on with the same elements, or ends if one of them is gone. */
  private follow(place: Place): void {
    const { scope, planner } = this;
    const paths = pathsOf(scope);
    if (paths.every((path) => place(path) === path)) return;
    planner.document.show(null); // the outlines have other keys now; the next movement shows them
    const isThere = paths.every((path) => place(path) !== null);
    if (isThere && (scope.kind === "moving" || scope.kind === "rotating"))
      this.enter({ ...scope, elements: scope.elements.map((one) => ({ ...one, path: place(one.path) as string })) });
    else this.enter(idle);
  }

  /** Ends the gesture without an effect; false if there was none. */
  cancel(): boolean {
    const { scope } = this;
    if (scope.kind === "drawing" && (scope.typed.length !== "" || scope.typed.angle !== "")) {
      this.enter({ ...scope, typed: { length: "", angle: "" } });
      return true;
    }
    const isLine = scope.kind === "measuring" || scope.kind === "scaling";
    const isGesture =
      scope.kind === "drawing" ? hasBegun(this.planner, scope) : isLine ? scope.from !== null : scope.kind !== "idle";
    if (scope.kind === "marquee") this.planner.selection.set(scope.before);
    if (scope.kind === "shifting") this.planner.hold(null);
    this.planner.document.show(null);
    const wasCarried = this.planner.mover.cancel(); // also in 3-D
    this.enter(this.resting);
    return isGesture || wasCarried;
  }

  /** What the tool does before the first press. */
  private get resting(): Scope {
    const { tool } = this.planner;
    if (tool === "scale" || tool === "check") return picture.unscaled;
    if (isDrawTool(tool)) return undrawn(this.planner, tool);
    return tool === "measure" ? unmeasured : idle;
  }

  /** Begins or ends the use of a tool. */
  useTool(): void {
    this.measured = [];
    if (this.scope.kind === "drawing") leave(this.planner, this.scope);
    this.hover(null); // tools ignore the element under the pointer
    this.cancel();
  }

  /** Space moves the plan with the pointer, also without a button. */
  holdSpace(held: boolean): void {
    if (this.isSpaceHeld === held) return;
    this.isSpaceHeld = held;
    if (this.scope.kind === "panning" && this.scope.button === buttons.none && !held) this.enter(idle);
    this.surface.classList.toggle("grab", held);
  }

  /** A drawing may have ended its tool. */
  private enter(wanted: Scope): void {
    const scope = wanted.kind === "drawing" && wanted.stroke.tool !== this.planner.tool ? this.resting : wanted;
    this.scope = scope;
    this.surface.dataset.scope = scope.kind;
    this.planner.unitTool.follow(scope);
    this.planner.changes.note("preview");
  }

  private placeOf(event: MouseEvent): { screen: Point; world: Point } {
    const box = this.surface.getBoundingClientRect();
    const screen: Point = [event.clientX - box.left, event.clientY - box.top];
    return { screen, world: this.planner.viewport.toWorld(screen) };
  }

  private get reach(): number {
    return reachOf(this.planner);
  }

  private down(event: PointerEvent): void {
    const { screen, world } = this.placeOf(event);
    this.last = screen;
    this.surface.setPointerCapture(event.pointerId);
    if (event.pointerType === "touch" && this.touches.press(event, screen)) {
      this.planner.document.show(null);
      this.enter({ kind: "pinching" });
      return;
    }
    if (!resting.has(this.scope.kind)) return;
    if (event.button !== buttons.left || this.isSpaceHeld) {
      event.preventDefault();
      this.enter({ kind: "panning", screen, button: event.button, hasMoved: false, before: this.scope });
    } else if (this.scope.kind === "drawing")
      this.enter(penDown(this.planner, this.scope, screen, world, keysOf(event)));
    else if (this.scope.kind === "measuring") this.measureTo(world, keysOf(event));
    else if (this.scope.kind === "scaling") {
      event.preventDefault(); // the field at the line keeps the focus
      this.enter(picture.pressLine(this.planner, this.scope, world, event.altKey));
    } else if (this.planner.tool === "crop") {
      const from = picture.pixelAt(this.planner, world);
      this.enter({ kind: "cropping", from, to: from });
    } else this.press(event, screen, world);
  }

  private press(event: PointerEvent, screen: Point, world: Point): void {
    const { planner } = this;
    const isTouch = event.pointerType === "touch";
    const grip = isTouch ? null : gripAt(gripsOf(planner), screen);
    const bounds = planner.selectionBounds;
    if (grip?.handle === "turn" && bounds) {
      const middle = middleOf(bounds);
      const from = directionOf(minus(world, middle));
      this.enter({ kind: "rotating", elements: planner.selected, middle, from, turn: 0 });
    } else if (grip && grip.handle !== "turn") {
      const [path] = planner.selection.paths;
      const context = contextOf(planner.document, path);
      if (context) this.enter({ kind: "resizing", context, handle: grip.handle.id, ops: [], preview: noPreview });
    } else {
      const item = itemAt(planner, world, this.reach);
      this.enter({ kind: "pressed", screen, world, item, isTouch });
    }
  }

  private move(event: PointerEvent): void {
    const { screen, world } = this.placeOf(event);
    const [x, y] = minus(screen, this.last);
    this.last = screen;
    const { planner, scope } = this;
    planner.pointer = world;
    if (scope.kind === "pinching") {
      this.touches.move(event, screen);
      return;
    }
    const keys = keysOf(event);
    if (this.isSpaceHeld && scope.kind !== "panning") {
      planner.viewport.pan(x, y);
      return;
    }
    switch (scope.kind) {
      case "panning":
        this.pan(scope, screen, [x, y]);
        break;
      case "pressed":
        if (distance(screen, scope.screen) > slack) this.enter(dragScope(planner, scope, screen, world, keys));
        break;
      case "marquee":
        this.stretch(scope, world);
        break;
      case "moving":
        this.enter(dragMove(planner, scope, world, keys));
        break;
      case "carrying":
        carry(planner, scope, world, keys); // the answer of the server shows it
        break;
      case "rotating":
        this.enter(dragTurn(planner, scope, world, keys));
        break;
      case "resizing":
        this.enter(dragSize(planner, scope, world));
        break;
      case "measuring":
        this.enter(aimMeasure(planner, scope, world, keys));
        break;
      case "drawing":
        this.enter(penMove(planner, scope, world, keys));
        break;
      case "scaling":
        this.enter(picture.aimLine(planner, scope, world, keys.alt));
        break;
      case "cropping":
        this.enter(picture.dragCrop(planner, scope, world));
        break;
      case "shifting":
        this.enter(picture.dragPicture(planner, scope, world));
        break;
      case "idle":
        this.hover(event.pointerType === "mouse" ? itemAt(planner, world, this.reach) : null);
        planner.changes.note("preview");
        break;
    }
  }

  private pan(scope: Extract<Scope, { kind: "panning" }>, screen: Point, [x, y]: Point): void {
    const hasMoved = scope.hasMoved || distance(screen, scope.screen) > slack;
    if (!hasMoved) return;
    // The first movement makes up for the way of the slack.
    const [dx, dy] = scope.hasMoved ? [x, y] : minus(screen, scope.screen);
    this.planner.viewport.pan(dx, dy);
    this.enter({ ...scope, hasMoved });
  }

  /** From left to right, the marquee selects what lies inside; from right to left, also what it touches. */
  private stretch(scope: Extract<Scope, { kind: "marquee" }>, to: Point): void {
    const { document, layers, selection } = this.planner;
    const next = { ...scope, to };
    const found = itemsWithin(document, layers, boundsBetween(next), to[0] < scope.from[0]);
    selection.set([...scope.kept, ...found]);
    this.enter(next);
  }

  private measureTo(world: Point, keys: Keys): void {
    if (this.scope.kind !== "measuring") return;
    const aimed = aimMeasure(this.planner, this.scope, world, keys);
    this.enter(setMeasure(aimed, (line) => this.measured.push(line)));
  }

  /** Moves the end of a measurement by pixels of the screen, or that of a line of the picture by pixels of it. */
  moveCross(x: number, y: number): void {
    const { planner } = this;
    if (this.scope.kind === "scaling") this.enter(picture.movedCross(planner, this.scope, [x, y]));
    if (this.scope.kind === "drawing") this.enter(moveCrossOf(planner, this.scope, [x, y]));
    if (this.scope.kind !== "measuring") return;
    const { viewport } = planner;
    const screen = viewport.toScreen(planner.pointer ?? viewport.centre);
    planner.pointer = viewport.toWorld([screen[0] + x, screen[1] - y]);
    this.enter(aimMeasure(planner, this.scope, planner.pointer, noKeys));
  }

  setAtCross(): void {
    if (this.scope.kind === "scaling") this.enter(picture.withEnd(this.planner, this.scope));
    else if (this.scope.kind === "drawing") this.enter(setCorner(this.planner, this.scope));
    else this.measureTo(this.planner.pointer ?? this.planner.viewport.centre, noKeys);
  }

  /** Takes the last corner back; false if there is none. */
  takeBack(): boolean {
    const { scope } = this;
    const isLine = (scope.kind === "scaling" || scope.kind === "measuring") && scope.from !== null;
    const before = scope.kind === "drawing" ? takeBack(this.planner, scope) : isLine ? this.resting : null;
    if (before) this.enter(before);
    return before !== null;
  }

  /** Values that a person types for the edge that is being drawn. */
  type(typed: { length: string; angle: string }): void {
    if (this.scope.kind === "drawing") this.enter(withTyped(this.planner, this.scope, typed));
  }

  private up(event: PointerEvent): void {
    const { planner, scope } = this;
    this.touches.release(event);
    if (scope.kind === "drawing") {
      const { screen, world } = this.placeOf(event);
      this.enter(penUp(planner, scope, screen, world, keysOf(event)));
    }
    if (resting.has(scope.kind)) return;
    if (scope.kind !== "pressed") this.hover(null); // the element under the pointer may have moved
    this.enter(scope.kind === "panning" ? scope.before : this.resting);
    if (scope.kind === "pressed") this.click(scope.item, event.shiftKey);
    else if (scope.kind === "panning" && scope.button === buttons.right && !scope.hasMoved) this.rightClick(event);
    else if (!drop(planner, scope) && scope.kind === "resizing") {
      const { world } = this.placeOf(event);
      this.click(itemAt(planner, world, this.reach), event.shiftKey);
    }
  }

  private click(item: Item | null, isAdding: boolean): void {
    const { selection } = this.planner;
    if (item && isAdding) selection.toggle(item);
    else if (item) selection.set([item]);
    else if (!isAdding) selection.clear();
  }

  /** Ends the line that is being drawn, or opens the menu. */
  private rightClick(event: PointerEvent): void {
    const { scope } = this;
    if (scope.kind === "drawing" && scope.stroke.points.length > 0) this.enter(endStroke(this.planner, scope));
    else this.openMenu(event);
  }

  private openMenu(event: PointerEvent): void {
    const { screen, world } = this.placeOf(event);
    const { planner } = this;
    const item = itemAt(planner, world, this.reach);
    if (item && !planner.selection.has(item)) planner.selection.set([item]);
    else if (!item) planner.selection.clear();
    this.onMenu(screen);
  }

  private hover(item: Item | null): void {
    this.hovered = item;
    this.surface.classList.toggle("over", item !== null);
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const { planner, scope } = this;
    planner.viewport.turnWheel(event, this.placeOf(event).screen, planner.wheelPans);
    const { world } = this.placeOf(event);
    if (scope.kind === "drawing") this.enter(penMove(planner, scope, world, keysOf(event)));
    else if (scope.kind === "measuring") this.enter(aimMeasure(planner, scope, world, keysOf(event)));
  }
}
