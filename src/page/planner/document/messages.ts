// The messages between page and server. Lengths are in m, except in the JSON of the store.

import type { EditOp, Json, JsonObject } from "./json";

export type Point = [number, number];

export type PartKind =
  | "room"
  | "wall"
  | "opening"
  | "zone"
  | "fixture"
  | "plane"
  | "keep_out"
  | "area"
  | "rail"
  | "grid"
  | "faces";

/** The resolved outline of an element, or of one copy of it. */
export interface Part {
  key: string;
  /** The element's place in the store; null if it is not in store.json. */
  path: string | null;
  kind: PartKind;
  type?: string;
  id: string;
  form?: string;
  outline: Point[];
  /** Of a room; of a row of openings, those behind the first. */
  holes?: Point[][];
  height?: number;
  rotation?: number;
  locked?: "repeat" | null;
  /** Whether it has problems, and only its place and size are known. */
  unfinished?: boolean;
  /** Of a fixture with a rectangle: the corner that it turns about, and its sides. */
  footing?: { at: Point; rotation: number; length: number; depth: number };
  /** Of a fixture against a wall or another fixture: the direction in which `from` or `shift` grows. */
  against?: { along: Point };
}

export interface Problem {
  code: string;
  /** In the words of the command line: fixtures[3].depth. */
  path: string;
  /** JSON pointer of the element, or empty. */
  pointer: string;
  /** That of the part, if it is one of several copies. */
  key?: string;
  sentence: string;
}

/** The sentence without the store file and the place, which the page shows in other ways. */
export function withoutPlace({ path, sentence }: Problem, file: string): string {
  const own = sentence.startsWith(`${file}: `) ? sentence.slice(file.length + 2) : sentence;
  if (path === "" || !own.startsWith(path)) return own;
  // A preset may follow the place: "fixtures[2] (preset 'row'): ..."
  const end = own.indexOf(": ", path.length);
  return end < 0 ? own : own.slice(end + 2);
}

export interface Step {
  label: string;
  time?: string;
}

export interface History {
  steps: Step[];
  /** The number of applied steps. */
  position: number;
}

export interface Locked {
  message: string;
}

/** Names that the catalogues of the store define. */
export type SharedNames = Partial<Record<"presets" | "materials" | "label_types" | "transceiver_types", string[]>>;

export interface ProjectEvent {
  event: "project";
  name: string;
  file: string;
  version: string;
  tab?: number;
  revision: number;
  json: Json;
  unit: string;
  parts: Part[];
  problems: Problem[];
  history: History;
  locked: Locked | null;
  shared?: SharedNames;
}

export interface ChangedEvent {
  event: "changed";
  revision: number;
  tab?: number;
  request?: number;
  json?: Json;
  ops?: EditOp[];
  parts?: { set: Part[]; remove: string[] };
  problems?: Problem[];
  history: History & { from: number };
  locked: Locked | null;
  shared?: SharedNames;
}

export interface WarningsEvent {
  event: "warnings";
  revision: number;
  warnings: Problem[];
}

export type ServerEvent = ProjectEvent | ChangedEvent | WarningsEvent;

/** The header of a binary frame: labels or units from..from+remove are replaced by those of the frame. */
export interface DevicesAbout {
  event: "labels" | "units";
  revision: number;
  from: number;
  remove: number;
}

export interface Details {
  /** The element with the keys of its presets. */
  effective: JsonObject;
  /** The units of lengths of presets from a catalogue in another unit than that of the store, by key. */
  units?: Record<string, string>;
  /** The keys of its presets alone, and the units of their lengths. */
  inherited: JsonObject;
  inherited_units?: Record<string, string>;
  /** All keys with defaults, in m; null if the element has problems. */
  resolved: JsonObject | null;
}

/** Where people find a label. */
export interface LabelPlace {
  fixture: string | null;
  wall: number | null;
  face: string | null;
  on_top: boolean;
  /** 0: on none. */
  board: number;
  /** m */
  along: number;
}

export interface DeviceAnswer {
  id: string;
  type: string;
  position: number[];
  path: string | null;
  source: string;
  /** Of a label. */
  normal?: number[];
  description?: string;
  place?: LabelPlace;
}

export interface Hit {
  kind: string;
  id: string;
  /** Of a label that has one. */
  description?: string;
  path?: string | null;
  /** Of a part. */
  key?: string;
  /** Of a label or unit. */
  index?: number;
  /** m; perhaps with a height. */
  at: number[];
}

export interface Refusal {
  path?: string;
  message: string;
}
