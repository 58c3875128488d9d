// Ids of fixtures over the picture, as many as fit without overlap.

import { element } from "../panel/dom";
import type { Stage } from "./stage";

const letter = 6.4; // CSS pixels, width of a letter
const line = 20; // CSS pixels, distance between ids above one another

export class Names {
  readonly root = element("div", { class: "names", "aria-hidden": "true" });
  private shown = "";
  private names: { at: number[]; width: number; text: HTMLElement }[] = [];

  set(names: { id: string; at: number[] }[]): void {
    const wanted = JSON.stringify(names);
    if (wanted === this.shown) return;
    this.shown = wanted;
    this.names = names.map(({ id, at }) => ({
      at,
      width: letter * id.length + 14,
      text: element("span", { text: id, hidden: true }),
    }));
    this.root.replaceChildren(...this.names.map(({ text }) => text));
  }

  /** No id covers the points `taken`. */
  update(stage: Stage, taken: number[][]): void {
    const { width, height } = stage.size;
    const placed = taken.map((at) => ({ ...stage.project(at), width: 26 }));
    const seen = this.names.map((name) => ({ name, ...stage.project(name.at) }));
    // The nearest ids have priority.
    seen.sort((a, b) => a.depth - b.depth);
    for (const { name, x, y, depth } of seen) {
      const inside = depth < 1 && x > 0 && y > 0 && x < width && y < height;
      const free =
        inside &&
        placed.every((other) => Math.abs(other.x - x) > (other.width + name.width) / 2 || Math.abs(other.y - y) > line);
      name.text.hidden = !free;
      if (!free) continue;
      placed.push({ x, y, depth, width: name.width });
      name.text.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -50%)`;
    }
  }
}
