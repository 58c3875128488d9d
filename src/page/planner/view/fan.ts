// Labels of several shelf levels lie on one point of the plan. From near they are drawn side by side, away from the shelf,
// the lowest level first.

import type { Devices } from "../document/devices";
import type { Point } from "../document/messages";

/** Pixels per m from which labels are drawn side by side. */
const leastScale = 45;
const distance = 0.12; // m between neighbours
const most = 0.6; // m of all together
/** m in front of the shelf, also of a single label. */
export const lift = 0.03;

interface Points {
  /** The number of labels at the same point that are lower, for each label. */
  ranks: Uint8Array;
  /** The number of the point of each label. */
  groups: Uint32Array;
}

export function pointsOf({ count, position }: Pick<Devices, "count" | "position">): Points {
  const groups = new Map<string, number[]>();
  for (let index = 0; index < count; ++index) {
    const key = `${Math.round(position[3 * index] * 100)},${Math.round(position[3 * index + 1] * 100)}`;
    const group = groups.get(key);
    if (group) group.push(index);
    else groups.set(key, [index]);
  }
  const points = { ranks: new Uint8Array(count), groups: new Uint32Array(count) };
  [...groups.values()].forEach((group, number) => {
    group
      .sort((a, b) => position[3 * a + 2] - position[3 * b + 2])
      .forEach((index, rank) => {
        points.ranks[index] = Math.min(rank, 255);
        points.groups[index] = number;
      });
  });
  return points;
}

export class Fan {
  /** From afar: 1 for labels that lie above the others at their point; null if none does. */
  front: Uint8Array | null = null;
  private points: Points = { ranks: new Uint8Array(), groups: new Uint32Array() };
  private highest = 0;
  private of: Float32Array | null = null;

  constructor(
    private readonly labels: Devices,
    private readonly scale: () => number,
  ) {}

  /** m between neighbours; 0 from afar. */
  get spread(): number {
    this.refresh();
    return this.scale() >= leastScale ? Math.min(distance, most / Math.max(this.highest, 1)) : 0;
  }

  /** m between a label and its mark, at most. */
  get reach(): number {
    return lift + this.spread * this.highest;
  }

  rank(index: number): number {
    this.refresh();
    return this.points.ranks[index] ?? 0;
  }

  /** The number of the point of each label. */
  get groups(): Uint32Array {
    this.refresh();
    return this.points.groups;
  }

  /** Whether another label lies above it. */
  isCovered(index: number): boolean {
    return this.front?.[index] === 0;
  }

  /** Where the plan shows a label or unit. */
  place(devices: Devices, index: number): Point {
    const { position, direction } = devices;
    const [x, y] = [position[3 * index], position[3 * index + 1]];
    if (devices !== this.labels) return [x, y];
    const away = lift + this.spread * this.rank(index);
    return [x + away * direction[3 * index], y + away * direction[3 * index + 1]];
  }

  private refresh(): void {
    if (this.of === this.labels.position) return;
    this.of = this.labels.position;
    this.points = pointsOf(this.labels);
    this.front = null;
    this.highest = this.points.ranks.reduce((most, rank) => Math.max(most, rank), 0);
  }
}
