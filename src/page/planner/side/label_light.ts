// The light at the selected label, in its properties.

import { element } from "../../panel/dom";
import { lightFacts, selectedLabel } from "../light/facts";
import type { Planner } from "../planner";
import { text } from "../text";

export class LabelLight {
  private readonly list = element("dl", { id: "label-light" });
  /** Tab leads to it, so that screen readers read it aloud. */
  private readonly root = element(
    "section",
    {
      class: "label-light",
      tabindex: 0,
      "aria-label": text.light.facts.title,
      "aria-describedby": "label-light",
      "data-key": "light",
    },
    this.list,
  );

  constructor(private readonly planner: Planner) {}

  /** Of the selection, if it is one label. */
  content(): HTMLElement[] {
    this.update();
    return this.root.hidden ? [] : [this.root];
  }

  /** Values come more often than the panel is built. */
  update(): void {
    const { planner } = this;
    planner.light.refresh();
    const label = selectedLabel(planner);
    this.root.hidden = label === undefined || label >= planner.document.labels.count || planner.light.event === null;
    if (this.root.hidden || label === undefined) return;
    const facts = lightFacts(planner, label);
    this.list.replaceChildren(
      ...facts.flatMap(([term, words]) => [element("dt", { text: term }), element("dd", { text: words })]),
    );
  }
}
