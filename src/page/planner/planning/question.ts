// The form that asks for a plan.

import { Choice, element } from "../../panel/dom";
import type { PlanRequest } from "../document/messages";
import { text } from "../text";
import { CheckBox, NumberField } from "./fields";

type Goal = "all" | "share" | "at_most";

export class Question {
  private goal: Goal = "all";
  private readonly goals: Choice<Goal>;
  private readonly share = new NumberField(text.plans.question.share, "%", { least: 1, most: 100 });
  private readonly units = new NumberField(text.plans.question.at_most, "", { least: 1, most: 100000, step: 1 });
  private readonly failure = new CheckBox(text.plans.question.failure, text.plans.question.failure_says);
  private readonly changing = new CheckBox(text.plans.question.changing, text.plans.question.changing_says);
  private readonly alone = new CheckBox(text.plans.question.alone, text.plans.question.alone_says);
  private readonly spacing = new NumberField(text.plans.question.spacing, "m", { least: 0, most: 1000 }, "0");
  private readonly confidence = new NumberField(
    text.plans.question.confidence,
    "%",
    { least: 50, most: 99.9999 },
    "99",
  );
  private readonly search = new NumberField(text.plans.question.search, "s", { least: 1, most: 1e6 }, "60");
  private readonly budget = new NumberField(text.plans.question.budget, "s", { least: 1, most: 1e6 }, "600");
  readonly root: HTMLElement;

  constructor() {
    this.goals = new Choice<Goal>(
      "plan-goal",
      text.plans.question.reach,
      [
        ["all", text.plans.question.all],
        ["share", text.plans.question.part],
        ["at_most", text.plans.question.few],
      ],
      (goal) => this.choose(goal),
    );
    this.share.input.required = this.units.input.required = true;
    this.share.input.value = "95";
    this.units.input.value = "8";
    this.changing.input.checked = true;
    this.root = element(
      "div",
      { class: "plan-question" },
      this.goals.root,
      this.share.root,
      this.units.root,
      this.failure.root,
      this.changing.root,
      element(
        "details",
        {},
        element("summary", { text: text.plans.question.more }),
        this.alone.root,
        this.spacing.root,
        this.confidence.root,
        this.search.root,
        this.budget.root,
      ),
    );
    this.choose("all");
  }

  private choose(goal: Goal): void {
    this.goal = goal;
    this.goals.show(goal);
    this.share.root.hidden = goal !== "share";
    this.units.root.hidden = goal !== "at_most";
  }

  /** `varies`: the store describes how the shop changes. A plan for a part of the labels is for the shop as drawn. */
  update(varies: boolean): void {
    this.changing.root.hidden = !varies || this.goal !== "all";
  }

  get isValid(): boolean {
    return [...this.root.querySelectorAll("input")].every((input) => input.validity.valid || input.closest("[hidden]"));
  }

  /** The request, in which undefined members are the defaults of the program; `varies` as above. */
  request(varies: boolean): PlanRequest {
    const { goal } = this;
    const share = this.share.value;
    const confidence = this.confidence.value;
    const isFixed = varies && (goal !== "all" || !this.changing.isOn);
    return {
      problem: {
        ...(this.failure.isOn ? { survives_failure: true } : {}),
        ...(this.alone.isOn ? { model: "non-cooperative" as const } : {}),
      },
      place: { time_limit: this.search.value },
      constraints: { min_spacing: this.spacing.value },
      confidence: confidence === undefined ? undefined : confidence / 100,
      budget: this.budget.value,
      at_most: goal === "at_most" ? this.units.value : undefined,
      reach: goal === "share" && share !== undefined ? share / 100 : undefined,
      states: isFixed ? 0 : undefined,
    };
  }
}
