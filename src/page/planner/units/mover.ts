// Moves a unit by hand, along the surface that carries it: by a drag in the plan or in 3-D, and by arrow keys. The server
// says where the unit is mounted near each place, and what light it sends from there.

import { Refused } from "../document/connection";
import type { Point } from "../document/messages";
import { Newest } from "../document/newest";
import { plus } from "../geometry/vector";
import type { Planner } from "../planner";
import { text } from "../text";
import { changeNow } from "./act";
import { isSamePlace, whyFixed, whyNotAt } from "./chosen";
import { mountAt, type Mount, type MountRequest } from "./mount";
import type { MeantUnit } from "./queue";
import { alongFace } from "./surface";

/** A place in plan, perhaps with a height, m; or what finds one, perhaps, from where the unit is mounted now. */
export type Target = readonly number[] | ((mount: Mount) => readonly number[] | null);

interface Drag {
  unit: MeantUnit;
  /** `waiting` for commands that were given before it; `sent`: the drop; `there`: the store has the unit at its new place. */
  state: "waiting" | "moving" | "sent" | "there";
  ready: Promise<void>;
  /** Where it is mounted at the pointer; null before the first answer. */
  mount: Mount | null;
  /** Until the first and the last request are answered. */
  first: Promise<void>;
  last: Promise<void>;
  /** The version of the selection. */
  chosen: number;
}

export class UnitMover {
  private drag: Drag | null = null;
  private readonly dropped = new Set<Drag>();
  private readonly mounts: Newest<MountRequest, Mount | string>;
  /** The ways of arrow keys that the server does not know yet, m. */
  private readonly ways = new Map<MeantUnit, Point>();

  constructor(private readonly planner: Planner) {
    this.mounts = new Newest((request) => mountAt(planner.connection, request));
  }

  /** The dragged unit, which stays at its new place until the store has it there. */
  get shown(): { index: number; mount: Mount } | null {
    for (const { unit, mount, state } of [...this.dropped, ...(this.drag ? [this.drag] : [])])
      if (mount && state !== "there" && unit.index !== undefined) return { index: unit.index, mount };
    return null;
  }

  /** Where a unit is shown, m. */
  placeOf(index: number): number[] {
    const { shown } = this;
    return shown?.index === index ? shown.mount.position : this.planner.document.units.at(index);
  }

  get isDragging(): boolean {
    return this.drag !== null;
  }

  /** False if the unit cannot be moved, which the page says. */
  begin(index: number): boolean {
    const { queue, selection } = this.planner;
    const why = whyFixed(this.planner, index);
    if (why !== null) this.planner.say(why, true);
    if (why !== null || this.drag) return false;
    const [unit] = queue.meant([index]);
    const done = Promise.resolve();
    const chosen = selection.version;
    const drag: Drag = { unit, state: "waiting", ready: done, mount: null, first: done, last: done, chosen };
    drag.ready = queue.run([unit], () => {
      drag.state = "moving";
      queue.select([unit.index], chosen);
      return done;
    });
    // In 3-D, the pointer moves on the surface that the answer names.
    drag.first = drag.last = this.ask(drag, null);
    this.drag = drag;
    return true;
  }

  to(at: Target): void {
    if (this.drag) this.drag.last = this.ask(this.drag, at);
  }

  /** `at`: null: where it is. */
  private async ask(drag: Drag, at: Target | null): Promise<void> {
    await drag.ready;
    if (typeof at === "function") await drag.first;
    const { index } = drag.unit;
    if (index === undefined || !this.isMeant(drag)) return;
    const present = this.planner.document.units.at(index);
    const place = typeof at === "function" ? drag.mount && at(drag.mount) : (at ?? present);
    if (!place) return;
    const mount = await this.mountOf({ unit: index, at: [...place] });
    if (mount === null || typeof mount === "string" || !this.isMeant(drag)) return;
    if (drag.unit.index !== index) return this.ask(drag, place); // the answer may be that of another unit
    drag.mount = mount;
    this.planner.changes.note("preview");
  }

  private isMeant(drag: Drag): boolean {
    return drag === this.drag || this.dropped.has(drag);
  }

  private async mountOf(request: { unit: number; at: number[] }): Promise<Mount | string | null> {
    const { light } = this.planner;
    if (!light.canDrag) return this.mounts.get(request);
    const answer = await light.dragger.move(request);
    // Without the light, the place at least.
    return answer instanceof Refused ? this.mounts.get(request) : (answer?.about ?? null);
  }

  /** Writes the last place. */
  async drop(): Promise<boolean> {
    const { drag, planner } = this;
    if (!drag) return false;
    this.drag = null;
    this.dropped.add(drag);
    planner.changes.note("preview");
    try {
      return await planner.queue.run([drag.unit], () => this.finish(drag));
    } finally {
      this.dropped.delete(drag);
      planner.changes.note("preview");
    }
  }

  private async finish(drag: Drag): Promise<boolean> {
    const { planner, mounts } = this;
    await drag.last;
    const { mount, unit, chosen } = drag;
    const { index } = unit;
    const hasMoved =
      mount !== null && index !== undefined && !isSamePlace(mount.position, planner.document.units.at(index));
    const why = hasMoved ? whyNotAt(planner, mount.position) : null;
    if (why !== null) planner.say(why, true);
    const isMeant = hasMoved && why === null;
    planner.light.endDrag(isMeant);
    mounts.stop();
    drag.state = "sent";
    const done = isMeant && (await this.write(unit, chosen, mount));
    if (isMeant && !done) planner.light.endDrag(false);
    return done;
  }

  private write(unit: MeantUnit, chosen: number, { position, axis, roll_deg }: Mount, join = false): Promise<boolean> {
    const values = { position, axis, roll_deg };
    return changeNow(this.planner, [unit], chosen, text.units.steps.move, () => values, join);
  }

  /** Puts everything back; false if nothing is dragged. */
  cancel(): boolean {
    const { drag, planner } = this;
    if (!drag) return false;
    this.drag = null;
    // Before that, they are those of the last drop.
    if (drag.state === "moving") {
      planner.light.endDrag(false);
      this.mounts.stop();
    }
    planner.changes.note("preview");
    return true;
  }

  /** Units have changed: the dragged one may be gone. */
  follow(): void {
    for (const drag of this.dropped) if (drag.state === "sent") drag.state = "there";
    if (this.drag?.state === "moving" && this.drag.unit.index === undefined) this.cancel();
  }

  /** Moves a unit by a step in m to the right and upwards, and by all further steps that come meanwhile. */
  async nudge(index: number, step: Point): Promise<void> {
    const { queue, selection } = this.planner;
    const [unit] = queue.meant([index]);
    const way = this.ways.get(unit);
    this.ways.set(unit, way ? plus(way, step) : step);
    if (way) return;
    const chosen = selection.version;
    await queue.run([unit], async () => {
      try {
        const why = await this.steps(unit, chosen);
        if (why !== null) this.planner.say(why, true);
      } finally {
        this.ways.delete(unit);
      }
    });
  }

  /** The result is why it stays; null if it has moved. */
  private async steps(unit: MeantUnit, chosen: number): Promise<string | null> {
    const { planner } = this;
    const { connection, document } = planner;
    const wayOf = () => this.ways.get(unit) ?? [0, 0];
    while (Math.hypot(...wayOf()) > 0) {
      const { index } = unit;
      if (index === undefined) return text.units.gone;
      const fixed = whyFixed(planner, index);
      if (fixed !== null) return fixed;
      const now = document.units.at(index);
      const axis = document.units.direction.subarray(3 * index, 3 * index + 3);
      // In 3-D, a unit on a face moves up and down, too.
      const here = planner.isPlan ? null : await mountAt(connection, { unit: index, at: now });
      const isOnFace = here !== null && typeof here !== "string" && here.on === "face";
      const way = wayOf();
      this.ways.set(unit, [0, 0]);
      const step = isOnFace ? alongFace(axis, way) : [...way, 0];
      const mount = await mountAt(connection, { unit: index, at: now.map((value, k) => value + step[k]) });
      if (unit.index !== index) {
        this.ways.set(unit, plus(wayOf(), way)); // the answer may be that of another unit
        continue;
      }
      if (typeof mount === "string") return mount;
      if (isSamePlace(mount.position, now)) return text.units.along_only;
      const why = whyNotAt(planner, mount.position);
      if (why !== null) return why;
      if (!(await this.write(unit, chosen, mount, true))) return null;
    }
    return null;
  }
}
