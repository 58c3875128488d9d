// The card beside the pointer: what is known of the label under it.

import { element } from "../../panel/dom";
import type { Point } from "../document/messages";
import { labelName, labelOf, lightFacts } from "../light/facts";
import type { Planner } from "../planner";
import type { Item } from "../view/selection";

const away = 18; // pixels from the pointer
/** The server is asked for names of labels on which the pointer rests, ms. */
const rest = 120;

export class LabelCard {
  private readonly name = element("h3", {});
  private readonly facts = element("dl", {});
  /** The properties say the same to screen readers. */
  readonly root = element("div", { class: "label-card", "aria-hidden": "true", hidden: true }, this.name, this.facts);
  private label: number | undefined;
  private hasRested = false;
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(private readonly planner: Planner) {}

  /** `item`: what is under the pointer, which is at a place of the plan's screen. */
  show(item: Item | null, at: Point | null): void {
    const { planner } = this;
    const label = at === null ? undefined : labelOf(planner, item);
    if (label !== this.label) {
      this.label = label;
      this.hasRested = false;
      clearTimeout(this.timer);
      if (label !== undefined)
        this.timer = setTimeout(() => {
          this.hasRested = true;
          this.update();
        }, rest);
    }
    if (at) this.place(at);
    this.update();
  }

  /** After a change of light, or when the server has answered. */
  update(): void {
    const { label, planner } = this;
    const isShown = label !== undefined && label < planner.document.labels.count && planner.light.event !== null;
    this.root.hidden = !isShown;
    if (!isShown) return;
    planner.light.refresh();
    this.name.textContent = this.hasRested ? labelName(planner, label) : "…";
    this.facts.replaceChildren(
      ...lightFacts(planner, label).flatMap(([term, words]) => [
        element("dt", { text: term }),
        element("dd", { text: words }),
      ]),
    );
  }

  /** Right of and below the pointer, or on the other side where there is no room. */
  private place([x, y]: Point): void {
    const { width, height } = this.planner.viewport;
    const { offsetWidth, offsetHeight } = this.root;
    const left = x + away + offsetWidth > width ? x - away - offsetWidth : x + away;
    const top = y + away + offsetHeight > height ? y - away - offsetHeight : y + away;
    this.root.style.transform = `translate(${Math.round(Math.max(left, 0))}px, ${Math.round(Math.max(top, 0))}px)`;
  }
}
