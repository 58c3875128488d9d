// Drags a unit in 3-D, along the surface that carries it.

import type { Stage } from "../../scene/stage";
import { wholeSteps } from "../actions/copy";
import type { Point } from "../document/messages";
import { minus, plus } from "../geometry/vector";
import type { Planner } from "../planner";
import { meets } from "../units/surface";
import { deviceItem } from "../view/hit";

const slack = 4; // pixels between a click and a drag

interface Pressed {
  index: number;
  at: Point;
  /** From the pointer to the middle of the mark, pixels. */
  offset: Point;
  hasMoved: boolean;
}

export class UnitDrag {
  private pressed: Pressed | null = null;

  constructor(
    private readonly planner: Planner,
    private readonly stage: Stage,
  ) {}

  /** The button is pressed on a unit: the view does not turn. */
  press(index: number, at: Point): void {
    const { x, y } = this.stage.project(this.planner.mover.placeOf(index));
    this.pressed = { index, at, offset: minus([x, y], at), hasMoved: false };
    this.stage.orbit.enabled = false;
  }

  move(at: Point): void {
    const { pressed, planner } = this;
    if (!pressed) return;
    if (!pressed.hasMoved) {
      if (Math.hypot(...minus(at, pressed.at)) <= slack) return;
      pressed.hasMoved = true;
      planner.selection.set([deviceItem(planner.document.units, pressed.index)]);
      planner.mover.begin(pressed.index);
    }
    pressed.at = at;
    this.aim(pressed);
  }

  /** Moves the unit to where its surface is at the pointer, when that surface is known. */
  private aim({ at, offset }: Pressed): void {
    const { mover, document } = this.planner;
    mover.to((mount) => {
      const place = meets(this.stage.rayAt(...plus(at, offset)), mount, document.parts.all);
      if (!place) return null;
      const [x, y, z] = place;
      const [height] = wholeSteps(this.planner, [z, 0]);
      return [...wholeSteps(this.planner, [x, y]), height];
    });
  }

  /** The unit stays where it was last; false if it was a click. */
  release(): boolean {
    const { pressed } = this;
    this.end();
    if (!pressed?.hasMoved) return false;
    this.aim(pressed);
    void this.planner.mover.drop();
    return true;
  }

  cancel(): void {
    this.end();
    this.planner.mover.cancel();
  }

  private end(): void {
    if (this.pressed) this.stage.orbit.enabled = !this.planner.isPlan;
    this.pressed = null;
  }
}
