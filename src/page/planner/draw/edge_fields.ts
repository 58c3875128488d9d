// The fields at the pointer: length and angle of the edge that is being drawn. Typed values win over snapping. The fields
// follow the pointer, which goes through them; digits and Tab begin to type.

import { element } from "../../panel/dom";
import type { Gestures } from "../gesture/gestures";
import { tidy } from "../geometry/units";
import { directionOf, distance, minus } from "../geometry/vector";
import type { Planner } from "../planner";
import { text } from "../text";
import { lastOf } from "./stroke";

const aside = 18; // pixels from the pointer
const margin = 8; // pixels from the edges of the plan

export class EdgeFields {
  readonly root = element("div", { class: "edge-fields", role: "group", hidden: true, "aria-label": text.draw.edge });
  private readonly length = this.field(text.draw.length);
  private readonly angle = this.field(text.draw.angle);
  private readonly unit = element("span", { class: "unit" });

  /** `done`: the plan gets the focus. */
  constructor(
    private readonly planner: Planner,
    private readonly gestures: Gestures,
    private readonly done: () => void,
  ) {
    this.root.append(this.length, this.unit, this.angle, element("span", { class: "unit", text: "°" }));
    // A form of two fields without a button has no Enter of its own.
    this.root.addEventListener("keydown", (event) => {
      if (event.key !== "Enter") return;
      event.preventDefault();
      this.gestures.setAtCross();
      this.clear();
      this.done();
    });
  }

  private field(name: string): HTMLInputElement {
    return element("input", {
      type: "text",
      "aria-label": name,
      autocomplete: "off",
      spellcheck: "false",
      on: { input: () => this.gestures.type({ length: this.length.value.trim(), angle: this.angle.value.trim() }) },
    });
  }

  /** A digit that is typed over the plan begins the length. */
  begin(typed: string): boolean {
    if (this.root.hidden) return false;
    this.length.value = typed;
    this.length.focus({ preventScroll: true });
    this.gestures.type({ length: typed, angle: this.angle.value.trim() });
    return true;
  }

  private clear(): void {
    this.length.value = "";
    this.angle.value = "";
  }

  update(): void {
    const { scope } = this.gestures;
    const { planner, root } = this;
    const from = scope.kind === "drawing" ? lastOf(scope.stroke) : undefined;
    const end = scope.kind === "drawing" ? scope.end : null;
    const hadFocus = root.contains(document.activeElement);
    root.hidden = !from || !end || !planner.isPlan;
    // Esc clears the typed text.
    const typed = scope.kind === "drawing" ? scope.typed : { length: "", angle: "" };
    if (this.length.value.trim() !== typed.length) this.length.value = typed.length;
    if (this.angle.value.trim() !== typed.angle) this.angle.value = typed.angle;
    if (!from || !end) {
      this.clear();
      if (hadFocus) this.done();
      return;
    }
    const { unit } = planner.document;
    const way = minus(end.at, from);
    this.unit.textContent = unit.name;
    this.length.placeholder = String(
      tidy(distance(from, end.at) / unit.factor, { ...unit, decimals: Math.max(unit.decimals - 2, 0) }),
    );
    this.angle.placeholder = String(Math.round(10 * directionOf(way)) / 10);
    const [x, y] = planner.viewport.toScreen(end.at);
    // Never below the pointer: on its other side at the right and lower edges of the plan.
    const beside = (at: number, size: number, most: number) =>
      `${Math.max(at + aside + size + margin > most ? at - aside - size : at + aside, margin)}px`;
    root.style.left = beside(x, root.offsetWidth, planner.viewport.width);
    root.style.top = beside(y, root.offsetHeight, planner.viewport.height);
  }
}
