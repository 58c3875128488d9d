// The list of plans, and the difference between two of them.

import { counted, grouped } from "../../data/format";
import { button, element, replaceChildren } from "../../panel/dom";
import { openDialog } from "../access/dialog";
import type { PlanRun } from "../document/messages";
import type { Planner } from "../planner";
import { timeText } from "../side/history_list";
import { say, text } from "../text";
import { isActive } from "./plans";
import { lineOf, questionText } from "./sentences";

/** As `shelfbeam diff --json` prints it. */
interface Difference {
  differs: boolean;
  before: { units: number; reached: number; labels: number };
  after: { units: number; reached: number; labels: number };
  units: { kept: unknown[]; changed: unknown[]; added: { id: string }[]; removed: { id: string }[] };
  labels: { gained: unknown[]; lost: unknown[] };
  store: unknown[];
}

export class PlanList {
  private readonly list = element("ol", { class: "plan-list", "aria-label": text.plans.list });
  private readonly compare: HTMLButtonElement;
  readonly root: HTMLElement;
  /** Ids of the plans to compare, the first chosen first. */
  private marked: number[] = [];
  private of: unknown[] = [];

  constructor(
    private readonly planner: Planner,
    private readonly address: string,
  ) {
    this.compare = button(text.plans.compare, () => this.openDifference(), { title: text.plans.compare_says });
    this.root = element("section", { hidden: true }, element("h3", { text: text.plans.list }), this.list, this.compare);
  }

  update(): void {
    const { runs, shown } = this.planner.plans;
    const of = [runs, shown, this.marked];
    if (of.every((part, k) => part === this.of[k])) return;
    this.root.hidden = runs.length === 0;
    const comparable = new Set(runs.filter(({ result }) => result?.event === "result").map(({ id }) => id));
    this.marked = this.marked.filter((id) => comparable.has(id)).slice(-2);
    this.compare.hidden = comparable.size < 2;
    this.compare.disabled = this.marked.length !== 2;
    replaceChildren(
      this.list,
      runs.map((run) => this.row(run, comparable.has(run.id) && comparable.size > 1)),
    );
    this.of = [runs, shown, this.marked];
  }

  private row(run: PlanRun, isComparable: boolean): HTMLElement {
    const { plans } = this.planner;
    const name = button(run.folder, () => plans.show(run.id), {
      class: "plain",
      "aria-current": plans.shown?.id === run.id ? "true" : undefined,
      "data-key": `plan-${run.id}`,
    });
    const mark = element("input", {
      type: "checkbox",
      checked: this.marked.includes(run.id),
      "aria-label": say(text.plans.compare_of, run.folder),
      "data-key": `compare-${run.id}`,
      on: {
        change: () => {
          this.marked = this.marked.includes(run.id)
            ? this.marked.filter((id) => id !== run.id)
            : [...this.marked, run.id];
          this.update();
        },
      },
    });
    const cancel = button("×", () => void plans.cancel(run, text.plans.cancel), {
      "aria-label": say(text.plans.cancel_of, run.folder),
    });
    return element(
      "li",
      {},
      isComparable ? mark : null,
      name,
      element("small", { text: isActive(run) ? text.plans.states[run.state] : lineOf(run) }),
      element("small", { text: timeText(run.ended || run.begun) }),
      run.state === "waiting" ? cancel : null,
    );
  }

  /** From the older plan to the newer one. */
  private openDifference(): void {
    const { runs } = this.planner.plans;
    const [after, before] = runs.map(({ id }) => id).filter((id) => this.marked.includes(id));
    const name = (id: number) => runs.find((run) => run.id === id)?.folder ?? "";
    const questions = runs
      .filter(({ id }) => id === before || id === after)
      .reverse()
      .map(({ folder, plan }) => say(text.plans.question_of, folder, questionText(plan)));
    const body = element("div", { class: "content", role: "status" }, element("p", { text: text.plans.comparing }));
    openDialog(say(text.plans.difference, name(before), name(after)), "comparison", body);
    void this.planner.document
      .request<{ difference: Difference }>("difference", { before, after })
      .then(({ difference }) => [
        ...questions.map((question) => element("p", { class: "note", text: question })),
        ...this.resultOf(difference),
      ])
      .catch((error: unknown) => [
        element("p", {
          class: "problem",
          text: (error instanceof Error && error.message) || text.notices.no_connection,
        }),
      ])
      .then((found) => body.replaceChildren(...found));
  }

  private resultOf({ differs, units, labels, store, before, after }: Difference): HTMLElement[] {
    if (!differs) return [element("p", { text: text.plans.equal })];
    const ids = (list: readonly { id: string }[]) => list.map(({ id }) => id).join(", ");
    const lines = [
      say(
        text.plans.counts,
        grouped(before.units),
        grouped(after.units),
        grouped(before.reached),
        grouped(after.reached),
      ),
      ...(units.added.length > 0 ? [say(text.plans.added, ids(units.added))] : []),
      ...(units.removed.length > 0 ? [say(text.plans.removed, ids(units.removed))] : []),
      say(text.plans.gained_lost, grouped(labels.gained.length), grouped(labels.lost.length)),
      store.length > 0 ? counted(text.plans.store_differs, store.length) : text.plans.same_store,
    ];
    const page = element("a", {
      href: new URL("difference", this.address).href,
      target: "_blank",
      rel: "noopener",
      text: text.plans.difference_page,
    });
    return [...lines.map((line) => element("p", { text: line })), element("p", {}, page)];
  }
}
