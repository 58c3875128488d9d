// The tab about light: how far it is computed, what it reaches, and where it is weakest.

import { counted, grouped, percent } from "../../../data/format";
import { element, setText } from "../../../panel/dom";
import type { Planner } from "../../planner";
import { say, text } from "../../text";
import { sinceBefore, sincePlan } from "../comparison";
import { histogramOf } from "../histogram";
import { verdicts } from "../verdicts";
import { chartOf } from "./chart";
import { LabelList } from "./label_list";
import { Legend, notesOf } from "./legend";
import { UnitList } from "./unit_list";

/** Between two changes while values come often, ms. */
const pause = 150;

export class LightPanel {
  private readonly phase = element("p", { class: "phase", role: "status" });
  private readonly bar = element("span", {});
  private readonly progress = element(
    "div",
    { class: "light-progress", role: "progressbar", "aria-valuemin": 0, "aria-valuemax": 100 },
    this.bar,
  );
  private readonly share = element("p", { class: "reached" });
  private readonly comparison = element("p", { class: "since" });
  private readonly notes = element("p", { class: "note" });
  private readonly legend: Legend;
  private readonly chart = element("div", {});
  private readonly labels: LabelList;
  private readonly units: UnitList;
  private readonly values: HTMLElement;
  private readonly unitSection: HTMLElement;
  readonly root: HTMLElement;

  private timer: ReturnType<typeof setTimeout> | undefined;
  private last = Number.NEGATIVE_INFINITY;
  /** Of the light that is shown. */
  private version = -1;

  /** `show`: moves the picture to a label or unit. */
  constructor(
    private readonly planner: Planner,
    show: (kind: "label" | "unit", index: number) => void,
  ) {
    this.progress.setAttribute("aria-label", text.light.progress);
    this.legend = new Legend(planner);
    this.labels = new LabelList(planner, (label) => show("label", label));
    this.units = new UnitList(planner, (unit) => show("unit", unit));
    this.values = element(
      "div",
      {},
      element("h3", { text: text.light.margins }),
      this.chart,
      element("h3", { text: text.light.weakest }),
      this.labels.root,
    );
    this.unitSection = element("div", {}, element("h3", { text: text.light.on_plan }), this.units.root);
    this.root = element(
      "div",
      { class: "scroll light" },
      this.phase,
      this.progress,
      this.share,
      this.comparison,
      this.notes,
      this.legend.root,
      this.values,
      this.unitSection,
    );
  }

  /** At once, or after a pause if values come often. */
  update(): void {
    clearTimeout(this.timer);
    const wait = this.last + pause - performance.now();
    if (wait <= 0) this.show();
    else this.timer = setTimeout(() => this.show(), wait);
  }

  /** A gesture may make the values old. */
  followGesture(): void {
    const { light } = this.planner;
    light.refresh();
    if (light.version !== this.version) this.update();
  }

  private show(): void {
    this.last = performance.now();
    const { light } = this.planner;
    light.refresh();
    this.version = light.version;
    const { field } = light;
    setText(this.phase, this.phaseText());
    this.showProgress();
    setText(this.share, field ? this.shareText() : "");
    setText(this.comparison, field ? this.comparisonText() : "");
    setText(this.notes, notesOf(this.planner).join(" "));
    this.legend.update();
    this.values.hidden = field === null;
    this.values.classList.toggle("stale", light.isStale);
    const histogram = field && histogramOf(field);
    this.chart.replaceChildren(...(histogram ? [chartOf(histogram, light.palette, light.isLeast)] : []));
    if (field) this.labels.update();
    this.unitSection.hidden = light.units.length === 0;
    this.units.update();
  }

  private phaseText(): string {
    const { light, document } = this.planner;
    const { event } = light;
    const phases = text.light.phases;
    if (!event) return phases.unknown;
    if (event.phase === "none") return document.labels.count === 0 ? phases.no_labels : phases.no_units;
    if (event.phase === "failed") return say(phases.failed, event.message ?? "");
    if (event.phase === "done") return event.undecided ? counted(phases.done_undecided, event.undecided) : phases.done;
    return phases[event.phase];
  }

  private showProgress(): void {
    const { phase, progress = null } = this.planner.light.event ?? {};
    const isBusy = phase === "preparing" || phase === "refining";
    this.progress.hidden = !isBusy || progress === null;
    if (progress === null) return;
    const done = Math.round(100 * progress);
    this.progress.setAttribute("aria-valuenow", String(done));
    this.bar.style.width = `${done}%`;
  }

  private shareText(): string {
    const { counts, verdict } = this.planner.light.verdicts;
    const of = (name: (typeof verdicts)[number]) => counts[verdicts.indexOf(name)];
    const all = verdict.length;
    // Rounded down: 100 % are all labels.
    const share = Math.floor((1000 * of("reached")) / all) / 1000;
    const words = say(text.light.reached, grouped(of("reached")), grouped(all), percent(share));
    return [
      words,
      counted(text.light.missed, of("missed")),
      ...(of("undecided") > 0 ? [counted(text.light.undecided, of("undecided"))] : []),
    ].join(" ");
  }

  /** Against the newest plan, or else against the state before the drag. */
  private comparisonText(): string {
    const { light } = this.planner;
    const { baseline } = light.event ?? {};
    const now = light.verdicts.verdict;
    const plan = baseline ? sincePlan(baseline.reached, now) : null;
    if (plan && baseline) return say(text.light.since_plan, baseline.plan, gainedText(plan.gained), String(plan.lost));
    if (!light.before || light.before.length !== now.length) return "";
    const drag = sinceBefore(light.before, now);
    return say(text.light.since_drag, gainedText(drag.gained), String(drag.lost));
  }
}

const gainedText = (gained: number): string => counted(text.light.gained, gained);
