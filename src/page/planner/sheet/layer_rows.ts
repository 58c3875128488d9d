// The layers of a drawing in the panel of the picture: each is shown or not.

import { counted } from "../../data/format";
import { button, element } from "../../panel/dom";
import { say, text } from "../text";
import type { SheetLayer } from "./sheet";

/** What a person decides. */
export interface LayerActions {
  /** Whether layers are shown, by their names. */
  decide: (decided: Record<string, boolean>) => void;
  /** Opens a menu for the outlines of a layer, at a place of the screen. */
  take: (layer: number, x: number, y: number) => void;
}

function layerRow(
  { name, colour, lines, texts }: SheetLayer,
  isShown: boolean,
  show: (shown: boolean) => void,
): HTMLElement {
  const box = element("input", {
    type: "checkbox",
    "data-key": `picture/layer/${name}`,
    on: { change: () => show(box.checked) },
  });
  box.checked = isShown;
  const swatch = element("span", { class: "swatch", "aria-hidden": "true" });
  swatch.style.background = colour;
  return element(
    "label",
    { class: "layer" },
    box,
    swatch,
    element("span", { class: "layer-name", text: name }),
    element("small", { text: `${counted(text.dxf.lines, lines)}, ${counted(text.dxf.texts, texts)}` }),
  );
}

function outlineButton({ name, outlines }: SheetLayer, take: (x: number, y: number) => void): HTMLElement[] {
  if (outlines === 0) return [];
  const open = button(
    counted(text.dxf.outlines, outlines),
    () => {
      const { left, bottom } = open.getBoundingClientRect();
      take(left, bottom);
    },
    {
      class: "small",
      "aria-label": say(text.dxf.outlines_of, counted(text.dxf.outlines, outlines), name),
      "data-key": `picture/outlines/${name}`,
    },
  );
  return [open];
}

export function layerRows(
  layers: readonly SheetLayer[],
  hidden: ReadonlySet<number>,
  { decide, take }: LayerActions,
): HTMLElement {
  const all = (shown: boolean) => () => decide(Object.fromEntries(layers.map(({ name }) => [name, shown])));
  return element(
    "details",
    { class: "nested sheet-layers", open: true },
    element("summary", { text: text.dxf.layers, "data-key": "picture/layers" }),
    element(
      "div",
      { class: "buttons" },
      button(text.dxf.all, all(true), { class: "small", "data-key": "picture/layers/all" }),
      button(text.dxf.none, all(false), { class: "small", "data-key": "picture/layers/none" }),
    ),
    ...layers.flatMap((layer, k) => [
      layerRow(layer, !hidden.has(k), (shown) => decide({ [layer.name]: shown })),
      ...(hidden.has(k) ? [] : outlineButton(layer, (x, y) => take(k, x, y))),
    ]),
  );
}
