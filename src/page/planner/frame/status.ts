// The line below the plan: what the pointer is at, a hint, and the last notice, which screen readers speak.

import { element } from "../../panel/dom";
import { counted } from "../../data/format";
import { say, text } from "../text";
import type { Commands } from "../access/commands";
import { ScaleChip } from "../backdrop/chip";
import type { Gestures } from "../gesture/gestures";
import { namesOf } from "../elements/names";
import { lengthText } from "../geometry/units";
import type { Planner } from "../planner";
import { chosenUnits, nameOfUnit, whyFixed } from "../units/chosen";

const noticeTime = 6000; // ms

export class StatusLine {
  private readonly place = element("span", { class: "place" });
  private readonly counts = element("span", { class: "counts" });
  private readonly hint = element("span", { class: "hint" });
  private readonly notice = element("span", { class: "notice", role: "status" });
  private readonly chip: ScaleChip;
  readonly root: HTMLElement;

  private said: unknown = null;
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly planner: Planner,
    private readonly gestures: Gestures,
    commands: Commands,
  ) {
    this.chip = new ScaleChip(planner, commands);
    this.root = element("footer", { class: "status" }, this.hint, this.chip.root, this.counts, this.place, this.notice);
  }

  update(): void {
    const { planner } = this;
    const { pointer, isPlan, document } = planner;
    this.place.textContent =
      pointer && isPlan
        ? say(text.status.place, lengthText(pointer[0], document.unit), lengthText(pointer[1], document.unit))
        : "";
    const count = (kind: "label" | "unit", { count }: { count: number }) => counted(text.counted[kind], count);
    this.counts.hidden = planner.tool === "scale" || planner.tool === "check" || planner.tool === "crop";
    this.counts.textContent = `${count("label", document.labels)}, ${count("unit", document.units)}`;
    this.hint.textContent = this.hintOf();
    this.chip.update();
    if (planner.notice === this.said) return;
    this.said = planner.notice;
    this.notice.textContent = planner.notice?.text ?? "";
    this.notice.classList.toggle("problem", planner.notice?.isProblem ?? false);
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      this.notice.textContent = "";
    }, noticeTime);
  }

  private hintOf(): string {
    const { planner, gestures } = this;
    const { kind } = gestures.scope;
    if (planner.mover.isDragging) return text.hints.carrying;
    if (!planner.isPlan) return text.hints.space;
    if (kind === "moving" || kind === "rotating" || kind === "resizing" || kind === "marquee") return text.hints[kind];
    if (kind === "shifting") return text.hints.shifting;
    if (kind === "scaling" && gestures.scope.to) return text.hints.length;
    if (planner.tool !== "select") return text.hints[planner.tool];
    const { items } = planner.selection;
    const units = chosenUnits(planner);
    if (units.length === 1 && whyFixed(planner, units[0]) === null)
      return say(text.hints.units, nameOfUnit(planner, units[0]));
    if (items.length === 0) return text.hints.nothing;
    const elements = planner.selected;
    if (elements.length === 0) return text.hints.locked;
    return say(text.hints.selected, namesOf(elements));
  }
}
