// The layers: kinds of elements and shelf levels, shown or hidden, free or locked.

import { button, element, replaceChildren } from "../../panel/dom";
import { grouped } from "../../data/format";
import { icon } from "../access/icons";
import { drawingPath } from "../backdrop/drawing";
import { elementsOf } from "../elements/kinds";
import type { Planner } from "../planner";
import { say, text } from "../text";
import { layers, levelOf, type Layer } from "../view/layers";

export class LayerList {
  private readonly kinds = element("ul", { class: "layers" });
  private readonly levels = element("ul", { class: "layers" });
  private readonly levelTitle = element("h3", { text: text.layers.levels });
  readonly root = element(
    "div",
    { class: "scroll" },
    element("h3", { text: text.layers.kinds }),
    this.kinds,
    this.levelTitle,
    this.levels,
  );

  constructor(private readonly planner: Planner) {}

  update(): void {
    const { document } = this.planner;
    const counts = new Map<Layer, number>([
      ["label", document.labels.count],
      ["unit", document.units.count],
    ]);
    for (const { kind } of elementsOf(document.json))
      if (kind !== "label" && kind !== "unit") counts.set(kind, (counts.get(kind) ?? 0) + 1);
    replaceChildren(this.kinds, [
      ...layers
        .filter((layer) => layer === "names" || counts.get(layer))
        .map((layer) => this.layer(layer, text.layers.names[layer], counts.get(layer))),
      ...(this.planner.drawing ? [this.picture()] : []),
    ]);
    const byLevel = new Map<number, number>();
    for (const level of document.labels.state) byLevel.set(level, (byLevel.get(level) ?? 0) + 1);
    // From the top level down.
    const levels = [...byLevel].sort(([a], [b]) => b - a);
    this.levelTitle.hidden = levels.length < 2;
    replaceChildren(this.levels, levels.length < 2 ? [] : levels.map(([level, count]) => this.level(level, count)));
  }

  private switchOf(
    name: string,
    key: string,
    isOn: boolean,
    icons: ["shown", "hidden"] | ["locked", "free"],
    set: (on: boolean) => void,
  ) {
    const made = button("", () => set(!isOn), {
      class: isOn ? "switch on" : "switch",
      "aria-pressed": String(isOn),
      "aria-label": name,
      title: name,
      "data-key": key,
    });
    made.append(icon(isOn ? icons[0] : icons[1]));
    return made;
  }

  private layer(layer: Layer, name: string, count: number | undefined, showKey = `show-${layer}`): HTMLElement {
    const { layers: state } = this.planner;
    const isShown = state.isShown(layer);
    return element(
      "li",
      { class: isShown ? "" : "off" },
      this.switchOf(say(text.layers.show, name), showKey, isShown, ["shown", "hidden"], (shown) =>
        state.show(layer, shown),
      ),
      element("span", { class: "name", text: name }),
      element("small", { text: count === undefined ? "" : grouped(count) }),
      layer === "names"
        ? null
        : this.switchOf(
            say(text.layers.lock, name),
            `lock-${layer}`,
            state.isLocked(layer),
            ["locked", "free"],
            (locked) => state.lock(layer, locked),
          ),
    );
  }

  private picture(): HTMLElement {
    const { look } = this.planner;
    const { isShown, isLocked } = look.now;
    const name = text.picture.title;
    return element(
      "li",
      { class: isShown ? "" : "off" },
      this.switchOf(say(text.layers.show, name), "show-picture", isShown, ["shown", "hidden"], (on) =>
        look.set({ isShown: on }),
      ),
      button(name, () => this.planner.openType(drawingPath), { class: "plain", "data-key": "open-picture" }),
      this.switchOf(say(text.layers.lock, name), "lock-picture", isLocked, ["locked", "free"], (on) =>
        look.set({ isLocked: on }),
      ),
    );
  }

  private level(level: number, count: number): HTMLElement {
    const layer = levelOf(level);
    return this.layer(layer, say(text.layers.level, level + 1), count, layer);
  }
}
