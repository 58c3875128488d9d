// The field at a line of the picture: its length, and whether the picture turns so that the line is straight.

import { button, element } from "../../panel/dom";
import { numberFrom, Unreadable } from "../form/parse";
import { between } from "../geometry/vector";
import type { Gestures } from "../gesture/gestures";
import type { Planner } from "../planner";
import { text } from "../text";
import type { Line } from "./drawing";
import { setCheck, setScale } from "./edits";
import { worldAt } from "./strokes";
import { isAskew } from "./transform";

const below = 16; // pixels

export class LengthField {
  readonly root = element("form", { class: "length-field", hidden: true, "aria-label": text.picture.length });
  private readonly input = element("input", {
    type: "text",
    id: "line-length",
    autocomplete: "off",
    spellcheck: "false",
    "aria-describedby": "line-length-why",
  });
  private readonly unit = element("span", { class: "unit" });
  private readonly why = element("p", { class: "why", role: "alert", id: "line-length-why", hidden: true });
  private readonly straight = element("input", { type: "checkbox" });
  private readonly straightRow = element("label", { class: "straight" }, this.straight, text.picture.straighten);
  private line: Pick<Line, "from" | "to"> | null = null;

  /** `done`: the field has closed, and the plan gets the focus. */
  constructor(
    private readonly planner: Planner,
    private readonly gestures: Gestures,
    private readonly done: () => void,
  ) {
    this.root.append(
      element("label", { for: "line-length", text: text.picture.length }),
      element("span", { class: "entry" }, this.input, this.unit),
      element("button", { type: "submit", text: text.picture.set }),
      button("×", () => this.gestures.cancel(), { class: "close", "aria-label": text.picture.cancel }),
      this.why,
      this.straightRow,
    );
    this.root.addEventListener("submit", (event) => {
      event.preventDefault();
      this.confirm();
    });
  }

  update(): void {
    const { scope } = this.gestures;
    const { planner, root } = this;
    const line = scope.kind === "scaling" && scope.from && scope.to ? { from: scope.from, to: scope.to } : null;
    if (line?.from !== this.line?.from || line?.to !== this.line?.to) this.open(line);
    if (!line) return;
    const { viewport } = planner;
    const [x, y] = viewport.toScreen(between(worldAt(planner, line.from), worldAt(planner, line.to)));
    const within = (at: number, least: number, most: number) => `${Math.min(Math.max(at, least), most)}px`;
    root.style.left = within(x - 0.5 * root.offsetWidth, 8, viewport.width - root.offsetWidth - 8);
    root.style.top = within(y + below, 8, viewport.height - root.offsetHeight - 8);
  }

  private open(line: Pick<Line, "from" | "to"> | null): void {
    const { planner, root } = this;
    const hadFocus = root.contains(document.activeElement);
    this.line = line;
    root.hidden = line === null;
    if (!line || !planner.drawing) {
      if (hadFocus) this.done();
      return;
    }
    this.straightRow.hidden = planner.tool !== "scale";
    this.straight.checked = isAskew(planner.drawing, line);
    this.unit.textContent = planner.document.unit.name;
    this.input.value = "";
    this.tell("");
    this.input.focus({ preventScroll: true });
  }

  private tell(why: string): void {
    this.why.textContent = why;
    this.why.hidden = why === "";
    this.input.ariaInvalid = String(why !== "");
  }

  private confirm(): void {
    const { planner, line } = this;
    if (!line) return;
    try {
      const length = numberFrom(this.input.value, "length", planner.document.unit);
      if (length <= 0) throw new Unreadable(text.picture.not_positive);
      if (planner.tool === "check") setCheck(planner, { ...line, length });
      else setScale(planner, { ...line, length }, this.straight.checked);
    } catch (error) {
      if (!(error instanceof Unreadable)) throw error;
      this.tell(error.message);
    }
  }
}
