// The tool that places units: the server says where one would be mounted at the pointer.

import { Newest } from "../document/newest";
import type { Point } from "../document/messages";
import { namesIn } from "../form/initial";
import type { Scope } from "../gesture/scope";
import type { Planner } from "../planner";
import { distance } from "../geometry/vector";
import { text } from "../text";
import { askForUnits } from "./act";
import { axisOf, lowered } from "./aim";
import { listIsFile, whyNotAt } from "./chosen";
import { mountAt, type Mount, type MountRequest } from "./mount";

const samePlace = 1e-6; // m
/** Not even a rail at the pointer attracts a unit. */
const unattracted = 0; // m

/** A unit that is not there yet. */
export interface Ghost {
  request: MountRequest;
  mount: Mount;
}

export class UnitTool {
  ghost: Ghost | null = null;
  private asked: MountRequest | null = null;
  private readonly mounts: Newest<MountRequest, Mount | string>;

  constructor(private readonly planner: Planner) {
    this.mounts = new Newest((request) => mountAt(planner.connection, request));
  }

  /** The chosen type, or the first of the store. */
  get type(): string | undefined {
    const { document, settings } = this.planner;
    const names = namesIn(document.json, "transceiver_types", document.shared);
    const chosen = settings.now.unitType;
    return chosen !== null && names.includes(chosen) ? chosen : names[0];
  }

  /** `isFree`: neither rails nor faces attract it. */
  private requestFor(at: Point, isFree: boolean): MountRequest {
    const { settings, snapping } = this.planner;
    const reach = isFree || !settings.now.attracts ? unattracted : snapping.reach;
    return { at, reach, type: this.type };
  }

  /** Shows where a unit would be mounted; null: nowhere. */
  private async aim(at: Point | null, isFree: boolean): Promise<void> {
    if (!at || this.type === undefined) {
      this.stop();
      return;
    }
    const request = this.requestFor(at, isFree);
    if (this.asked && isSame(this.asked, request)) return;
    this.asked = request;
    const mount = await this.mounts.get(request);
    if (mount === null || this.asked === null) return;
    this.ghost = typeof mount === "string" ? null : { request, mount };
    this.planner.changes.note("preview");
  }

  /** With the tool's stroke, which has nothing but its end. */
  follow(scope: Scope): void {
    const isOwn = scope.kind === "drawing" && scope.stroke.tool === "unit";
    if (isOwn) void this.aim(scope.end?.at ?? null, scope.isFree);
    else this.stop();
  }

  private stop(): void {
    this.mounts.stop();
    this.asked = null;
    this.ghost = null;
  }

  /** The direction that the panel gives a unit there. */
  axisAt({ on, axis }: Mount): number[] {
    const { faceTilt, unitTilt, heading } = this.planner.settings.now;
    if (on === "face") return lowered(axis, faceTilt);
    return unitTilt === 0 ? axis : axisOf(unitTilt, heading);
  }

  /** One after the other, so that the second click of two finds the unit of the first. */
  place(at: Point, isFree: boolean, isInstalled: boolean): Promise<boolean> {
    const { version } = this.planner.selection;
    return this.planner.queue.run([], () => this.placeNow(at, isFree, isInstalled, version));
  }

  private async placeNow(at: Point, isFree: boolean, isInstalled: boolean, chosen: number): Promise<boolean> {
    const { planner } = this;
    const { type } = this;
    const why = listIsFile(planner) ? text.units.list_is_file : type === undefined ? text.draw.no_type : null;
    if (why !== null) {
      planner.say(why, true);
      return false;
    }
    const request = this.requestFor(at, isFree);
    const isKnown = this.ghost !== null && isSame(this.ghost.request, request);
    const mount = isKnown ? (this.ghost as Ghost).mount : await mountAt(planner.connection, request);
    const refusal = typeof mount === "string" ? mount : whyNotAt(planner, mount.position);
    if (typeof mount === "string" || refusal !== null) {
      planner.say(String(refusal), true);
      return false;
    }
    const ids = await askForUnits(planner, text.units.steps.place, {
      action: "place",
      as: isInstalled ? "installed" : "pinned",
      type,
      position: mount.position,
      axis: this.axisAt(mount),
      roll_deg: mount.roll_deg,
    });
    const { queue } = planner;
    if (ids.length > 0)
      queue.select(
        ids.map((id) => queue.entryWith(id)),
        chosen,
      );
    return ids.length > 0;
  }
}

const isSame = (a: MountRequest, b: MountRequest): boolean =>
  a.reach === b.reach && a.type === b.type && distance(a.at as Point, b.at as Point) < samePlace;
