// The legend of the marks of labels and units, with the number of labels of each class.

import { grouped } from "../../../data/format";
import { Choice, element, replaceChildren } from "../../../panel/dom";
import { key, type KeyShape } from "../../../panel/key";
import { unitStates } from "../../document/devices";
import type { Planner } from "../../planner";
import { say, text } from "../../text";
import { bandColour, keyShapes, otherColours, palettes } from "../looks";
import { verdicts } from "../verdicts";

const missedBands = 2;

export class Legend {
  private readonly list = element("ul", { class: "legend" });
  private readonly palette: Choice<(typeof palettes)[number]>;
  readonly root: HTMLElement;

  constructor(private readonly planner: Planner) {
    this.palette = new Choice(
      "palette",
      text.light.palette,
      palettes.map((name) => [name, text.light.palettes[name]]),
      (name) => planner.light.setPalette(name),
    );
    this.root = element("div", {}, this.list, this.palette.root);
  }

  update(): void {
    const { light } = this.planner;
    this.palette.show(light.palette);
    replaceChildren(this.list, light.field ? [...this.labels(), ...this.units()] : this.units());
  }

  private labels(): HTMLElement[] {
    const { light } = this.planner;
    const { counts, bandCounts } = light.verdicts;
    const isHollow = light.isPreview;
    const entry = (shape: KeyShape, colour: string, name: string, count: number, canBeHollow = true) => {
      const made = key(shape, colour, name, element("small", { text: grouped(count) }));
      made.classList.toggle("hollow", canBeHollow && isHollow);
      made.classList.toggle("stale", light.isStale);
      return made;
    };
    const bands = text.light.bands.map((name, band) => ({ name, band, count: bandCounts[band] })).reverse();
    const others = (["undecided", "unknown"] as const).map((name) => ({ name, count: counts[verdicts.indexOf(name)] }));
    return [
      ...bands
        .filter(({ band }) => band >= missedBands)
        .map(({ name, band, count }) => entry(keyShapes.reached, bandColour(band, light.palette), name, count)),
      ...others
        .filter(({ name, count }) => name === "undecided" || count > 0)
        .map(({ name, count }) => entry(keyShapes[name], otherColours[name], text.light.classes[name], count, false)),
      ...bands
        .filter(({ band }) => band < missedBands)
        .map(({ name, band, count }) => entry(keyShapes.missed, bandColour(band, light.palette), name, count)),
    ];
  }

  private units(): HTMLElement[] {
    const units = text.light.units;
    const excluded = key("dot", "--cand", units.excluded);
    excluded.classList.add("hollow");
    const { state } = this.planner.document.units;
    return [
      key("square", "--unit", units.installed),
      key("diamond", "--accent", units.pinned),
      key("dot", "--unit", units.selected),
      key("cross", "--cand", units.candidate),
      ...(state.includes(unitStates.indexOf("excluded")) ? [excluded] : []),
    ];
  }
}

/** What hollow and pale marks mean, while there are any. */
export const notesOf = ({ light }: Planner): string[] => [
  ...(light.isPreview && light.stage ? [say(text.light.hollow, text.light.stages[light.stage])] : []),
  ...(light.isStale ? [text.light.pale] : []),
];
