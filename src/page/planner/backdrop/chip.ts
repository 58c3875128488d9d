// A note in the line below the plan while the scale of the picture is unknown or unchecked. A click starts the missing step.

import { button } from "../../panel/dom";
import type { Commands } from "../access/commands";
import type { Planner } from "../planner";
import { text } from "../text";
import { comparisonOf } from "./transform";

export class ScaleChip {
  readonly root = button("", () => this.commands.run(this.planner.drawing?.scale ? "check_scale" : "scale"), {
    class: "scale-state",
    hidden: true,
  });

  constructor(
    private readonly planner: Planner,
    private readonly commands: Commands,
  ) {}

  update(): void {
    const { drawing, isPlan } = this.planner;
    const isConfirmed =
      drawing && (drawing.scale ? comparisonOf(drawing)?.agrees === true : drawing.unit !== undefined);
    this.root.hidden = !isPlan || drawing === null || isConfirmed === true;
    this.root.textContent = drawing?.scale ? text.picture.unchecked : text.picture.no_scale;
  }
}
