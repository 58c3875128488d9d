// The plan that runs: how far it is, and between which numbers its answer lies.

import { button, element, setText } from "../../panel/dom";
import type { PlanRun } from "../document/messages";
import type { Planner } from "../planner";
import { say, text } from "../text";
import { boundsText, duration, phaseText, questionText, summaryOf } from "./sentences";

export class Running {
  private readonly name = element("h3", {});
  private readonly asked = element("p", { class: "note" });
  private readonly phase = element("p", { class: "phase", role: "status" });
  private readonly bar = element("span", {});
  private readonly progress = element(
    "div",
    {
      class: "light-progress",
      role: "progressbar",
      "aria-valuemin": 0,
      "aria-valuemax": 100,
      "aria-label": text.plans.progress,
    },
    this.bar,
  );
  private readonly time = element("p", { class: "note" });
  private readonly bounds = element("p", { class: "reached" });
  private readonly first = element("p", { class: "since" });
  private readonly end: HTMLButtonElement;
  readonly root: HTMLElement;

  constructor(private readonly planner: Planner) {
    this.end = button(text.plans.cancel, () => this.cancel(), {
      title: text.plans.cancel_says,
      "data-key": "plan-cancel",
    });
    const { name, asked, phase, progress, time, bounds, first, end } = this;
    this.root = element(
      "section",
      { class: "plan-running", hidden: true },
      name,
      asked,
      phase,
      progress,
      time,
      bounds,
      first,
      end,
    );
  }

  update(): void {
    const run = this.planner.plans.active;
    this.root.hidden = run === null;
    if (run) this.show(run);
  }

  private show(run: PlanRun): void {
    const { share = null, seconds_left: left = null } = run.progress ?? {};
    setText(this.name, run.folder);
    setText(this.asked, questionText(run.plan));
    setText(this.phase, run.cancelled ? text.plans.ending : phaseText(run));
    this.end.disabled = run.cancelled;
    const done = share === null ? null : Math.round(100 * share);
    this.progress.classList.toggle("unknown", done === null);
    if (done === null) this.progress.removeAttribute("aria-valuenow");
    else this.progress.setAttribute("aria-valuenow", String(done));
    this.bar.style.width = done === null ? "" : `${done}%`;
    setText(this.time, left === null ? "" : say(text.plans.left, duration(left)));
    setText(this.bounds, boundsText(run));
    setText(this.first, run.first ? say(text.plans.first, summaryOf(run.first)) : "");
  }

  private cancel(): void {
    const { plans } = this.planner;
    const run = plans.active;
    if (!run) return;
    this.end.disabled = true;
    void plans.cancel(run, text.plans.cancel);
  }
}
