// The choices of the reader, and their encoding in a link.

import { modesOf, type Mode } from "../scene/classes";
import type { CameraPlace } from "../../scene/stage";
import type { Store } from "./store";

export type Selection = { kind: "label" | "unit"; index: number } | null;

export interface State {
  on: Uint8Array;
  /** gamma tau of every kind of label. */
  requirements: number[];
  mode: Mode;
  levels: boolean[];
  goods: boolean;
  plan: boolean;
  selection: Selection;
  /** The index of a state of the shop; null: the shop as in the store file. */
  shop: number | null;
  /** Null: the whole store. */
  camera: CameraPlace | null;
}

const mostGoods = 15000;

export function initialState(store: Store): State {
  const on = new Uint8Array(store.units.ids.length);
  for (const unit of store.units.selected) on[unit] = 1;
  return {
    on,
    requirements: store.labels.kinds.map((kind) => kind.requirement),
    mode: "margin",
    levels: store.levels.map(() => true),
    goods: store.part.look.length < mostGoods,
    plan: false,
    selection: null,
    shop: null,
    camera: null,
  };
}

/** Switches a unit; at most one option of a mounting point is on. */
export function switchUnit(store: Store, state: State, unit: number, on: boolean): void {
  state.on[unit] = on ? 1 : 0;
  if (!on) return;
  for (const mount of store.units.mounts)
    if (mount.includes(unit)) for (const other of mount) if (other !== unit) state.on[other] = 0;
}

/** Units that are on but not in the plan, and planned units that are off. */
export function changedUnits(store: Store, state: State): { added: number[]; removed: number[] } {
  const planned = new Set(store.units.selected);
  const added: number[] = [];
  state.on.forEach((on, unit) => {
    if (on && !planned.has(unit)) added.push(unit);
  });
  return { added, removed: store.units.selected.filter((unit) => !state.on[unit]) };
}

const millimetres = (values: number[]) => values.map((value) => String(Math.round(value * 1000) / 1000));

export function toHash(store: Store, state: State): string {
  const start = initialState(store);
  const words: string[] = ["view=1"];
  const { added, removed } = changedUnits(store, state);
  if (added.length) words.push(`on=${added.join(",")}`);
  if (removed.length) words.push(`off=${removed.join(",")}`);
  state.requirements.forEach((value, kind) => {
    if (value !== start.requirements[kind]) words.push(`need${kind}=${value}`);
  });
  if (state.mode !== start.mode) words.push(`colour=${state.mode}`);
  const hidden = state.levels.flatMap((shown, level) => (shown ? [] : [level + 1]));
  if (hidden.length) words.push(`hide=${hidden.join(",")}`);
  if (state.goods !== start.goods) words.push(`goods=${state.goods ? 1 : 0}`);
  if (state.plan) words.push("plan=1");
  if (state.selection) words.push(`${state.selection.kind}=${state.selection.index}`);
  if (state.shop !== null) words.push(`shop=${store.states[state.shop].number}`);
  if (state.camera) {
    const { at, target, zoom } = state.camera;
    words.push(`camera=${millimetres([...at, ...target, zoom]).join(",")}`);
  }
  return `#${words.join("&")}`;
}

/** Null for hashes of other origin. Invalid parts are ignored. */
export function fromHash(store: Store, hash: string): State | null {
  const words = new URLSearchParams(hash.replace(/^#/, ""));
  if (words.get("view") !== "1") return null;
  const state = initialState(store);
  const list = (name: string) =>
    (words.get(name) ?? "")
      .split(",")
      .filter((word) => word !== "")
      .map(Number);
  const isIndex = (count: number) => (index: number) => Number.isInteger(index) && index >= 0 && index < count;
  const isUnit = isIndex(store.units.ids.length);
  const isLabel = isIndex(store.labels.ids.length);
  for (const unit of list("off").filter(isUnit)) state.on[unit] = 0;
  for (const unit of list("on").filter(isUnit)) state.on[unit] = 1;
  state.requirements = state.requirements.map((value, kind) => {
    const wanted = Number(words.get(`need${kind}`) ?? value);
    return wanted > 0 && Number.isFinite(wanted) ? wanted : value;
  });
  state.mode = modesOf(store).find((mode) => mode === words.get("colour")) ?? state.mode;
  const hidden = new Set(list("hide"));
  state.levels = state.levels.map((_, level) => !hidden.has(level + 1));
  if (words.has("goods")) state.goods = words.get("goods") === "1";
  state.plan = words.get("plan") === "1";
  const [label, unit] = [list("label")[0], list("unit")[0]];
  if (isLabel(label)) state.selection = { kind: "label", index: label };
  else if (isUnit(unit)) state.selection = { kind: "unit", index: unit };
  const shop = store.states.findIndex(({ number }) => String(number) === words.get("shop"));
  if (shop >= 0) state.shop = shop;
  const camera = list("camera");
  if (camera.length === 7 && camera.every(Number.isFinite) && camera[6] > 0)
    state.camera = { at: camera.slice(0, 3), target: camera.slice(3, 6), zoom: camera[6] };
  return state;
}
