// The legend of the picture: the classes of labels with their numbers, and the other marks in it.

import { grouped } from "../../data/format";
import { element } from "../../panel/dom";
import { key } from "../../panel/key";
import type { Model } from "../data/model";
import { say, text } from "../data/text";
import type { ClassCounts } from "../scene/picture";

export class Legend {
  readonly root = element("ul", { class: "legend v3-legend" });

  constructor(private readonly model: Model) {}

  update({ classes, counts }: ClassCounts): void {
    const { state, store } = this.model;
    const { selection } = state;
    // Classes with other shapes than discs are listed only if they occur.
    const items = classes.flatMap(({ name, colour, shape = "disc" }, k) =>
      shape !== "disc" && counts[k] === 0 ? [] : [key(shape, colour, say(text.legend.class, name, grouped(counts[k])))],
    );
    if (!classes[0].shape && this.model.coverage.reached < store.labels.ids.length)
      items.push(key("triangle", "--floor", text.legend.not_reached));
    if (selection?.kind === "label") items.push(...this.links(selection.index));
    if (this.model.shop?.blocks) items.push(key("block", "--people", text.legend.people));
    items.push(key("dot", "--unit", text.legend.unit), key("cross", "--cand", text.legend.candidate));
    const title =
      selection?.kind === "unit" ? say(text.legend.reach, store.units.ids[selection.index]) : this.model.classes.title;
    this.root.replaceChildren(element("li", {}, element("strong", { text: title })), ...items);
  }

  private links(label: number): HTMLElement[] {
    const shares = this.model.contributions(label).map(({ directShare }) => directShare);
    return [
      ...(shares.some((share) => share !== null)
        ? [key("solid", "--direct", text.legend.direct), key("dashed", "--reflected", text.legend.reflected)]
        : []),
      ...(shares.includes(null) ? [key("solid", "--edge", text.legend.not_stored)] : []),
    ];
  }
}
