// Labels and candidate units as the server resolved them, as arrays.

import type { PageData } from "../../data/page_data";
import type { DevicesAbout } from "./messages";

export type DeviceKind = "label" | "unit";

/** Where a device comes from; the numbers are those of the protocol. */
const sources: Record<DeviceKind, (string | null)[]> = {
  label: ["/labels", "/fixtures", "/measuring_planes", null],
  unit: [
    "/transceivers/list",
    "/transceivers/grids",
    "/transceivers/areas",
    "/transceivers/rails",
    "/transceivers/on",
    null,
  ],
};

export const unitStates = ["candidate", "installed", "pinned", "excluded", "selected"] as const;
export type UnitState = (typeof unitStates)[number];

/** Whether a unit is on the plan, so that it sends light: it is installed, pinned or selected. */
export const isOn = (state: UnitState): boolean => state !== "candidate" && state !== "excluded";

type Numbers = Float32Array | Uint8Array | Uint32Array;

/** Values [first, first + removed) replaced by others. */
function spliced<Values extends Numbers>(values: Values, first: number, removed: number, added: Values): Values {
  const result = new (values.constructor as new (length: number) => Values)(values.length - removed + added.length);
  result.set(values.subarray(0, first));
  result.set(added, first);
  result.set(values.subarray(first + removed), first + added.length);
  return result;
}

export class Devices {
  /** Three numbers each, m. */
  position = new Float32Array();
  /** The direction that a label faces, or the axis of a unit. */
  direction = new Float32Array();
  /** Of a label: its shelf level, from 0 for the lowest. Of a unit: its state. */
  state = new Uint8Array();
  /** Changes with the devices. */
  version = 0;
  private sourceKind = new Uint8Array();
  private source = new Uint32Array();
  private listed = new Map<string, number>();
  /** The array from which `listed` was made. */
  private listedOf: Uint32Array | null = null;

  /** Devices [from, from + removed) are replaced by others. */
  onReplaced: (from: number, removed: number, added: number) => void = () => {};

  constructor(readonly kind: DeviceKind) {}

  get count(): number {
    return this.state.length;
  }

  clear(): void {
    ++this.version;
    this.position = new Float32Array();
    this.direction = new Float32Array();
    this.state = new Uint8Array();
    this.sourceKind = new Uint8Array();
    this.source = new Uint32Array();
  }

  receive(frame: PageData<DevicesAbout>): void {
    const { from, remove } = frame.about;
    ++this.version;
    const [direction, state] = this.kind === "label" ? ["normal", "level"] : ["axis", "state"];
    this.position = spliced(this.position, 3 * from, 3 * remove, frame.get("position", Float32Array));
    this.direction = spliced(this.direction, 3 * from, 3 * remove, frame.get(direction, Float32Array));
    this.state = spliced(this.state, from, remove, frame.get(state, Uint8Array));
    this.sourceKind = spliced(this.sourceKind, from, remove, frame.get("source_kind", Uint8Array));
    this.source = spliced(this.source, from, remove, frame.get("source", Uint32Array));
    this.onReplaced(from, remove, frame.get(state, Uint8Array).length);
  }

  at(index: number): [number, number, number] {
    return [this.position[3 * index], this.position[3 * index + 1], this.position[3 * index + 2]];
  }

  /** The element of the store that it belongs to, or is; null if it comes from another file. */
  pathOf(index: number): string | null {
    const list = sources[this.kind][this.sourceKind[index]] ?? null;
    return list && `${list}/${this.source[index]}`;
  }

  /** Whether it is an element of the store itself, or a unit on the plan: not one of many candidates. */
  stands(index: number): boolean {
    return this.isListed(index) || (this.kind === "unit" && isOn(unitStates[this.state[index]]));
  }

  /** Whether it is an element of the store itself. */
  isListed(index: number): boolean {
    return this.sourceKind[index] === 0;
  }

  /** The device that is the element with this path; undefined if there is none. */
  withPath(path: string): number | undefined {
    if (this.listedOf !== this.source) {
      this.listedOf = this.source;
      this.listed = new Map();
      for (let index = 0; index < this.count; ++index)
        if (this.isListed(index)) this.listed.set(this.pathOf(index) as string, index);
    }
    return this.listed.get(path);
  }

  /** The devices of elements, by the path of the element. */
  ofElements(paths: ReadonlySet<string>): Map<string, number[]> {
    const found = new Map<string, number[]>();
    for (let index = 0; index < this.count; ++index) {
      const path = this.pathOf(index);
      if (path === null || !paths.has(path)) continue;
      const list = found.get(path);
      if (list) list.push(index);
      else found.set(path, [index]);
    }
    return found;
  }
}
