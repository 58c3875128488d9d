// A note in the line below the plan while the scale of the picture is unknown or unchecked, or the picture cannot be shown.
// A click starts the missing step, or shows the reason.

import { button } from "../../panel/dom";
import type { CommandId, Commands } from "../access/commands";
import type { Planner } from "../planner";
import { text } from "../text";
import { comparisonOf } from "./transform";

export class ScaleChip {
  readonly root = button("", () => this.commands.run(this.step), { class: "scale-state", hidden: true });
  private step: CommandId = "scale";

  constructor(
    private readonly planner: Planner,
    private readonly commands: Commands,
  ) {}

  update(): void {
    const { drawing, isPlan, picture } = this.planner;
    const isConfirmed =
      drawing && (drawing.scale ? comparisonOf(drawing)?.agrees === true : drawing.unit !== undefined);
    const isLost = picture.state.kind === "failed";
    this.root.hidden = !isPlan || drawing === null || (isConfirmed === true && !isLost);
    const isScaled = drawing?.scale !== undefined;
    this.step = isConfirmed ? "picture" : isScaled ? "check_scale" : "scale";
    const { not_shown, unchecked, no_scale } = text.picture;
    this.root.textContent = isConfirmed ? not_shown : isScaled ? unchecked : no_scale;
  }
}
