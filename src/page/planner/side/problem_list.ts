// Problems and warnings of the store, each with the way to its element.

import { button, element, replaceChildren } from "../../panel/dom";
import { withoutPlace, type Problem } from "../document/messages";
import { elementAround } from "../elements/kinds";
import { showSelection } from "../actions/source";
import { pointerOfPath } from "../form/targets";
import type { Planner } from "../planner";
import { text } from "../text";

export class ProblemList {
  private readonly list = element("div", {});
  readonly root = element("div", { class: "scroll problem-list" }, this.list);

  constructor(private readonly planner: Planner) {}

  update(): void {
    const { problems, warnings } = this.planner.document;
    const section = (kind: "wrong" | "doubtful", found: readonly Problem[]) =>
      found.length === 0
        ? []
        : [
            element("h3", { text: text.problems.titles[kind] }),
            element("ul", {}, ...found.map((problem, k) => this.row(kind, problem, k))),
          ];
    const sections = [...section("wrong", problems), ...section("doubtful", warnings)];
    replaceChildren(
      this.list,
      sections.length > 0 ? sections : [element("p", { class: "note", text: text.problems.none })],
    );
  }

  private row(kind: "wrong" | "doubtful", problem: Problem, index: number): HTMLElement {
    const place = button("", () => goTo(this.planner, problem), { class: "plain", "data-key": `${kind}${index}` });
    const sentence = withoutPlace(problem, this.planner.document.file);
    place.append(element("code", { text: problem.path }), element("span", { text: sentence }));
    return element("li", { class: kind }, place);
  }
}

/** Selects the element of a problem and shows it. */
function goTo(planner: Planner, { pointer, path }: Problem): void {
  const place = pointer || pointerOfPath(path);
  const found = elementAround(place);
  if (found) {
    planner.selection.setPaths([found]);
    if (planner.isPlan && planner.selectionBounds) showSelection(planner);
    return;
  }
  const type = /^\/(presets|materials|label_types|transceiver_types)\/[^/]+/.exec(place);
  planner.openType(type ? type[0] : null);
}
