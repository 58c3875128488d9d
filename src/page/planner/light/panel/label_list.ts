// The labels with the smallest margins. A click selects a label and goes to it.

import { button, element, replaceChildren } from "../../../panel/dom";
import { key } from "../../../panel/key";
import type { Planner } from "../../planner";
import { text } from "../../text";
import { deviceItem } from "../../view/hit";
import { labelName, marginText, selectedLabel } from "../facts";
import { bandColour, keyShapes, otherColours } from "../looks";
import { weakestLabels } from "../weakest";

const most = 12;

export class LabelList {
  readonly root = element("ul", { class: "light-list" });

  constructor(
    private readonly planner: Planner,
    /** Moves the picture there. */
    private readonly show: (label: number) => void,
  ) {}

  update(): void {
    const { planner } = this;
    const { light } = planner;
    const labels = light.field ? weakestLabels(light.verdicts.strength, most) : [];
    const selected = selectedLabel(planner);
    replaceChildren(
      this.root,
      labels.map((label) => this.row(label, label === selected)),
    );
  }

  private row(label: number, isSelected: boolean): HTMLElement {
    const { light } = this.planner;
    const verdict = light.verdicts.of(label);
    const isOpen = verdict === "undecided" || verdict === "unknown";
    const colour = isOpen ? otherColours[verdict] : bandColour(light.verdicts.band[label], light.palette);
    const name = button(labelName(this.planner, label), () => this.go(label), {
      class: "plain",
      "data-key": `weak-${label}`,
      "aria-current": isSelected ? "true" : undefined,
    });
    const row = key(keyShapes[verdict], colour, name, element("small", { text: marginText(this.planner, label) }));
    row.classList.toggle("hollow", light.isPreview && !isOpen);
    row.title = text.light.verdicts[verdict];
    return row;
  }

  private go(label: number): void {
    const { selection, document } = this.planner;
    selection.set([deviceItem(document.labels, label)]);
    this.show(label);
  }
}
