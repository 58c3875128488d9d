// Shelf levels to show or hide.

import { button, element } from "../panel/dom";
import { grouped } from "./format";
import type { Model } from "./model";

export class Levels {
  readonly root = element("section", { class: "v3-box" }, element("h3", { text: "Shelf levels" }));
  private readonly boxes: HTMLInputElement[] = [];
  private readonly shares: HTMLElement[] = [];
  private readonly goods: HTMLInputElement;

  constructor(private readonly model: Model) {
    const { store } = model;
    const list = element("ul", { class: "v3-list v3-levels" });
    // From the top down, as they hang.
    for (let level = store.levels.length - 1; level >= 0; --level) {
      const box = element("input", {
        type: "checkbox",
        on: { change: () => this.set((shown, k) => (k === level ? box.checked : shown)) },
      });
      const share = element("small", { "data-level": level + 1 });
      this.boxes[level] = box;
      this.shares[level] = share;
      list.append(
        element(
          "li",
          {},
          element("label", {}, box, element("span", {}, element("strong", { text: String(level + 1) }), ` ${store.levels[level].heights.replace("labels at ", "")}`, share)),
          store.levels.length > 1
            ? button("only", () => this.set((_, k) => k === level), {
                class: "v3-small",
                "aria-label": `Show level ${level + 1} only`,
              })
            : null,
        ),
      );
    }
    this.goods = element("input", {
      type: "checkbox",
      on: {
        change: () => {
          model.state.goods = this.goods.checked;
          model.changed();
        },
      },
    });
    this.root.append(
      list,
      element(
        "div",
        { class: "v3-row" },
        store.levels.length > 1 ? button("All levels", () => this.set(() => true), { class: "v3-small" }) : null,
        store.part.look.includes(2) ? element("label", {}, this.goods, "Goods") : null,
      ),
    );
  }

  private set(shown: (was: boolean, level: number) => boolean): void {
    this.model.state.levels = this.model.state.levels.map(shown);
    this.model.changed();
  }

  update(): void {
    const { store, state } = this.model;
    this.goods.checked = state.goods;
    this.boxes.forEach((box, level) => {
      box.checked = state.levels[level];
      const { met, all } = this.model.share((label) => store.label.level[label] === level);
      this.shares[level].textContent = `${grouped(met)} of ${grouped(all)}`;
    });
  }
}
