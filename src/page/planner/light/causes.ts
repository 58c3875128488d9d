// Which changes of the store change the light of the shop.

import type { EditOp } from "../document/json";
import type { Part } from "../document/messages";
import type { Preview } from "../document/preview";

/** Units have values of their own; the others are no matter of light. As in src/serve/live/shop.cpp. */
const others = [
  "name",
  "language",
  "currency",
  "source",
  "confirmed",
  "assumed",
  "drawing",
  "variation",
  "ignore",
  "transceivers",
];
const dark: ReadonlySet<Part["kind"]> = new Set(["area", "rail", "grid", "faces", "keep_out"]);

export const changesLight = (path: string): boolean => !others.includes(path.split("/")[1] ?? "");

const isLit = ({ path, kind }: Part): boolean => (path === null ? !dark.has(kind) : changesLight(path));

/** Whether edits without an answer, or what a gesture shows, change light. */
export const showsOtherLight = (pending: readonly EditOp[], { parts, devices, added }: Preview): boolean =>
  pending.some(({ path }) => changesLight(path)) ||
  [...devices.keys()].some(changesLight) ||
  [...parts.values()].some(isLit) ||
  added.some(isLit);
