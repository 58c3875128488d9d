// The tab about plans: the question, the plan that runs, the result, and all plans of the project.

import { button, element } from "../../panel/dom";
import type { Planner } from "../planner";
import { isObject } from "../document/json";
import { text } from "../text";
import { archiveOf } from "./archive";
import { PlanList } from "./list";
import { Question } from "./question";
import { Result } from "./result";
import { Running } from "./running";
import { Values } from "./values";
import { Variation } from "./variation";

export class PlanPanel {
  private readonly question = new Question();
  private readonly variation: Variation;
  private readonly values: Values;
  private readonly start: HTMLButtonElement;
  private readonly why = element("p", { class: "note", role: "status" });
  private readonly running: Running;
  private readonly result: Result;
  private readonly list: PlanList;
  readonly root: HTMLElement;

  /** `address`: of the page. */
  constructor(
    private readonly planner: Planner,
    address: string,
  ) {
    this.start = button(text.plans.start, () => this.begin(), {
      class: "primary",
      title: text.plans.start_says,
      "data-key": "plan-start",
    });
    this.variation = new Variation(planner);
    this.values = new Values(planner);
    this.running = new Running(planner);
    this.result = new Result(planner, address);
    this.list = new PlanList(planner, address);
    this.root = element(
      "div",
      { class: "scroll plans" },
      this.question.root,
      this.variation.root,
      this.start,
      this.why,
      this.values.root,
      this.running.root,
      this.result.root,
      this.list.root,
      archiveOf(planner, address),
    );
    this.root.addEventListener("change", () => this.update());
  }

  update(): void {
    this.question.update(this.varies);
    this.variation.update();
    this.values.update();
    const why = this.whyNot;
    this.start.disabled = why !== "";
    this.why.textContent = why;
    this.why.hidden = why === "";
    this.running.update();
    this.result.update();
    this.list.update();
  }

  private get varies(): boolean {
    const { json } = this.planner.document;
    return isObject(json) && json.variation !== undefined;
  }

  private get whyNot(): string {
    const { document } = this.planner;
    if (document.locked) return text.why_not.locked;
    if (document.labels.count === 0) return text.plans.why_not.no_labels;
    if (document.units.count === 0) return text.plans.why_not.no_candidates;
    if (document.problems.length > 0) return text.plans.why_not.problems;
    return this.question.isValid ? "" : text.plans.why_not.invalid;
  }

  private begin(): void {
    this.values.close();
    void this.planner.plans.start(this.question.request(this.varies), text.plans.start);
  }
}
