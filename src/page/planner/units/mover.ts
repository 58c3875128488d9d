// Moves a unit by hand, along the surface that carries it: by a drag in the plan or in 3-D, and by arrow keys. The server
// says where the unit is mounted near each place, and what light it sends from there.

import { Refused } from "../document/connection";
import type { Point } from "../document/messages";
import { Newest } from "../document/newest";
import { plus } from "../geometry/vector";
import type { Planner } from "../planner";
import { text } from "../text";
import { changeUnits } from "./act";
import { chosenUnits, isSamePlace, whyFixed, whyNotAt } from "./chosen";
import { mountAt, type Mount, type MountRequest } from "./mount";
import { alongFace } from "./surface";

interface Drag {
  index: number;
  /** Where it is mounted at the pointer; null before the first answer. */
  mount: Mount | null;
  /** Until the last request is answered. */
  last: Promise<void>;
  isDropped: boolean;
}

export class UnitMover {
  private drag: Drag | null = null;
  private readonly mounts: Newest<MountRequest, Mount | string>;
  /** The way of arrow keys that the server does not know yet, m. */
  private way: Point = [0, 0];
  private isNudging = false;

  constructor(private readonly planner: Planner) {
    this.mounts = new Newest((request) => mountAt(planner.connection, request));
  }

  /** The dragged unit, which stays at its new place until the store has it there. */
  get shown(): { index: number; mount: Mount } | null {
    return this.drag?.mount ? { index: this.drag.index, mount: this.drag.mount } : null;
  }

  /** When the last request of the drag is answered. */
  get answered(): Promise<void> {
    return this.drag?.last ?? Promise.resolve();
  }

  get isDragging(): boolean {
    return this.drag !== null && !this.drag.isDropped;
  }

  /** False if the unit cannot be moved, which the page says. */
  begin(index: number): boolean {
    if (this.drag) return false;
    const why = whyFixed(this.planner, index);
    if (why !== null) {
      this.planner.say(why, true);
      return false;
    }
    this.drag = { index, mount: null, last: Promise.resolve(), isDropped: false };
    // In 3-D, the pointer moves on the surface that the answer names.
    this.to(this.planner.document.units.at(index));
    return true;
  }

  /** `at`: in plan, perhaps with a height, m. */
  to(at: readonly number[]): void {
    if (this.drag && !this.drag.isDropped) this.drag.last = this.ask(this.drag, at);
  }

  private async ask(drag: Drag, at: readonly number[]): Promise<void> {
    const mount = await this.mountOf({ unit: drag.index, at });
    if (mount === null || typeof mount === "string" || this.drag !== drag) return;
    drag.mount = mount;
    this.planner.changes.note("preview");
  }

  private async mountOf(request: { unit: number; at: readonly number[] }): Promise<Mount | string | null> {
    const { light } = this.planner;
    if (!light.canDrag) return this.mounts.get(request);
    const answer = await light.dragger.move({ ...request, at: [...request.at] });
    // Without the light, the place at least.
    return answer instanceof Refused ? this.mounts.get(request) : (answer?.about ?? null);
  }

  /** Writes the last place. */
  async drop(): Promise<boolean> {
    const { drag, planner } = this;
    if (!drag || drag.isDropped) return false;
    drag.isDropped = true;
    await drag.last;
    const { index, mount } = drag;
    const hasMoved = mount !== null && !isSamePlace(mount.position, planner.document.units.at(index));
    const why = hasMoved ? whyNotAt(planner, mount.position) : null;
    if (why !== null) planner.say(why, true);
    const isMeant = hasMoved && why === null;
    planner.light.endDrag(isMeant);
    const done = isMeant && (await this.write(index, mount));
    if (isMeant && !done) planner.light.endDrag(false);
    this.end();
    return done;
  }

  private write(index: number, { position, axis, roll_deg }: Mount, join = false): Promise<boolean> {
    return changeUnits(this.planner, [index], text.units.steps.move, () => ({ position, axis, roll_deg }), join);
  }

  private end(): void {
    this.mounts.stop();
    this.drag = null;
    this.planner.changes.note("preview");
  }

  /** Puts everything back; false if nothing is dragged. */
  cancel(): boolean {
    if (!this.isDragging) return false;
    this.planner.light.endDrag(false);
    this.end();
    return true;
  }

  /** Units [from, from + removed) are replaced by others: the dragged one has another number, or is gone. */
  follow(from: number, removed: number, added: number): void {
    const { drag } = this;
    if (!drag || drag.index < from) return;
    if (drag.isDropped)
      drag.mount = null; // the store has it at its new place
    else if (drag.index < from + removed) this.cancel();
    else drag.index += added - removed;
  }

  /** Moves a unit by a step in m to the right and upwards, and by all further steps that come meanwhile. */
  async nudge(index: number, step: Point): Promise<void> {
    this.way = plus(this.way, step);
    if (this.isNudging) return;
    this.isNudging = true;
    const why = whyFixed(this.planner, index) ?? (await this.steps(index));
    this.isNudging = false;
    this.way = [0, 0];
    if (why !== null) this.planner.say(why, true);
  }

  /** The result is why it stays; null if it has moved. */
  private async steps(index: number): Promise<string | null> {
    const { planner } = this;
    const { connection, document } = planner;
    let unit = index;
    while (Math.hypot(...this.way) > 0) {
      const now = document.units.at(unit);
      const axis = document.units.direction.subarray(3 * unit, 3 * unit + 3);
      // In 3-D, a unit on a face moves up and down, too.
      const here = planner.isPlan ? null : await mountAt(connection, { unit, at: now });
      const isOnFace = here !== null && typeof here !== "string" && here.on === "face";
      const way = isOnFace ? alongFace(axis, this.way) : [...this.way, 0];
      this.way = [0, 0];
      const mount = await mountAt(connection, { unit, at: now.map((value, k) => value + way[k]) });
      if (typeof mount === "string") return mount;
      if (isSamePlace(mount.position, now)) return text.units.along_only;
      const why = whyNotAt(planner, mount.position);
      if (why !== null) return why;
      if (!(await this.write(unit, mount, true))) return null;
      const [next] = chosenUnits(planner);
      if (next === undefined) return null;
      unit = next;
    }
    return null;
  }
}
