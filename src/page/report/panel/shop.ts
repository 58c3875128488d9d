// The choice of a state in which the shop is shown.

import { element } from "../../panel/dom";
import { counted } from "../../data/format";
import type { Model } from "../data/model";
import type { ShopState } from "../data/store";
import { say, text } from "../data/text";

function verdictOf({ missed }: ShopState): string {
  return missed.length ? counted(text.shop.missed, missed.length) : text.shop.all_reached;
}

export class ShopChoice {
  readonly root = element("div", { class: "v3-row v3-shop" });
  private readonly choice = element("select", { name: "v3-shop", on: { change: () => this.choose() } });
  private readonly note = element("span", { class: "v3-note", role: "status" });

  constructor(private readonly model: Model) {
    const { states } = model.store;
    for (const name of [
      text.shop.as_in_file,
      ...states.map((state) => say(text.shop.state, state.number, verdictOf(state))),
    ])
      this.choice.append(element("option", { text: name }));
    this.root.append(
      element("label", {}, element("span", { class: "v3-note", text: text.shop.title }), this.choice),
      this.note,
    );
  }

  private choose(): void {
    const { selectedIndex } = this.choice;
    this.model.state.shop = selectedIndex > 0 ? selectedIndex - 1 : null;
    this.model.changed();
  }

  update(): void {
    const { shop } = this.model;
    this.choice.selectedIndex = (this.model.state.shop ?? -1) + 1;
    this.note.textContent = shop ? this.describe(shop) : "";
  }

  private describe(shop: ShopState): string {
    const { blocks, open } = shop;
    const isExamined = this.model.missedInShop() !== null;
    const parts = [
      counted(text.shop.blocks, blocks),
      ...(open.length ? [counted(text.shop.open, open.length)] : []),
      ...(isExamined ? [verdictOf(shop)] : []),
    ];
    return `${parts.join("; ")}. ${isExamined ? text.shop.others : text.shop.original_only}`;
  }
}
