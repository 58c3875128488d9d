// What page and picture show of light: marks, lines to units, the card of the label under the pointer, and the panel.

import type { Stage } from "../../scene/stage";
import { showSelection } from "../actions/source";
import type { Point } from "../document/messages";
import type { Gestures } from "../gesture/gestures";
import { distance } from "../geometry/vector";
import { Hold } from "../gesture/hold";
import { LightPanel } from "../light/panel/panel";
import { LabelCard } from "../plan/label_card";
import type { DeviceMarks } from "../plan/marks";
import { Rays } from "../plan/rays";
import type { Planner } from "../planner";
import { deviceItem } from "../view/hit";

/** The pointer rests before the label under it is looked for in 3-D, ms. */
const rest = 60;
const nearby = 4; // m from which the 3-D picture shows a label or unit

export class LightView {
  readonly panel: LightPanel;
  readonly card: LabelCard;
  private timer: ReturnType<typeof setTimeout> | undefined;
  /** Where the pointer was when the plan moved beneath it. */
  private left: Point | null = null;

  constructor(
    private readonly planner: Planner,
    private readonly gestures: Gestures,
    private readonly stage: Stage,
    private readonly marks: DeviceMarks,
    surface: HTMLElement,
    isPanelOpen: () => boolean,
  ) {
    this.panel = new LightPanel(planner, (kind, index) => this.lookAt(kind, index));
    this.card = new LabelCard(planner);
    const rays = new Rays(planner, stage);
    new Hold(planner.connection).listen(surface, stage.canvas);
    const { changes } = planner;
    changes.listen(["light", "document", "preview", "devices"], () => marks.showLight());
    changes.listen(["viewport"], () => marks.follow());
    changes.listen(["light", "preview", "devices", "selection", "viewport", "tool"], () => rays.update());
    changes.listen(["light", "document", "devices", "selection"], () => isPanelOpen() && this.panel.update());
    changes.listen(["preview"], () => isPanelOpen() && this.panel.followGesture());
    changes.listen(["preview"], () => this.pointAt());
    changes.listen(["viewport", "tool"], () => this.leave());
    changes.listen(["light", "selection"], () => this.card.update());
    this.listen(stage.canvas);
  }

  /** The card of the label under the pointer in the plan. */
  private pointAt(): void {
    const { planner, gestures } = this;
    if (!planner.isPlan) return;
    const { hovered, scope } = gestures;
    const { pointer } = this;
    if (pointer && this.left && distance(pointer, this.left) < 1) return;
    this.left = null;
    const isFree = scope.kind === "idle" && planner.tool === "select";
    this.card.show(isFree ? hovered : null, isFree ? pointer : null);
  }

  private get pointer(): Point | null {
    const { pointer, viewport } = this.planner;
    return pointer && viewport.toScreen(pointer);
  }

  /** The label under the pointer has moved away from it. */
  private leave(): void {
    this.left = this.pointer;
    this.card.show(null, null);
  }

  /** In 3-D: drawing the marks again to find one takes time. */
  private listen(canvas: HTMLCanvasElement): void {
    const hide = () => {
      clearTimeout(this.timer);
      this.card.show(null, null);
    };
    canvas.addEventListener("pointermove", ({ offsetX, offsetY, buttons, pointerType }) => {
      hide();
      if (buttons === 0 && pointerType === "mouse") this.timer = setTimeout(() => this.find([offsetX, offsetY]), rest);
    });
    for (const end of ["pointerleave", "pointerdown", "wheel"] as const)
      canvas.addEventListener(end, hide, { passive: true });
  }

  private find([x, y]: Point): void {
    if (this.planner.isPlan) return;
    const found = this.marks.named(this.stage.pick(x, y));
    if (found?.devices.kind === "label") this.card.show(deviceItem(found.devices, found.index), [x, y]);
  }

  private lookAt(kind: "label" | "unit", index: number): void {
    const { planner } = this;
    this.leave();
    if (planner.isPlan) {
      showSelection(planner);
      return;
    }
    const devices = kind === "label" ? planner.document.labels : planner.document.units;
    const facing = kind === "label" ? [...devices.direction.subarray(3 * index, 3 * index + 3)] : null;
    this.stage.lookAt(devices.at(index), nearby, facing);
  }
}
