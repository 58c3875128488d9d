// The marks of labels and units, drawn by three.js above the outlines, in the plan and in 3-D.

import { Marks, patterns, shapes } from "../../scene/marks";
import { colourOf } from "../../scene/palette";
import type { Stage } from "../../scene/stage";
import { isOn, unitStates, type Devices, type UnitState } from "../document/devices";
import type { Point } from "../document/messages";
import { moved, movedVector, type Motion } from "../geometry/rigid";
import { addedPatterns, colourNames, lookColour, lookShape, plainColour, type PaletteName } from "../light/looks";
import { reached } from "../light/verdicts";
import { weakestOfGroups } from "../light/weakest";
import type { Planner } from "../planner";
import { lift } from "../view/fan";
import { levelOf } from "../view/layers";

/** The labels of one shelf level, or the units. */
interface Layer {
  devices: Devices;
  level: number;
  indices: Uint32Array;
  marks: Marks;
  /** The places from which the marks are made. */
  of: Float32Array;
}

const unitColours = ["--unit", "--cand", "--accent"];
const [unitColour, candidateColour, pinnedColour] = [0, 1, 2];
/** Units on the plan differ from candidates, and from one another, by their shapes. */
const unitLooks: Record<UnitState, { colour: number; shape: number }> = {
  candidate: { colour: candidateColour, shape: shapes.cross },
  excluded: { colour: candidateColour, shape: shapes.disc | patterns.hollow },
  installed: { colour: unitColour, shape: shapes.square },
  pinned: { colour: pinnedColour, shape: shapes.diamond },
  selected: { colour: unitColour, shape: shapes.disc },
};

/** Pixels. */
const leastRadius = (count: number): number => (count > 20000 ? 1.4 : count > 4000 ? 1.8 : 2.4);
/** Colours are hard to tell apart in small marks. */
const withLight = 1.7;
/** m; the triangles and squares of labels with light are larger, and must not cover the next level. */
const [usualRadius, litRadius] = [0.05, 0.042];

/** Entries of the browser's list of measurements that are kept. */
const mostMeasured = 256;

export class DeviceMarks {
  private layers: Layer[] = [];
  private displaced = new Map<Layer, number[]>();
  /** The mark of the dragged unit. */
  private carried: number | null = null;
  /** What the looks show. */
  private shown = { light: -1, palette: null as PaletteName | null, isFanned: false };
  private isMeasured = true;
  private measured = 0;

  constructor(
    private readonly planner: Planner,
    private readonly stage: Stage,
  ) {}

  /** After a change of labels or units. */
  rebuild(): void {
    const { labels, units } = this.planner.document;
    // Units change often, and labels are many.
    const kept = this.layers.filter(({ of }) => of === labels.position);
    const gone = this.layers.filter((layer) => !kept.includes(layer));
    this.stage.remove(...gone.map(({ marks }) => marks));
    const levels = kept.length > 0 ? [] : [...new Set(labels.state)].sort((a, b) => a - b);
    const made = [...levels.map((level) => this.layerOf(labels, level)), this.layerOf(units, 0)];
    this.layers = [...kept, ...made];
    for (const layer of gone) this.displaced.delete(layer);
    this.carried = null;
    this.stage.add(...made.map(({ marks }) => marks));
    this.recolour();
    this.displace();
    this.update();
  }

  private layerOf(devices: Devices, level: number): Layer {
    const isUnit = devices.kind === "unit";
    const all = Uint32Array.from({ length: devices.count }, (_, index) => index);
    const indices = isUnit ? all : all.filter((index) => devices.state[index] === level);
    const pick = (values: Float32Array) => {
      const picked = new Float32Array(3 * indices.length);
      indices.forEach((index, mark) => {
        picked.set(values.subarray(3 * index, 3 * index + 3), 3 * mark);
      });
      return picked;
    };
    const first = 1 + (isUnit ? this.planner.document.labels.count : 0);
    const idents = Uint32Array.from(indices, (index) => first + index);
    const least = leastRadius(devices.count);
    const marks = new Marks(
      indices.length,
      pick(devices.position),
      isUnit ? new Float32Array(3 * indices.length) : pick(devices.direction),
      idents,
      isUnit ? { worldRadius: 0.16, pixels: [5, 11], lift: 0 } : { worldRadius: usualRadius, pixels: [least, 9], lift },
    );
    if (isUnit) {
      marks.mesh.renderOrder = 3;
      indices.forEach((_, mark) => {
        marks.setNumber(mark, 0);
      });
    }
    return { devices, level, indices, marks, of: devices.position };
  }

  /** The label or unit of a mark that was picked. */
  named(ident: number): { devices: Devices; index: number } | null {
    const { labels, units } = this.planner.document;
    if (ident === 0) return null;
    return ident <= labels.count
      ? { devices: labels, index: ident - 1 }
      : { devices: units, index: ident - 1 - labels.count };
  }

  recolour(): void {
    const { canvas } = this.stage;
    const { palette } = this.planner.light;
    const [edge, strong, paper] = ["--edge", "--strong", "--floor"].map((name) => colourOf(canvas, name));
    const labelColours = colourNames(palette).map((name) => colourOf(canvas, name));
    const ofUnits = unitColours.map((name) => colourOf(canvas, name));
    for (const { devices, marks } of this.layers)
      if (devices.kind === "unit") marks.setPalette(ofUnits, { edge, strong: colourOf(canvas, "--accent"), paper });
      else marks.setPalette(labelColours, { edge, strong, paper });
    this.shown.palette = palette;
    this.stage.recolour();
  }

  /** After a change that may concern light. */
  showLight(): void {
    const { light } = this.planner;
    light.refresh();
    if (this.shown.palette !== light.palette) this.recolour();
    if (this.shown.light !== light.version) this.update();
  }

  /** After a change of scale. */
  follow(): void {
    if (this.planner.fan.spread > 0 !== this.shown.isFanned) this.update();
  }

  /** After a change of layers or selection. */
  update(): void {
    const { planner } = this;
    const { fan, layers, light } = planner;
    light.refresh();
    if (this.shown.light !== light.version) this.isMeasured = false;
    this.shown.light = light.version;
    this.shown.isFanned = fan.spread > 0;
    this.orderLevels();
    const chosen = { label: this.chosen("label"), unit: this.chosen("unit") };
    for (const layer of this.layers) {
      const { devices, level, marks } = layer;
      const isUnit = devices.kind === "unit";
      marks.mesh.visible = layers.isShown(devices.kind) && (isUnit || layers.isShown(levelOf(level)));
      marks.uniform("spread").value = isUnit ? 0 : fan.spread;
      if (isUnit) this.lookOfUnits(layer, chosen.unit);
      else this.lookOfLabels(layer, chosen.label);
      marks.upload();
    }
    this.stage.draw();
  }

  /** From afar, the weakest of the labels at a point covers the others. */
  private orderLevels(): void {
    const { fan, layers, light, document, isPlan } = this.planner;
    fan.front = null;
    if (!isPlan || this.shown.isFanned || light.field === null) return;
    const isShown = new Uint8Array(256);
    for (const { level } of this.layers) isShown[level] = layers.isShown(levelOf(level)) ? 1 : 0;
    const { state } = document.labels;
    fan.front = weakestOfGroups(fan.groups, light.verdicts.strength, (label) => isShown[state[label]] === 1);
  }

  private lookOfLabels({ indices, marks }: Layer, chosen: ReadonlySet<number>): void {
    const { fan, light } = this.planner;
    const { verdict, band } = light.verdicts;
    const added = addedPatterns(light.isPreview, light.isStale);
    const hasLight = light.field !== null;
    marks.uniform("pixelRadius").value.x = leastRadius(verdict.length) * (hasLight ? withLight : 1);
    marks.uniform("worldRadius").value = hasLight ? litRadius : usualRadius;
    const { front } = fan;
    for (let mark = 0; mark < indices.length; ++mark) {
      const index = indices[mark];
      const isChosen = chosen.has(index);
      // From afar, marks of neighbours overlap: what is not reached lies above.
      const emphasis = isChosen ? 2 : front !== null && verdict[index] < reached ? 3 : 1;
      if (front !== null && front[index] === 0 && !isChosen) marks.setLook(mark, 0, shapes.none, 1, 0);
      else if (hasLight) {
        const kind = verdict[index];
        marks.setLook(mark, lookColour(kind, band[index]), lookShape(kind) | added, emphasis, fan.rank(index));
      } else marks.setLook(mark, plainColour, shapes.disc, emphasis, fan.rank(index));
    }
  }

  private lookOfUnits({ devices, indices, marks }: Layer, chosen: ReadonlySet<number>): void {
    const { proposed } = this.planner.plans;
    indices.forEach((index, mark) => {
      const state = unitStates[devices.state[index]] ?? "candidate";
      const isChosen = chosen.has(index);
      const { colour, shape } = unitLooks[state];
      if (proposed.has(index) && !isOn(state)) {
        marks.setLook(mark, unitColour, shapes.disc | patterns.hollow, isChosen ? 2 : 3, 0);
        return;
      }
      // A cross is too thin for the border of what is chosen.
      const shown = isChosen && shape === shapes.cross ? shapes.disc : shape;
      marks.setLook(mark, colour, shown, isChosen ? 2 : isOn(state) ? 3 : 1, 0);
    });
  }

  /** For measurements, when marks have been drawn. */
  markDrawn(): void {
    if (this.isMeasured) return;
    this.isMeasured = true;
    const { field, isStale, stage, dragged } = this.planner.light;
    if (++this.measured % mostMeasured === 0) performance.clearMarks("recoloured");
    const detail = { generation: field?.generation ?? null, isStale, stage, id: dragged?.about.id ?? null };
    performance.mark("recoloured", { detail });
  }

  /** The selected labels or units, also those of selected elements. */
  private chosen(kind: Devices["kind"]): Set<number> {
    const { document, selection } = this.planner;
    const devices = kind === "label" ? document.labels : document.units;
    const own = selection.items.flatMap((item) => (item.kind === "device" && item.device === kind ? [item.index] : []));
    const listed = selection.paths.flatMap((path) => devices.withPath(path) ?? []);
    return new Set([...own, ...listed]);
  }

  /** The mark of a dragged unit is where the server would mount it. */
  private carry(): void {
    const { shown } = this.planner.mover;
    const layer = this.layers.find(({ devices }) => devices.kind === "unit");
    if (!layer || (this.carried === null && !shown)) return;
    if (this.carried !== null && this.carried < layer.marks.count) this.put(layer, this.carried, null);
    this.carried = shown?.index ?? null;
    if (shown && shown.index < layer.marks.count) layer.marks.place(shown.index, shown.mount.position, [0, 0, 0]);
    layer.marks.uploadPlaces();
    this.stage.draw();
  }

  /** Marks follow what a gesture moves. */
  displace(): void {
    this.carry();
    const motions = this.planner.document.preview.devices;
    if (motions.size === 0 && this.displaced.size === 0) return;
    const byKind = new Map(
      [this.planner.document.labels, this.planner.document.units].map((devices) => [
        devices,
        this.motionsOf(devices, motions),
      ]),
    );
    const next = new Map<Layer, number[]>();
    for (const layer of this.layers) {
      const { devices, indices, marks } = layer;
      const own = byKind.get(devices) as Map<number, Motion>;
      const touched: number[] = [];
      const before = this.displaced.get(layer) ?? [];
      if (own.size === 0 && before.length === 0) continue;
      for (const mark of before) this.put(layer, mark, null);
      indices.forEach((index, mark) => {
        const motion = own.get(index);
        if (!motion) return;
        this.put(layer, mark, motion);
        touched.push(mark);
      });
      if (touched.length > 0) next.set(layer, touched);
      marks.uploadPlaces();
    }
    this.displaced = next;
    this.stage.draw();
  }

  private motionsOf(devices: Devices, motions: ReadonlyMap<string, Motion>): Map<number, Motion> {
    const found = new Map<number, Motion>();
    if (motions.size === 0) return found;
    for (const [path, indices] of devices.ofElements(new Set(motions.keys())))
      for (const index of indices) found.set(index, motions.get(path) as Motion);
    return found;
  }

  private put({ devices, indices, marks }: Layer, mark: number, motion: Motion | null): void {
    const index = indices[mark];
    const [x, y, z] = devices.at(index);
    const facing =
      devices.kind === "unit" ? [0, 0, 0] : Array.from(devices.direction.subarray(3 * index, 3 * index + 3));
    if (!motion) {
      marks.place(mark, [x, y, z], facing);
      return;
    }
    const [u, v] = movedVector([facing[0], facing[1]] as Point, motion);
    marks.place(mark, [...moved([x, y], motion), z], [u, v, facing[2]]);
  }
}
