// The marks of labels and units, drawn by three.js above the outlines, in the plan and in 3-D.

import { Marks, shapes } from "../../scene/marks";
import { colourOf } from "../../scene/palette";
import type { Stage } from "../../scene/stage";
import { unitStates, type Devices } from "../document/devices";
import type { Point } from "../document/messages";
import { moved, movedVector, type Motion } from "../geometry/rigid";
import type { Planner } from "../planner";
import { lift } from "../view/fan";
import { levelOf } from "../view/layers";

/** The labels of one shelf level, or the units. */
interface Layer {
  devices: Devices;
  level: number;
  indices: number[];
  marks: Marks;
}

const colours = ["--label", "--unit", "--cand", "--accent"];
const [labelColour, installedColour, candidateColour, pinnedColour] = [0, 1, 2, 3];

export class DeviceMarks {
  private layers: Layer[] = [];
  private displaced = new Map<Layer, number[]>();

  constructor(
    private readonly planner: Planner,
    private readonly stage: Stage,
  ) {}

  /** After a change of labels or units. */
  rebuild(): void {
    this.stage.remove(...this.layers.map(({ marks }) => marks));
    const { labels, units } = this.planner.document;
    const levels = [...new Set(labels.state)].sort((a, b) => a - b);
    this.layers = [...levels.map((level) => this.layerOf(labels, level)), this.layerOf(units, 0)];
    this.displaced.clear();
    this.stage.add(...this.layers.map(({ marks }) => marks));
    this.recolour();
    this.displace();
    this.update();
  }

  private layerOf(devices: Devices, level: number): Layer {
    const isUnit = devices.kind === "unit";
    const all = Array.from({ length: devices.count }, (_, index) => index);
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
    const least = devices.count > 20000 ? 1.4 : devices.count > 4000 ? 1.8 : 2.4;
    const marks = new Marks(
      indices.length,
      pick(devices.position),
      isUnit ? new Float32Array(3 * indices.length) : pick(devices.direction),
      idents,
      isUnit ? { worldRadius: 0.16, pixels: [4, 11], lift: 0 } : { worldRadius: 0.05, pixels: [least, 9], lift },
    );
    if (isUnit) {
      marks.mesh.renderOrder = 3;
      indices.forEach((_, mark) => {
        marks.setNumber(mark, 0);
      });
    }
    return { devices, level, indices, marks };
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
    const [edge, strong, paper] = ["--edge", "--accent", "--floor"].map((name) => colourOf(canvas, name));
    for (const { marks } of this.layers)
      marks.setPalette(
        colours.map((name) => colourOf(canvas, name)),
        { edge, strong, paper },
      );
    this.stage.recolour();
  }

  /** After a change of layers, selection or scale. */
  update(): void {
    const { planner } = this;
    const chosen = { label: this.chosen("label"), unit: this.chosen("unit") };
    const { spread } = planner.fan;
    for (const { devices, level, indices, marks } of this.layers) {
      const isUnit = devices.kind === "unit";
      marks.mesh.visible = planner.layers.isShown(devices.kind) && (isUnit || planner.layers.isShown(levelOf(level)));
      marks.uniform("spread").value = isUnit ? 0 : spread;
      indices.forEach((index, mark) => {
        const isChosen = chosen[devices.kind].has(index);
        if (isUnit) this.lookOfUnit(marks, mark, unitStates[devices.state[index]] ?? "candidate", isChosen);
        else marks.setLook(mark, labelColour, shapes.disc, isChosen ? 2 : 1, planner.fan.rank(index));
      });
      marks.upload();
    }
    this.stage.draw();
  }

  private lookOfUnit(marks: Marks, mark: number, state: (typeof unitStates)[number], isChosen: boolean): void {
    const emphasis = isChosen ? 2 : state === "excluded" ? 0 : 1;
    if (state === "installed") marks.setLook(mark, installedColour, shapes.square, emphasis, 0);
    else if (state === "pinned") marks.setLook(mark, pinnedColour, shapes.disc, emphasis, 0);
    else marks.setLook(mark, candidateColour, isChosen ? shapes.disc : shapes.cross, emphasis, 0);
  }

  /** The selected labels or units, also those of selected elements. */
  private chosen(kind: Devices["kind"]): Set<number> {
    const { document, selection } = this.planner;
    const devices = kind === "label" ? document.labels : document.units;
    const own = selection.items.flatMap((item) => (item.kind === "device" && item.device === kind ? [item.index] : []));
    const listed = selection.paths.flatMap((path) => devices.withPath(path) ?? []);
    return new Set([...own, ...listed]);
  }

  /** Marks follow the elements that a gesture moves. */
  displace(): void {
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
