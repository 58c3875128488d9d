// What the page knows of light: the values of the units on the plan, and whether they are current.
//
// Values of a generation are shown until those of the next are complete, but as stale. A drag puts the column of its last
// answer in the place of the dragged unit's, until the column of the changed unit has come.

import type { PageData } from "../../data/page_data";
import type { Changes } from "../changes";
import type { Connection } from "../document/connection";
import type { StoreDocument } from "../document/document";
import type { LightAbout, LightEvent, Stage, UnitOnPlan } from "../document/messages";
import { changesLight, showsOtherLight } from "./causes";
import { Dragger, type DragAnswer } from "./dragger";
import { Column, Field, reachOf } from "./field";
import { palettes, type PaletteName } from "./looks";
import { Verdicts } from "./verdicts";

/** The key of the column that a drag shows. */
const dragKey = "drag";

interface Drag {
  unit: number;
  /** The key of its column before; null if it was not on the plan. */
  key: string | null;
  /** All keys before. */
  known: ReadonlySet<string>;
  answer: DragAnswer | null;
  /** The verdicts before. */
  before: Uint8Array;
  /** The revision at the drop; null before it. */
  dropped: number | null;
}

/** What a unit on the plan sends to a label. */
export interface Contribution {
  /** Its index. */
  unit: number;
  /** m; null: where the plan shows it. */
  position: readonly number[] | null;
  signal: number;
}

const paletteKey = "shelfbeam.palette";

function rememberedPalette(): PaletteName {
  try {
    return palettes.find((name) => name === localStorage.getItem(paletteKey)) ?? palettes[0];
  } catch {
    return palettes[0];
  }
}

export class Light {
  readonly dragger: Dragger;
  readonly verdicts = new Verdicts();
  event: LightEvent | null = null;
  /** Whether the values are not those of the shop as it is shown. */
  isStale = false;
  /** Changes with everything that is shown. */
  version = 0;
  palette = rememberedPalette();

  private current = new Field(-1);
  /** The last complete values of an earlier generation. */
  private earlier: Field | null = null;
  private held: Drag | null = null;
  /** Units without a column. */
  private missing = 0;
  /** The last revision that changed light. */
  private changed = -1;
  private isDirty = true;

  constructor(
    private readonly document: Pick<StoreDocument, "revision" | "labels" | "pendingOps" | "preview">,
    private readonly changes: Pick<Changes, "note">,
    connection: Pick<Connection, "request">,
    isSoftware = false,
  ) {
    this.dragger = new Dragger(connection, (unit, answer) => this.drag(unit, answer), isSoftware);
  }

  setPalette(palette: PaletteName): void {
    this.palette = palette;
    this.changes.note("light");
    try {
      localStorage.setItem(paletteKey, palette);
    } catch {
      // Private windows may refuse to remember.
    }
  }

  /** Whether the server answers drags. */
  get canDrag(): boolean {
    return this.event !== null && this.event.operator !== null;
  }

  /** The last answer of a drag that is under way; null without one. */
  get dragged(): DragAnswer | null {
    return this.held?.dropped === null ? this.held.answer : null;
  }

  /** The verdicts before the drag that is under way. */
  get before(): Uint8Array | null {
    return this.dragged && this.held ? this.held.before : null;
  }

  /** Shows the light of a unit at another place. `unit`: its index. */
  drag(unit: number, answer: DragAnswer): void {
    if (!this.isCurrent(answer.about.generation)) return;
    if (this.held?.dropped !== null) this.held = this.begun(unit);
    this.held.answer = answer;
    this.sum();
  }

  private begun(unit: number): Drag {
    this.refresh();
    const { units } = this;
    return {
      unit,
      key: units.find(({ index }) => index === unit)?.key ?? null,
      known: new Set(units.map(({ key }) => key)),
      answer: null,
      before: this.verdicts.verdict.slice(),
      dropped: null,
    };
  }

  /**
   * `isKept`: the unit is dropped, and the light of its last answer stays until that of the changed unit has come; false:
   * the drag was cancelled, or the edit refused.
   */
  endDrag(isKept = true): void {
    this.dragger.stop();
    if (!this.held) return;
    if (isKept) this.held.dropped ??= this.document.revision;
    else this.held = null;
    this.sum();
  }

  /** Values of other generations than that of the last event are dropped. */
  protected isCurrent(generation: number): boolean {
    return generation === this.event?.generation;
  }

  /** Another server may count generations anew. */
  restart(): void {
    if (this.isComplete) this.earlier = this.current;
    this.current = new Field(-1);
    this.held = null;
    this.event = null;
    this.changed = -1;
    this.sum();
  }

  receive(event: LightEvent): void {
    if (event.generation !== this.current.generation) {
      if (this.isComplete) this.earlier = this.current;
      this.current = new Field(event.generation);
      if (this.held) this.held.answer = null;
    }
    this.event = event;
    if (event.phase === "failed" || event.phase === "none") this.earlier = null;
    this.sum();
  }

  receiveFrame(frame: PageData<LightAbout>): void {
    const { about } = frame;
    if (!this.isCurrent(about.generation)) return;
    if (about.event === "column") this.current.keep(about.unit, Column.of(frame, about), this.units);
    else this.current.require(frame.get("requirement", Float32Array));
    this.sum();
  }

  /** After a change of the store. `ops`: null if all of it may have changed. */
  noteChange(revision: number, ops: readonly { path: string }[] | null): void {
    if (ops === null || ops.some(({ path }) => changesLight(path))) this.changed = revision;
  }

  get units(): readonly UnitOnPlan[] {
    return this.event?.units ?? [];
  }

  private get isComplete(): boolean {
    return this.missing === 0 && this.current.requirement !== null;
  }

  /** Makes the sums those of the units on the plan, with the one that is dragged. */
  private sum(): void {
    const { current, units } = this;
    if (this.isDragOver()) this.held = null;
    const { held } = this;
    const wanted = new Map<string, Column>();
    this.missing = 0;
    for (const { key } of units) {
      if (held?.answer && key === held.key) continue;
      const column = current.columns.get(key);
      if (column) wanted.set(key, column);
      else if (!held?.answer || held.dropped === null || held.known.has(key)) ++this.missing;
    }
    if (held?.answer) wanted.set(dragKey, held.answer.column);
    current.sum(wanted);
    if (this.isComplete) this.earlier = null;
    this.isDirty = true;
    this.changes.note("light");
  }

  /** Whether the column of the dropped unit has come, or the store has changed without it. */
  private isDragOver(): boolean {
    const { held, current, event } = this;
    if (!held || held.dropped === null) return false;
    const made = this.units.filter(({ key }) => !held.known.has(key));
    if (made.length > 0) return made.every(({ key }) => current.columns.has(key));
    return event !== null && event.revision > held.dropped;
  }

  /** The values that are shown; null without any. */
  get field(): Field | null {
    const field = this.earlier ?? this.current;
    return field.summed.size > 0 && field.count === this.document.labels.count ? field : null;
  }

  /** The roughest stage of the values; null without any. */
  get stage(): Stage | null {
    return this.field?.stage ?? null;
  }

  get isPreview(): boolean {
    return this.stage !== null && this.stage !== "simulated";
  }

  /** Whether the signals are at least those shown, because reflections or units are missing. */
  get isLeast(): boolean {
    return this.stage === "direct" || (this.field === this.current && this.missing > 0);
  }

  /** Brings verdicts and `version` up to date; whatever shows light calls it first. */
  refresh(): void {
    const { document, field } = this;
    const isStale =
      field !== null &&
      (field !== this.current ||
        this.changed > (this.event?.revision ?? -1) ||
        showsOtherLight(document.pendingOps, document.preview));
    const { count } = document.labels;
    if (!this.isDirty && isStale === this.isStale && this.verdicts.verdict.length === count) return;
    this.isStale = isStale;
    this.isDirty = false;
    ++this.version;
    this.verdicts.update(field, count, this.isLeast);
  }

  /** The number of labels that a unit on the plan reaches alone; null before its column has come. */
  reachOf(key: string): number | null {
    const { field, held } = this;
    const isHeld = held !== null && held.answer !== null && (key === held.key || !held.known.has(key));
    const column = field?.summed.get(isHeld ? dragKey : key);
    return field?.requirement && column ? reachOf(column, field.requirement) : null;
  }

  /** Why the signal of a label may be wrong by more than its error: bits as in previews. */
  doubts(label: number): number {
    let found = 0;
    for (const { doubts } of this.field?.summed.values() ?? []) found |= doubts[label] ?? 0;
    return found;
  }

  /** Of the units on the plan, the strongest first. */
  contributions(label: number): Contribution[] {
    const { field, held } = this;
    if (!field) return [];
    const found: Contribution[] = [];
    for (const [key, { signal }] of field.summed) {
      const isHeld = key === dragKey;
      const unit = isHeld ? held?.unit : this.units.find((one) => one.key === key)?.index;
      if (unit === undefined) continue;
      const position = isHeld ? (held?.answer?.about.position ?? null) : null;
      if (signal[label] > 0) found.push({ unit, position, signal: signal[label] });
    }
    return found.sort((a, b) => b.signal - a.signal);
  }
}
