// Updates the marks and lines of the stage from the model.

import { reachClass, reachClasses, type LabelClass } from "./classes";
import type { Link } from "../../scene/links";
import { Marks, shapes } from "../../scene/marks";
import type { Model } from "../data/model";
import { numberTexture, plusCell, type NumberTexture } from "./numbers";
import { colourOf } from "../../scene/palette";
import type { Stage } from "../../scene/stage";
import { changedUnits } from "../data/state";

const unitColours = ["--unit", "--accent", "--cand"];
const mostLinks = 24;

/** The number of labels in each class on the visible levels. */
export interface ClassCounts {
  classes: LabelClass[];
  counts: number[];
}

export class Picture {
  private readonly levels: { labels: number[]; marks: Marks }[] = [];
  private readonly units: Marks;
  private readonly numbers: NumberTexture;

  constructor(
    private readonly stage: Stage,
    private readonly model: Model,
  ) {
    const { store } = model;
    const labels = store.labels.ids.length;
    const least = labels > 20000 ? 1.7 : labels > 4000 ? 2.3 : 3.2;
    store.levels.forEach((_, level) => {
      const of = [...store.label.level.keys()].filter((label) => store.label.level[label] === level);
      const pick = (values: Float32Array) =>
        Float32Array.from({ length: 3 * of.length }, (_value, k) => values[3 * of[Math.floor(k / 3)] + (k % 3)]);
      const marks = new Marks(
        of.length,
        pick(store.label.position),
        pick(store.label.normal),
        Uint32Array.from(of, (label) => label + 1),
        { worldRadius: 0.085, pixels: [least, 11], lift: 0.03 },
      );
      this.levels.push({ labels: of, marks });
      stage.add(marks);
    });
    this.numbers = numberTexture(store.units.selected.length);
    const count = store.units.ids.length;
    this.units = new Marks(
      count,
      store.candidate.position,
      new Float32Array(3 * count),
      Uint32Array.from({ length: count }, (_, unit) => labels + 1 + unit),
      { worldRadius: 0.28, pixels: [9, 13], lift: 0, numbers: this.numbers },
    );
    this.units.mesh.renderOrder = 3;
    stage.add(this.units);
  }

  /** The label or unit of a picked ident. */
  named(ident: number): { kind: "label" | "unit"; index: number } | null {
    const labels = this.model.store.labels.ids.length;
    if (ident === 0) return null;
    return ident <= labels ? { kind: "label", index: ident - 1 } : { kind: "unit", index: ident - 1 - labels };
  }

  /** The position of the mark of a label or unit, m. */
  place(kind: "label" | "unit", index: number): [number, number, number] {
    const { store, state } = this.model;
    if (kind === "unit") {
      const p = store.candidate.position;
      return [p[3 * index], p[3 * index + 1], p[3 * index + 2]];
    }
    const { position: p, normal: n } = store.label;
    const away = 0.03 + (state.plan ? this.spread() * store.label.level[index] : 0);
    return [0, 1, 2].map((axis) => p[3 * index + axis] + away * n[3 * index + axis]) as [number, number, number];
  }

  recolour(): void {
    const element = this.stage.canvas;
    const [edge, strong, paper] = ["--edge", "--strong", "--floor"].map((name) => colourOf(element, name));
    const classes = this.classes();
    for (const { marks } of this.levels)
      marks.setPalette(
        classes.map(({ colour }) => colourOf(element, colour)),
        { edge, strong, paper },
      );
    this.units.setPalette(
      unitColours.map((name) => colourOf(element, name)),
      {
        edge,
        strong: colourOf(element, "--accent"),
        paper: colourOf(element, "--unit-ink"),
      },
    );
    this.stage.recolour();
  }

  update(): ClassCounts {
    const { state } = this.model;
    const counts = this.updateLabels();
    this.updateUnits();
    this.stage.links.set(this.links());
    this.stage.fixtures.goods.visible = state.goods;
    this.stage.fixtures.showShop(state.shop);
    this.recolour();
    return { classes: this.classes(), counts };
  }

  labelsShown(): number {
    return this.levels.reduce((sum, { labels, marks }) => sum + (marks.mesh.visible ? labels.length : 0), 0);
  }

  private classes(): LabelClass[] {
    return this.model.state.selection?.kind === "unit" ? reachClasses : this.model.classes.list;
  }

  /** Distance in m between the levels in the plan view, where marks would otherwise hide each other. */
  private spread(): number {
    return Math.min(0.17, 0.75 / this.levels.length);
  }

  private updateLabels(): number[] {
    const { coverage, state, classes } = this.model;
    const { selection } = state;
    const list = this.classes();
    const counts = new Array<number>(list.length).fill(0);
    const reach = selection?.kind === "unit" ? this.reachClassOf(selection.index) : null;
    // A person who blocks the light of a label often hides it, too.
    const inFront = reach ? null : this.model.missedInShop();
    this.levels.forEach(({ labels, marks }, level) => {
      marks.mesh.visible = state.levels[level];
      marks.uniform("spread").value = state.plan ? this.spread() : 0;
      labels.forEach((label, mark) => {
        const met = coverage.met[label] !== 0;
        const k = reach ? reach[label] : classes.of(label);
        const selected = this.model.isSelected("label", label);
        const shape = shapes[list[k].shape ?? (met ? "disc" : "triangle")];
        marks.setLook(mark, k, shape, selected ? 2 : inFront?.has(label) ? 3 : reach && k === 0 ? 0 : 1, level);
        if (state.levels[level]) ++counts[k];
      });
      marks.upload();
    });
    return counts;
  }

  private reachClassOf(unit: number): Uint8Array {
    const { coverage, store } = this.model;
    const classes = new Uint8Array(store.labels.ids.length);
    for (const { label, mean } of this.model.reachOf(unit)) {
      const need = coverage.requirement(label);
      classes[label] = reachClass(mean / need, coverage.isMet(mean, need));
    }
    return classes;
  }

  private updateUnits(): void {
    const { state, store } = this.model;
    const removed = new Set(changedUnits(store, state).removed);
    state.on.forEach((on, unit) => {
      const number = this.model.numberOf(unit);
      const selected = this.model.isSelected("unit", unit);
      const shape =
        on || removed.has(unit) || selected
          ? this.model.isInstalled(unit)
            ? shapes.square
            : shapes.disc
          : shapes.cross;
      this.units.setLook(unit, on ? (number === undefined ? 1 : 0) : 2, shape, selected ? 2 : 1, 0);
      this.units.setNumber(unit, number !== undefined ? this.numbers.cellOf(number) : on ? plusCell : 0);
    });
    this.units.upload();
    this.units.uploadNumbers();
  }

  private links(): Link[] {
    const { state } = this.model;
    if (state.selection?.kind !== "label") return [];
    const { index } = state.selection;
    const found = this.model.contributions(index).slice(0, mostLinks);
    const strongest = found[0]?.mean ?? 0;
    return found
      .filter(({ mean }) => mean > 0)
      .map(({ unit, mean, directShare }) => ({
        from: this.place("label", index),
        to: this.place("unit", unit),
        solid: directShare,
        width: 1.2 + 3.2 * Math.sqrt(mean / strongest),
      }));
  }
}
