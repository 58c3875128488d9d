// The plans of the project, as the server tells them.

import type { Changes } from "../changes";
import type { StoreDocument } from "../document/document";
import type { PlanDetails, PlanRequest, PlanRun, PlansEvent, PlanStates, ShownState } from "../document/messages";

export const isActive = ({ state }: PlanRun): boolean =>
  state === "waiting" || state === "previewing" || state === "running";

export class Plans {
  /** The newest first. */
  runs: readonly PlanRun[] = [];
  /** Units of the best selection so far of the plan that runs: indices. */
  proposed: ReadonlySet<number> = new Set();
  /** Of the plan that is shown, for a shop that changes. */
  states: PlanStates | null = null;
  /** Labels of the plan that is shown that are missed or undecided: indices. */
  open: readonly number[] = [];
  private stateIndex: number | null = null;
  private statesOf = "";
  /** Identifies the present shop. */
  shop = "";
  /** The plan that is shown; null: the newest. */
  private chosen: number | null = null;
  private readonly known = new Map<number, Promise<PlanDetails | null>>();

  constructor(
    private readonly document: StoreDocument,
    private readonly changes: Changes,
  ) {
    document.onPlans = (event) => this.receive(event);
  }

  get active(): PlanRun | null {
    return this.runs.find(({ state }) => state === "previewing" || state === "running") ?? null;
  }

  get shown(): PlanRun | null {
    return this.runs.find(({ id }) => id === this.chosen) ?? this.runs.find((run) => !isActive(run)) ?? null;
  }

  show(id: number): void {
    if (this.shown?.id !== id) {
      this.forgetStates();
      this.markOpen([]);
    }
    this.chosen = id;
    this.changes.note("plans");
  }

  /** Whether the shop is the one that was planned; null: unknown. */
  isOfThisShop({ shop }: PlanRun): boolean | null {
    return shop === "" || this.shop === "" ? null : shop === this.shop;
  }

  /** By label of the present shop; empty if the plan that is shown is of another one. */
  get availability(): readonly (number | null)[] {
    const { shown, states } = this;
    return shown && states && this.isOfThisShop(shown) !== false ? states.availability : [];
  }

  /** The state of the shop that the plan shows. */
  get state(): ShownState | null {
    return (this.stateIndex === null ? null : this.states?.shown[this.stateIndex]) ?? null;
  }

  /** The number of the state that is shown, from 1. */
  get stateNumber(): number {
    return (this.stateIndex ?? -1) + 1;
  }

  /** Null: the shop as drawn. */
  showState(index: number | null): void {
    this.stateIndex = index;
    this.changes.note("plans", "preview");
  }

  /** Asks for the states of the plan that is shown. */
  async loadStates({ id, written }: PlanRun): Promise<void> {
    const wanted = `${id} ${written}`;
    if (this.statesOf === wanted) return;
    this.forgetStates();
    this.statesOf = wanted;
    const states = await this.document.request<PlanStates>("plan_states", { plan: id }).catch(() => null);
    if (this.statesOf !== wanted) return;
    this.states = states;
    this.changes.note("plans");
  }

  markOpen(labels: readonly number[]): void {
    if (labels.length === 0 && this.open.length === 0) return;
    this.open = labels;
    this.changes.note("preview");
  }

  forgetStates(): void {
    const had = this.states !== null;
    this.statesOf = "";
    this.states = null;
    if (had || this.stateIndex !== null) this.showState(null);
  }

  async start(plan: PlanRequest, label: string): Promise<void> {
    const answer = await this.document.ask<{ plan: number }>("plan", { plan }, label);
    if (answer) this.chosen = null;
  }

  cancel({ id }: PlanRun, label: string): Promise<unknown> {
    return this.document.ask("plan_cancel", { plan: id }, label);
  }

  forget({ id }: PlanRun, label: string): Promise<unknown> {
    return this.document.ask("plan_forget", { plan: id }, label);
  }

  /** Writes its report again, with the states that its values have now. */
  renew({ id }: PlanRun, label: string): Promise<unknown> {
    return this.document.ask("plan_report", { plan: id }, label);
  }

  /** Selects its units in the store, or those of one of its alternatives. */
  enter({ id }: PlanRun, label: string, alternative?: string): Promise<unknown> {
    return this.document.ask("plan_enter", { plan: id, ...(alternative ? { alternative } : {}) }, label);
  }

  /** Its result in detail; null if it cannot be read. The labels are those of the shop when it was asked for. */
  details({ id }: PlanRun): Promise<PlanDetails | null> {
    const known = this.known.get(id);
    if (known) return known;
    const asked = this.document.request<PlanDetails>("plan_details", { plan: id }).catch(() => null);
    this.known.set(id, asked);
    return asked;
  }

  private receive({ all, set = [], remove = [], shop }: PlansEvent): void {
    const before = this.runs;
    const kept = (all ?? before).filter(({ id }) => !remove.includes(id));
    const byId = new Map([...kept, ...set].map((run) => [run.id, run]));
    const time = ({ begun, ended }: PlanRun) => ended || begun;
    const order = (a: PlanRun, b: PlanRun) =>
      Number(isActive(b)) - Number(isActive(a)) || time(b).localeCompare(time(a)) || b.id - a.id;
    this.runs = [...byId.values()].sort(order);
    for (const { id } of [...(all ?? []), ...set]) this.known.delete(id);
    if (shop !== undefined) {
      if (shop !== this.shop) {
        this.known.clear(); // labels have other numbers
        this.markOpen([]);
        this.forgetStates();
      }
      this.shop = shop;
    }
    this.propose(this.active?.progress?.units ?? []);
    this.changes.note("plans");
  }

  private propose(units: readonly number[]): void {
    if (units.length === this.proposed.size && units.every((index) => this.proposed.has(index))) return;
    this.proposed = new Set(units);
    this.changes.note("proposed");
  }
}
