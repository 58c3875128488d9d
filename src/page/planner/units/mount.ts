// Where the server would mount a unit near a place.

import type { Connection } from "../document/connection";
import { Lost, Refused } from "../document/connection";
import type { MountKind } from "../document/messages";
import { lengthText, type LengthUnit } from "../geometry/units";
import { say, text } from "../text";

export interface Mount {
  /** m */
  position: number[];
  axis: number[];
  roll_deg: number;
  on: MountKind;
  /** Of the rail, the fixture or the wall. */
  name?: string;
}

export interface MountRequest {
  /** In plan, perhaps with a height, m. */
  at: readonly number[];
  /** The unit that is moved there; without it, a new one is mounted. */
  unit?: number;
  /** Within which rails and faces attract a new unit, m. */
  reach?: number;
  type?: string;
}

/** Where it is mounted, or why nowhere. */
export async function mountAt(connection: Pick<Connection, "request">, request: MountRequest): Promise<Mount | string> {
  try {
    return (await connection.request<{ mount: Mount }>("mount", request)).mount;
  } catch (error) {
    if (error instanceof Refused) return error.message;
    if (error instanceof Lost) return text.notices.no_connection;
    throw error;
  }
}

/** "below the ceiling, 2.95 m". */
export const placeWords = (mount: Mount, unit: LengthUnit): string =>
  say(text.mounts.at, mountWords(mount), lengthText(mount.position[2], unit));

/** "below the ceiling", "on rail R1". */
export function mountWords({ on, name }: Mount): string {
  if ((on !== "rail" && on !== "face") || !name) return text.mounts[on];
  const wall = on === "face" ? /^wall (\d+)$/.exec(name)?.[1] : undefined;
  return wall === undefined ? say(text.mounts.named[on], name) : say(text.mounts.named.wall, wall);
}
