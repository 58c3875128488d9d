// The result of a plan: its answer, its open labels, other selections, and the files for the fitter.

import { counted, grouped } from "../../data/format";
import { button, element, replaceChildren } from "../../panel/dom";
import { showSelection } from "../actions/source";
import type { PlanDetails, PlanRun } from "../document/messages";
import type { Planner } from "../planner";
import { say, text } from "../text";
import { deviceItem } from "../view/hit";
import { alternativesOf, lineOf, questionText, summaryOf } from "./sentences";

/** The files of a plan that people use, with the names under which they are kept. */
const files = {
  report: "report.html",
  sheet: "mounting.csv",
  drawing: "mounting.dxf",
  bill: "bill.csv",
  labels: "labels.csv",
} as const;
const mostListed = 50;

/** The first sentence is the answer; the others explain it. */
function answerOf(words: string): HTMLElement[] {
  const end = /[.:](?=\s+[A-Z])/.exec(words);
  const first = end ? words.slice(0, end.index + 1) : words;
  const rest = words.slice(first.length).trim();
  return [
    element("p", { class: "answer", text: first }),
    ...(rest === "" ? [] : [element("p", { class: "note", text: rest })]),
  ];
}

export class Result {
  readonly root = element("section", { class: "plan-result", hidden: true });
  private version = "";

  constructor(
    private readonly planner: Planner,
    private readonly address: string,
  ) {}

  update(): void {
    const { plans, document } = this.planner;
    const run = plans.shown;
    this.root.hidden = run === null;
    if (!run) return;
    const onPlan = this.planner.light.units.map(({ id }) => id);
    const states = [plans.states?.shown.length, plans.stateNumber];
    const version = JSON.stringify([run, plans.shop, document.locked, onPlan, states, document.values]);
    if (version === this.version) return;
    this.version = version;
    this.show(run, null);
    if (run.result?.event !== "result") {
      plans.forgetStates();
      return;
    }
    void plans.details(run).then((details) => {
      if (this.version !== version) return;
      this.show(run, details);
      const { missed = [], undecided = [], unreachable = [] } = details?.labels ?? {};
      plans.markOpen([...missed, ...undecided, ...unreachable].map(([index]) => index));
    });
  }

  private show(run: PlanRun, details: PlanDetails | null): void {
    const { result } = run;
    const hasFailed = result?.event === "error" && !result.interrupted;
    const sentence = result?.event === "result" ? result.answer : "";
    const answer = hasFailed ? say(text.plans.failed, result.message) : sentence || lineOf(run);
    replaceChildren(this.root, [
      element("h3", { text: run.folder }),
      element("p", { class: "note", text: questionText(run.plan) }),
      ...answerOf(answer),
      ...this.basis(run, details),
      ...this.remarks(run).map((remark) => element("p", { class: "note", text: remark })),
      ...this.buttons(run),
      ...(details ? [...this.states(run, details), ...this.alternatives(run, details), ...this.labels(details)] : []),
      ...(result?.event === "result" ? [this.files(run)] : []),
    ]);
  }

  private remarks(run: PlanRun): string[] {
    const { result } = run;
    const isSame = this.planner.plans.isOfThisShop(run);
    return [
      ...(result?.event === "result" && !result.complete ? [text.plans.incomplete] : []),
      ...(result?.event !== "result" && run.first ? [say(text.plans.first, summaryOf(run.first))] : []),
      ...(isSame === false ? [text.plans.shop_changed] : []),
      ...(isSame === null && run.result?.event === "result" ? [text.plans.shop_unknown] : []),
    ];
  }

  /** How well its values are known, and whether its report says so. */
  private basis(run: PlanRun, details: PlanDetails | null): HTMLElement[] {
    const words = details?.basis ?? (run.result?.event === "result" ? run.result.basis : "") ?? "";
    const { values } = this.planner.document;
    const isStale = (details?.details.values ?? []).some(({ value, of, state, amount }) =>
      values.some((now) => now.kind === value && now.of === of && now.amount === amount && now.state !== state),
    );
    const renew = button(text.plans.renew, () => void this.planner.plans.renew(run, text.plans.renew), {
      title: text.plans.renew_says,
      "data-key": "plan-renew",
    });
    return [
      ...(words === "" ? [] : [element("p", { class: "basis", text: words })]),
      ...(isStale ? [element("p", { class: "note", text: text.plans.renewed }), renew] : []),
    ];
  }

  private buttons(run: PlanRun): HTMLElement[] {
    const { plans, document } = this.planner;
    const hasResult = run.result?.event === "result";
    const selected = (run.result?.event === "result" ? run.result : run.first)?.selected ?? [];
    const enter = button(text.plans.enter, () => void plans.enter(run, text.plans.enter), {
      title: text.plans.enter_says,
      disabled: document.locked !== null,
      "data-key": "plan-enter",
    });
    const forget = button(text.plans.forget, () => void plans.forget(run, text.plans.forget), {
      "data-key": "plan-forget",
    });
    const entered = element("p", { class: "note", text: text.plans.entered });
    return [
      ...(selected.length === 0 ? [] : [this.isInShop(selected) ? entered : enter]),
      ...(hasResult ? [] : [forget]),
    ];
  }

  /** Whether these units, and no others, are on the plan. */
  private isInShop(ids: readonly string[]): boolean {
    const { units } = this.planner.light;
    return units.length === ids.length && units.every(({ id }) => ids.includes(id));
  }

  /** Between the plan for the shop as drawn and this one: what each change requires. */
  private reasons({ nominal, alone = [] }: NonNullable<PlanDetails["details"]["states"]>): HTMLElement[] {
    if (alone.length === 0) return [];
    const names: Record<string, string> = text.plans.causes;
    const cells = (row: readonly string[], tag: "th" | "td") => row.map((cell) => element(tag, { text: cell }));
    const rows = [
      [text.plans.as_drawn, "", grouped(nominal.units)],
      ...alone.map(({ cause, taken, units }) => [
        names[cause] ?? cause,
        grouped(taken.length),
        units > 0 ? grouped(units) : "–",
      ]),
    ];
    return [
      element("h4", { text: text.plans.reasons }),
      element(
        "table",
        { class: "reasons" },
        element("thead", {}, element("tr", {}, ...cells(text.plans.reason_columns, "th"))),
        element("tbody", {}, ...rows.map((row) => element("tr", {}, ...cells(row, "td")))),
      ),
    ];
  }

  /** The states of a shop that changes, one by one. */
  private states(run: PlanRun, { details }: PlanDetails): HTMLElement[] {
    const { plans } = this.planner;
    if (!details.states) {
      plans.forgetStates();
      return [];
    }
    void plans.loadStates(run);
    const reasons = this.reasons(details.states);
    const count = plans.states?.shown.length ?? 0;
    if (count === 0) return reasons;
    const { state, stateNumber: number } = plans;
    const go = (to: number) => () => plans.showState(to <= 0 || to > count ? null : to - 1);
    const words = state
      ? [
          say(text.plans.state, String(number), String(count)),
          counted(text.plans.state_missed, state.missed.length),
          counted(text.plans.state_blocks, state.blocks.length),
          ...(state.open_doors.length > 0 ? [say(text.plans.state_doors, state.open_doors.join(", "))] : []),
        ].join(" ")
      : text.plans.state_none;
    return [
      ...reasons,
      element("h4", { text: text.plans.states_title }),
      element("p", { class: "note", role: "status", text: words }),
      element(
        "div",
        { class: "steps" },
        button("‹", go(state ? number - 1 : count), {
          "aria-label": text.plans.state_before,
          "data-key": "state-before",
        }),
        button("›", go(number + 1), { "aria-label": text.plans.state_next, "data-key": "state-next" }),
      ),
    ];
  }

  private alternatives(run: PlanRun, details: PlanDetails): HTMLElement[] {
    const rows = alternativesOf(details);
    if (rows.length === 0) return [];
    const enter = (key: (typeof rows)[number]["key"]) => {
      const { count = 0, selected = [] } = (key && details.details.alternatives?.[key]) ?? {};
      if (key === null || selected.length === 0 || this.isInShop(selected)) return null;
      const name = say(text.plans.enter_other, grouped(count));
      return button(name, () => void this.planner.plans.enter(run, name, key), {
        disabled: this.planner.document.locked !== null,
        "data-key": `enter-${key}`,
      });
    };
    return [
      element("h4", { text: text.plans.what_if }),
      element(
        "dl",
        { class: "alternatives" },
        ...rows.flatMap(({ question, answer, key }) => [
          element("dt", { text: question }),
          element("dd", {}, element("p", { text: answer }), enter(key)),
        ]),
      ),
    ];
  }

  private labels({ details, labels }: PlanDetails): HTMLElement[] {
    const causes: Record<string, string> = text.plans.causes;
    const whyLost = new Map((details.states?.lost ?? []).map((one) => [one.label, one.causes]));
    const why = (id: string) => {
      const names = whyLost.get(id);
      if (!names) return "";
      return names.length === 0 ? text.plans.causes_together : names.map((name) => causes[name] ?? name).join(", ");
    };
    return (["unreachable", "missed", "undecided", "lost", "responsible", "not_verified_yet"] as const).flatMap(
      (kind) => {
        const list = labels[kind] ?? [];
        if (list.length === 0) return [];
        const row = ([index, id]: [number, string]) =>
          element(
            "li",
            {},
            button(id, () => this.goTo(index), { class: "plain", "data-key": `open-${kind}-${index}` }),
            kind === "lost" ? element("small", { text: why(id) }) : null,
          );
        const indices = list.map(([index]) => index);
        const all = button(text.plans.select_all, () => this.select(indices), { "data-key": `select-${kind}` });
        return [
          element("h4", { text: counted(text.plans.open_labels[kind], list.length) }),
          element("p", { class: "note", text: text.plans.remedies[kind] }),
          all,
          element("ul", { class: "light-list" }, ...list.slice(0, mostListed).map(row)),
          ...(list.length > mostListed
            ? [element("p", { class: "note", text: say(text.plans.more_labels, grouped(list.length - mostListed)) })]
            : []),
        ];
      },
    );
  }

  private goTo(index: number): void {
    this.select([index]);
    showSelection(this.planner);
  }

  private select(indices: readonly number[]): void {
    const { selection, document } = this.planner;
    const there = indices.filter((index) => index < document.labels.count);
    selection.set(there.map((index) => deviceItem(document.labels, index)));
  }

  private files(run: PlanRun): HTMLElement {
    const path = (file: string) => new URL(`plans/${run.id}/${file}`, this.address).href;
    const link = (kind: keyof typeof files) => {
      const file = files[kind];
      const isReport = kind === "report";
      return element(
        "li",
        {},
        element("a", {
          href: path(file),
          text: text.plans.files[kind],
          ...(isReport ? { target: "_blank", rel: "noopener" } : { download: `${run.folder}-${file}` }),
        }),
      );
    };
    return element(
      "div",
      {},
      element("h4", { text: text.plans.hand_over }),
      element(
        "ul",
        { class: "files" },
        ...(Object.keys(files) as (keyof typeof files)[]).map(link),
        element(
          "li",
          {},
          element("a", {
            href: path("report.html"),
            download: `${this.planner.title} ${run.folder}.html`,
            text: text.plans.share,
            title: text.plans.share_says,
          }),
        ),
      ),
    );
  }
}
