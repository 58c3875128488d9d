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

/** A value on which plans rest. */
export interface KnownValue {
  kind: "threshold" | "power" | "responsivity" | "height" | "reflectance" | "price";
  /** Its type or material. */
  of: string;
  state: "assumed" | "given" | "confirmed";
  words: string;
  /** W/m², W, m, a share or a price; 0 without one. */
  amount: number;
  /** The pointer of its mark below `confirmed`, and the value there. */
  mark: string;
  value: Json;
}

/** A type of labels or transceivers in a catalogue. */
export interface Product {
  name: string;
  source: "datasheet" | "measured" | "assumption" | "example" | null;
  order_number: string;
  /** A data URI; may be empty. */
  picture: string;
  /** W/m² or W. */
  amount: number;
  price: number | null;
}

export type Products = Record<"label_types" | "transceiver_types", Product[]>;

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
  values?: KnownValue[];
  products?: Products;
}

export interface ChangedEvent {
  event: "changed";
  revision: number;
  tab?: number;
  request?: number;
  /** The plan that has ended, whose units are selected. */
  plan?: number;
  json?: Json;
  ops?: EditOp[];
  parts?: { set: Part[]; remove: string[] };
  problems?: Problem[];
  history: History & { from: number };
  locked: Locked | null;
  shared?: SharedNames;
  values?: KnownValue[];
  products?: Products;
}

export interface WarningsEvent {
  event: "warnings";
  revision: number;
  warnings: Problem[];
}

/** From the roughest to the exact one. */
export const stages = ["direct", "coarse", "fine", "simulated"] as const;
export type Stage = (typeof stages)[number];

/** A unit on the plan: installed, pinned or selected. */
export interface UnitOnPlan {
  index: number;
  id: string;
  /** Finds its values; changes with its place, axis, roll, type and power. */
  key: string;
}

export interface LightEvent {
  event: "light";
  /** Counts the changes of everything on which light depends, except units. */
  generation: number;
  revision: number;
  units: UnitOnPlan[];
  phase: "waiting" | "preparing" | "refining" | "done" | "failed" | "none" | "off";
  message?: string;
  operator: "coarse" | "fine" | null;
  undecided: number | null;
  progress: number | null;
  /** `reached`: for each label 1, 0, or - if it is unknown. */
  baseline: { plan: string; reached: string } | null;
}

export interface RequirementsAbout {
  event: "requirements";
  generation: number;
}

export interface ColumnAbout {
  event: "column";
  generation: number;
  /** Its key. */
  unit: string;
  stage: Stage;
}

export type LightAbout = RequirementsAbout | ColumnAbout;

export type MountKind = "ceiling" | "rail" | "face" | "free";

export interface DragAbout {
  event: "drag";
  id: number;
  generation: number;
  position: number[];
  axis: number[];
  roll_deg: number;
  on: MountKind;
  /** Of the rail, the fixture or the wall. */
  name?: string;
  stage: Stage;
  /** Time of the server. */
  column_ms: number;
}

export interface DragRequest {
  at: number[];
  /** The index of the unit that is dragged. */
  unit: number;
}

/** The request of a plan (docs/formats/job.md), as far as the page sets it. */
export interface PlanRequest {
  problem?: { model?: "non-cooperative"; survives_failure?: boolean };
  at_most?: number;
  reach?: number;
  place?: { time_limit?: number };
  constraints?: { min_spacing?: number };
  confidence?: number;
  budget?: number;
  states?: number;
}

export interface PlanProgress {
  /** Of docs/formats/job.md. */
  task: string;
  detail: string;
  share: number | null;
  seconds_left: number | null;
  /** Of the best selection so far, and its bound: units, labels or a price. */
  incumbent: number | null;
  bound: number | null;
  /** The number of its units, and the indices of those that the shop has. */
  count: number;
  units: number[];
}

export interface PlanResult {
  event: "result";
  answer: string;
  /** How well the values are known on which it rests; earlier versions do not write it. */
  basis?: string;
  complete: boolean;
  labels: number;
  units: number | null;
  lower_bound: number | null;
  price: number | null;
  currency: string | null;
  selected: string[];
}

export interface PlanFailure {
  event: "error";
  message: string;
  interrupted: boolean;
}

/** A plan of the project: one that runs, or one in its folder. */
export interface PlanRun {
  id: number;
  /** Its name in the folder of the project. */
  folder: string;
  /** Null: of another program. */
  plan: PlanRequest | null;
  state: "waiting" | "previewing" | "running" | "done" | "stopped" | "failed";
  begun: string;
  ended: string;
  /** Changes with its files. */
  written: number;
  /** Equal to that of the event if it is of the present shop. */
  shop: string;
  /** After an interruption of the program. */
  continued: boolean;
  /** Its units were selected in the store. */
  entered: boolean;
  /** It was asked to end with its results so far. */
  cancelled: boolean;
  /** A preview. */
  first: PlanResult | null;
  result: PlanResult | PlanFailure | null;
  progress?: PlanProgress;
}

export interface PlansEvent {
  event: "plans";
  /** Identifies the present shop. */
  shop?: string;
  all?: PlanRun[];
  set?: PlanRun[];
  remove?: number[];
}

/** Another selection (docs/formats/placement.md, alternatives). */
export interface PlanAlternative {
  count: number;
  selected: string[];
  reached: number;
  reached_upper_bound: number;
  smallest_margin: number | null;
  secure: number;
  price: { new: number; currency: string | null } | null;
  proven: boolean;
}

export interface PlanDetails {
  details: {
    count: number;
    labels: number;
    /** Since version 0.5. */
    values?: { value: KnownValue["kind"]; of: string; state: KnownValue["state"]; amount: number }[];
    alternatives?: {
      one_fewer?: PlanAlternative;
      one_more?: PlanAlternative;
      survives_failure?: PlanAlternative;
      cannot_survive?: boolean;
    };
    /** Only of a shop that changes; earlier versions do not write the optional parts. */
    states?: {
      /** Of the shop as drawn. */
      nominal: { units: number };
      /** Each cause alone: the labels that it takes from these units, and the number of units that it needs. */
      alone?: { cause: string; taken: string[]; units: number }[];
      /** Labels that are missed in every state, with the causes each of which has this effect alone. */
      lost?: { label: string; causes: string[] }[];
    };
  };
  /** Indices and ids of labels, by the list that has them. */
  /** How well its values are known, in words. */
  basis: string;
  labels: Partial<
    Record<"missed" | "undecided" | "unreachable" | "not_verified_yet" | "responsible" | "lost", [number, string][]>
  >;
}

/** The shop in one of the states that the report of a plan shows. */
export interface ShownState {
  /** Its number. */
  state: number;
  /** Indices of labels. */
  missed: number[];
  /** Outlines of people and objects, m. */
  blocks: Point[][];
  /** Ids of fixtures. */
  open_doors: string[];
}

export interface PlanStates {
  shown: ShownState[];
  /** By label: the share of the states in which it is reached, null if the plan does not have it; empty if no plan was
   * examined. */
  availability: (number | null)[];
}

export type ServerEvent = ProjectEvent | ChangedEvent | WarningsEvent | LightEvent | PlansEvent;

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
