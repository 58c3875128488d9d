// The form that asks for a plan.

import { Choice, element } from "../../panel/dom";
import type { PlanRequest } from "../document/messages";
import { text } from "../text";

type Goal = "all" | "share" | "at_most";

interface Bounds {
  least: number;
  most: number;
  step: number | "any";
}

/** A number with its name and unit; empty: the default of the program. */
class NumberField {
  readonly input: HTMLInputElement;
  readonly root: HTMLElement;

  constructor(name: string, unit: string, { least, most, step }: Bounds, value: number | null, usual = "") {
    this.input = element("input", { type: "number", min: least, max: most, step, placeholder: usual });
    if (value !== null) this.input.value = String(value);
    this.root = element(
      "label",
      { class: "row" },
      element("span", { text: name }),
      this.input,
      element("small", { text: unit }),
    );
  }

  /** Undefined: none, or one that does not fit. */
  get value(): number | undefined {
    const { value, validity } = this.input;
    return value === "" || !validity.valid ? undefined : Number(value);
  }
}

class CheckBox {
  readonly input = element("input", { type: "checkbox" });
  readonly root: HTMLElement;

  constructor(name: string, says = "") {
    this.root = element("label", { class: "check", title: says }, this.input, element("span", { text: name }));
  }

  get isOn(): boolean {
    return this.input.checked;
  }
}

export class Question {
  private goal: Goal = "all";
  private readonly goals: Choice<Goal>;
  private readonly share = new NumberField(text.plans.question.share, "%", { least: 1, most: 100, step: "any" }, 95);
  private readonly units = new NumberField(text.plans.question.at_most, "", { least: 1, most: 100000, step: 1 }, 8);
  private readonly failure = new CheckBox(text.plans.question.failure, text.plans.question.failure_says);
  private readonly changing = new CheckBox(text.plans.question.changing, text.plans.question.changing_says);
  private readonly alone = new CheckBox(text.plans.question.alone, text.plans.question.alone_says);
  private readonly spacing = new NumberField(
    text.plans.question.spacing,
    "m",
    { least: 0, most: 1000, step: "any" },
    null,
    "0",
  );
  private readonly confidence = new NumberField(
    text.plans.question.confidence,
    "%",
    { least: 50, most: 99.9999, step: "any" },
    null,
    "99",
  );
  private readonly search = new NumberField(
    text.plans.question.search,
    "s",
    { least: 1, most: 1e6, step: "any" },
    null,
    "60",
  );
  private readonly budget = new NumberField(
    text.plans.question.budget,
    "s",
    { least: 1, most: 1e6, step: "any" },
    null,
    "600",
  );
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

  /** The request; `varies` as above. */
  request(varies: boolean): PlanRequest {
    const { goal } = this;
    const share = this.share.value;
    const confidence = this.confidence.value;
    const isFixed = varies && (goal !== "all" || !this.changing.isOn);
    const request: PlanRequest = {
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
    return JSON.parse(JSON.stringify(request)) as PlanRequest; // without what is undefined
  }
}
