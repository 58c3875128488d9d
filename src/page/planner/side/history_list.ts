// The steps of the history, each with a click to go there.

import { button, element, replaceChildren } from "../../panel/dom";
import type { Planner } from "../planner";
import { text } from "../text";

/** Long histories show their last steps. */
const mostSteps = 500;

export class HistoryList {
  private readonly list = element("ol", { class: "history", "aria-label": text.history.title });
  readonly root = element(
    "div",
    { class: "scroll" },
    element("p", { class: "note", text: text.history.lead }),
    this.list,
  );

  constructor(private readonly planner: Planner) {}

  update(): void {
    const { steps, position } = this.planner.document.history;
    const first = Math.max(steps.length - mostSteps, 0);
    const rows = steps
      .slice(first)
      .map(({ label, time }, k) => this.row(label, timeText(time), first + k + 1, position));
    replaceChildren(
      this.list,
      [...(first === 0 ? [this.row(text.history.opened, "", 0, position)] : []), ...rows].reverse(),
    );
  }

  private row(label: string, time: string, index: number, position: number): HTMLElement {
    const go = button(label, () => void this.planner.document.go(index), {
      class: "plain",
      "aria-current": index === position ? "step" : undefined,
      "data-key": `step${index}`,
    });
    return element("li", { class: index > position ? "undone" : "" }, go, element("small", { text: time }));
  }
}

export function timeText(time: string | undefined): string {
  const at = time === undefined ? Number.NaN : Date.parse(time);
  return Number.isNaN(at)
    ? ""
    : new Date(at).toLocaleString([], {
        ...(new Date(at).toDateString() === new Date().toDateString() ? {} : { day: "numeric", month: "short" }),
        hour: "2-digit",
        minute: "2-digit",
        hourCycle: "h23",
      });
}
