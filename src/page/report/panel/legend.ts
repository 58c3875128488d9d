// The legend of the picture: the classes of labels with their numbers, and the other marks in it.

import { grouped } from "../../data/format";
import { element } from "../../panel/dom";
import type { Model } from "../data/model";
import { say, text } from "../data/text";
import type { ClassCounts } from "../scene/picture";

const shapes = {
  disc: '<circle r="7" class="v3-thin"/>',
  triangle: '<path d="M0-8 8 6H-8Z"/>',
  square: '<path d="M-6-6H6V6H-6Z"/>',
  block: '<path d="M-5-8H5V8H-5Z"/>',
  dot: '<circle r="8" class="v3-bare"/>',
  cross: '<path d="M-4 0h8M0-4v8" class="v3-stroke"/>',
  solid: '<path d="M-9 0H9" class="v3-stroke v3-wide"/>',
  dashed: '<path d="M-9 0H9" class="v3-stroke v3-wide v3-dashed"/>',
};

/** `colour`: a CSS variable. */
function key(shape: keyof typeof shapes, colour: string, name: string): HTMLElement {
  const mark = element("span", { class: "v3-key" });
  mark.innerHTML = `<svg viewBox="-10 -10 20 20">${shapes[shape]}</svg>`;
  mark.style.setProperty("--tone", `var(${colour})`);
  return element("li", {}, mark, name);
}

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
