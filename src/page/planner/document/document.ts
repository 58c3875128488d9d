// The store as the page shows it: what the server has confirmed, and the edits that it has not answered yet.

import type { PageData } from "../../data/page_data";
import type { Changes } from "../changes";
import { unitNamed, type LengthUnit, metre } from "../geometry/units";
import { text } from "../text";
import { Lost, Refused, type Connection } from "./connection";
import { DetailsCache } from "./details";
import { Devices } from "./devices";
import type { Edit } from "./edit";
import {
  applyOps,
  Conflict,
  inverseOf,
  isMoving,
  placesAfter,
  valueAt,
  type EditOp,
  type Json,
  type JsonObject,
} from "./json";
import type {
  ChangedEvent,
  DevicesAbout,
  History,
  KnownValue,
  LightAbout,
  LightEvent,
  Locked,
  PlansEvent,
  Problem,
  Products,
  ProjectEvent,
  Refusal,
  ServerEvent,
  SharedNames,
} from "./messages";
import { Parts } from "./parts";
import { joinPreviews, noPreview, type Preview } from "./preview";

interface Pending {
  id: number;
  edit: Edit;
  preview: Preview;
  done: (accepted: boolean) => void;
}

export type Saving =
  | { state: "saved" }
  | { state: "saving" }
  | { state: "refused"; refusal: Refusal }
  | { state: "lost"; edits: number; hasEnded: boolean };

export interface Others {
  /** Whether it was a tab, another program, or a plan that has ended. */
  by: "tab" | "program" | "plan";
  history: Record<"before" | "after", History>;
  json: Record<"before" | "after", Json>;
}

export class StoreDocument {
  name = "";
  file = "";
  version = "";
  json: Json = {};
  /** Without the edits that wait for an answer: labels and units are those of this store. */
  confirmed: Json = {};
  unit: LengthUnit = metre;
  readonly parts = new Parts();
  readonly labels = new Devices("label");
  readonly units = new Devices("unit");
  readonly details: DetailsCache;
  problems: Problem[] = [];
  warnings: Problem[] = [];
  history: History = { steps: [], position: 0 };
  locked: Locked | null = null;
  shared: SharedNames = {};
  values: KnownValue[] = [];
  products: Products = { label_types: [], transceiver_types: [] };
  revision = -1;
  isReady = false;

  /** Places of values move, or an element is removed (`place` is null). */
  onMoved: (place: (path: string) => string | null) => void = () => {};
  /** The whole store is another one. */
  onReplaced: (before: Json) => void = () => {};
  onRefused: (label: string, refusal: Refusal) => void = () => {};
  /** Another tab or another program has changed the store. */
  onOthers: (others: Others) => void = () => {};
  /** The server, perhaps another one than before, sends everything. */
  onStart: () => void = () => {};
  /** The server has confirmed a change; null: perhaps of all of the store. */
  onChanged: (revision: number, ops: readonly EditOp[] | null) => void = () => {};
  onLight: (event: LightEvent) => void = () => {};
  onPlans: (event: PlansEvent) => void = () => {};
  onLightFrame: (frame: PageData<LightAbout>) => void = () => {};

  private tab: number | undefined;
  private pending: Pending[] = [];
  private gesture: Preview = noPreview;
  private refusal: Refusal | null = null;
  /** Steps that the server was asked to undo and has not answered. */
  private undoing = 0;
  /** Changes that the server makes and has not answered. */
  private asking = 0;

  constructor(
    private readonly connection: Connection,
    private readonly changes: Changes,
    /** Converts lengths of presets in other units to that of the store. */
    inUnit: (effective: JsonObject, units: Record<string, string>, unit: LengthUnit) => JsonObject = (effective) =>
      effective,
  ) {
    this.details = new DetailsCache(
      connection,
      (effective, units) => inUnit(effective, units, this.unit),
      () => changes.note("document"),
    );
    connection.onEvent = (event) => this.receive(event);
    connection.onFrame = (frame) => this.receiveFrame(frame as PageData<DevicesAbout | LightAbout>);
    connection.onState = () => {
      changes.note("status");
    };
  }

  get saving(): Saving {
    if (this.isReady && !this.connection.isOpen)
      return { state: "lost", edits: this.pending.length, hasEnded: this.connection.hasEnded };
    if (this.pending.length > 0 || this.asking > 0) return { state: "saving" };
    return this.refusal ? { state: "refused", refusal: this.refusal } : { state: "saved" };
  }

  get canUndo(): boolean {
    return this.locked === null && this.history.position + this.pending.length > 0;
  }

  get canRedo(): boolean {
    return this.locked === null && (this.history.position < this.history.steps.length || this.undoing > 0);
  }

  /** Shows the state of a gesture; null: none. */
  show(preview: Preview | null): void {
    this.gesture = preview ?? noPreview;
    this.showParts();
    this.changes.note("preview");
  }

  /** The edits without an answer. */
  get pendingOps(): EditOp[] {
    return this.pending.flatMap(({ edit }) => edit.ops);
  }

  get preview(): Preview {
    return joinPreviews([...this.pending.map(({ preview }) => preview), this.gesture]);
  }

  /** Sends an edit. It shows at once, and is taken back if the server refuses it (false). */
  edit(edit: Edit, preview: Preview = noPreview): Promise<boolean> {
    this.gesture = noPreview;
    if (edit.ops.length === 0 || this.locked) {
      this.show(null);
      return Promise.resolve(false);
    }
    const before = this.json;
    try {
      this.json = applyOps(before, edit.ops);
    } catch (error) {
      if (!(error instanceof Conflict)) throw error;
      this.show(null);
      this.refused(edit.label, { path: error.message, message: "" });
      return Promise.resolve(false);
    }
    this.refusal = null;
    return new Promise((done) => {
      const sent = { id: this.connection.nextId(), edit, preview, done };
      this.pending.push(sent);
      this.details.follow(edit.ops);
      this.onMoved(placesAfter(edit.ops, before));
      this.showParts();
      this.changes.note("document", "preview", "status");
      this.send(sent);
    });
  }

  undo(): Promise<boolean> {
    ++this.undoing;
    return this.does("undo").finally(() => {
      --this.undoing;
      this.changes.note("status");
    });
  }

  redo(): Promise<boolean> {
    return this.does("redo");
  }

  /** Undoes or redoes steps until `position` are applied. */
  go(position: number): Promise<boolean> {
    return this.does("go", { position });
  }

  dissolve(path: string, label: string): Promise<boolean> {
    return this.does("dissolve", { path, label });
  }

  restore(): Promise<boolean> {
    return this.does("restore");
  }

  request<Answer>(what: string, members: object): Promise<Answer> {
    return this.connection.request<Answer>(what, members);
  }

  private async does(what: string, members: object = {}): Promise<boolean> {
    return (await this.ask(what, members)) !== null;
  }

  /** Asks for a change that the server makes; null if it refuses, which the page says of `label`. */
  async ask<Answer = object>(what: string, members: object, label = what): Promise<Answer | null> {
    ++this.asking;
    this.changes.note("status");
    try {
      const answer = await this.connection.request<Answer>(what, members);
      this.refusal = null;
      return answer;
    } catch (error) {
      if (error instanceof Refused) this.refused(label, error.refusal);
      else if (error instanceof Lost) this.onRefused(label, { message: text.notices.no_connection });
      return null;
    } finally {
      --this.asking;
      this.changes.note("status");
    }
  }

  private send(sent: Pending): void {
    const { id, edit } = sent;
    this.connection.request<{ revision: number }>("edit", edit, id).then(
      ({ revision }) => {
        if (revision <= this.revision) this.settle(sent, true);
      },
      (error: unknown) => {
        if (error instanceof Lost) this.changes.note("status");
        else if (error instanceof Refused && this.settle(sent, false)) this.refused(edit.label, error.refusal);
      },
    );
  }

  private refused(label: string, refusal: Refusal): void {
    this.refusal = refusal;
    this.onRefused(label, refusal);
    this.changes.note("status");
  }

  /** Ends the wait for an edit; false if it had ended. */
  private settle(sent: Pending, accepted: boolean): boolean {
    if (!this.pending.includes(sent)) return false;
    this.pending = this.pending.filter((other) => other !== sent);
    const { ops } = sent.edit;
    if (!accepted && ops.some(isMoving)) this.onMoved(this.placesAfter(inverseOf(ops), this.json));
    this.rebase();
    sent.done(accepted);
    return true;
  }

  /** The confirmed store with the edits that wait. Those that do not fit any more are refused by the server. */
  private rebase(): void {
    this.json = this.confirmed;
    for (const { edit } of this.pending)
      try {
        this.json = applyOps(this.json, edit.ops);
      } catch (error) {
        if (!(error instanceof Conflict)) throw error;
      }
    this.unit = unitNamed(String(valueAt(this.json, "/units") ?? "m"));
    this.details.forget();
    this.showParts();
    this.changes.note("document", "preview", "status");
  }

  private showParts(): void {
    this.parts.show(this.preview, this.placesAfter(this.pendingOps, this.confirmed));
  }

  private placesAfter(ops: readonly EditOp[], root: Json): (path: string) => string | null {
    try {
      return placesAfter(ops, root);
    } catch (error) {
      // An edit that does not fit any more will be refused.
      if (error instanceof Conflict) return (path) => path;
      throw error;
    }
  }

  private receive(event: ServerEvent): void {
    if (event.event === "project") this.start(event);
    else if (event.event === "changed") this.change(event);
    else if (event.event === "light") this.onLight(event);
    else if (event.event === "plans") this.onPlans(event);
    else {
      this.warnings = event.warnings;
      this.changes.note("warnings");
    }
  }

  private start(event: ProjectEvent): void {
    const before = this.json;
    const revisionBefore = this.revision;
    Object.assign(this, { name: event.name, file: event.file, version: event.version, tab: event.tab });
    this.revision = event.revision;
    this.confirmed = event.json;
    this.parts.replaceAll(event.parts);
    this.labels.clear();
    this.units.clear();
    this.take(event);
    this.onStart();
    const wasReady = this.isReady;
    this.isReady = true;
    if (wasReady) this.sendAgain(revisionBefore);
    this.rebase();
    if (wasReady) this.onReplaced(before);
    this.changes.note("devices", "warnings");
  }

  /** After a lost connection: sends the edits that the server, which takes them in order, has not received. */
  private sendAgain(revisionBefore: number): void {
    const ops = (count: number) => this.pending.slice(0, count).flatMap(({ edit }) => edit.ops);
    let there = this.revision === revisionBefore ? 0 : this.pending.length;
    while (there > 0 && !this.isApplied(ops(there))) --there;
    const received = this.pending.splice(0, there);
    for (const { done } of received) done(true);
    for (const sent of this.pending) this.send(sent);
  }

  /** Changes that can be taken back are there. */
  private isApplied(ops: readonly EditOp[]): boolean {
    try {
      applyOps(this.confirmed, inverseOf(ops));
      return true;
    } catch (error) {
      if (error instanceof Conflict) return false;
      throw error;
    }
  }

  private change(event: ChangedEvent): void {
    const [before, confirmedBefore, historyBefore] = [this.json, this.confirmed, this.history];
    const own = this.pending.find(({ id }) => event.tab === this.tab && event.request === id);
    try {
      if (event.ops) this.confirmed = applyOps(this.confirmed, event.ops);
      else if (event.json !== undefined) this.confirmed = event.json;
    } catch (error) {
      if (!(error instanceof Conflict)) throw error;
      this.connection.close(); // an event was lost: begin again with the present store
      return;
    }
    if (event.ops && !own) {
      this.onMoved(this.placesAfter(event.ops, confirmedBefore));
    }
    if (!event.ops) this.details.clear();
    else if (!own) this.details.follow(event.ops);
    const ofOthers = event.revision - this.revision - (event.tab === this.tab ? 1 : 0);
    this.revision = event.revision;
    this.onChanged(event.revision, event.ops ?? (event.json === undefined ? [] : null));
    if (event.parts) this.parts.change(event.parts);
    this.take(event);
    if (own) this.settle(own, true);
    else this.rebase();
    if (!event.ops) this.onReplaced(before);
    if (ofOthers > 0)
      this.onOthers({
        by: event.plan !== undefined ? "plan" : event.tab !== undefined && event.tab !== this.tab ? "tab" : "program",
        history: { before: historyBefore, after: this.history },
        json: { before: confirmedBefore, after: this.confirmed },
      });
  }

  private take({ locked, history, ...given }: ProjectEvent | ChangedEvent): void {
    const { problems = this.problems, shared = this.shared } = given;
    const { values = this.values, products = this.products } = given;
    const earlier = "from" in history ? this.history.steps.slice(0, history.from) : [];
    const { position, steps } = history;
    const all = [...earlier, ...steps];
    Object.assign(this, { problems, shared, values, products, locked, history: { position, steps: all } });
  }

  private receiveFrame(frame: PageData<DevicesAbout | LightAbout>): void {
    const { event } = frame.about;
    if (event !== "labels" && event !== "units") {
      this.onLightFrame(frame as PageData<LightAbout>);
      return;
    }
    (event === "labels" ? this.labels : this.units).receive(frame as PageData<DevicesAbout>);
    this.changes.note("devices");
  }
}
