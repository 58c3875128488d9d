// The layers of a file: those of its table, and those that only its entities name.

import type { SheetLayer } from "../sheet/sheet";
import type { Entity } from "./file/entity";
import { DxfError } from "./error";
import { colourOfIndex, colourOfNumber, onWhite } from "./palette";

export interface Layer {
  name: string;
  colour: string;
  isOff: boolean;
  isFrozen: boolean;
}

const mostLayers = 65535;
const byName = new Intl.Collator("en", { numeric: true });

export class Layers {
  readonly all: Layer[] = [];
  /** By the name as it is written; names that differ in case only are one layer. */
  private readonly written = new Map<string, number>();
  private readonly known = new Map<string, number>();

  constructor() {
    this.index("0");
  }

  /** Layer "0" has index 0. */
  index(name: string): number {
    const found = this.written.get(name);
    if (found !== undefined) return found;
    const key = name.toUpperCase();
    let index = this.known.get(key);
    if (index === undefined) {
      index = this.all.length;
      if (index >= mostLayers) throw new DxfError("too_many_layers", { limit: mostLayers });
      this.known.set(key, index);
      this.all.push({ name, colour: onWhite(colourOfIndex(7)), isOff: false, isFrozen: false });
    }
    this.written.set(name, index);
    return index;
  }

  /** An entry of the table. */
  define(entity: Entity): void {
    const name = entity.text(2).trim();
    const layer = this.all[this.index(name)];
    const index = entity.number(62, 7);
    layer.name = name;
    layer.colour = onWhite(
      entity.has(420) ? colourOfNumber(entity.number(420)) : colourOfIndex(Math.abs(Math.trunc(index))),
    );
    layer.isOff = index < 0;
    layer.isFrozen = (entity.number(70) & 1) !== 0;
  }

  /** The layers with something on them, by name. Replaces the indices of lines, texts and outlines by those of the list. */
  used(ofLines: Uint16Array, texts: { layer: number }[], outlines: { layer: number }[]): SheetLayer[] {
    const counts = this.all.map(() => ({ lines: 0, texts: 0, outlines: 0 }));
    for (const layer of ofLines) ++counts[layer].lines;
    for (const { layer } of texts) ++counts[layer].texts;
    for (const { layer } of outlines) ++counts[layer].outlines;
    const order = [...this.all.keys()]
      .filter((layer) => counts[layer].lines + counts[layer].texts > 0)
      .sort((a, b) => byName.compare(this.all[a].name, this.all[b].name));
    const places = new Uint16Array(this.all.length);
    for (const [place, layer] of order.entries()) places[layer] = place;
    for (let line = 0; line < ofLines.length; ++line) ofLines[line] = places[ofLines[line]];
    for (const one of [...texts, ...outlines]) one.layer = places[one.layer];
    return order.map((layer) => {
      const { name, colour, isOff, isFrozen } = this.all[layer];
      return { name, colour, isOn: !isOff && !isFrozen, ...counts[layer] };
    });
  }
}
