// The bar above the plan: project, tools, steps, view, and whether everything is saved.

import { button, element } from "../../panel/dom";
import { counted } from "../../data/format";
import { commandButton } from "../access/command_button";
import { icon, type IconName } from "../access/icons";
import type { CommandId, Commands } from "../access/commands";
import type { Planner } from "../planner";
import { say, text } from "../text";

const tools: [CommandId, IconName][] = [
  ["select", "select"],
  ["measure", "measure"],
  ["scale", "scale"],
];
const drawing: [CommandId, IconName][] = [
  ["draw_room", "room"],
  ["draw_wall", "wall"],
  ["draw_opening", "opening"],
  ["draw_run", "run"],
  ["draw_rows", "rows"],
  ["draw_block", "block"],
  ["draw_zone", "zone"],
  ["draw_keep_out", "keep_out"],
  ["draw_area", "area"],
  ["draw_unit", "unit"],
  ["draw_rail", "rail"],
  ["draw_faces", "faces"],
];
const steps: [CommandId, IconName][] = [
  ["undo", "undo"],
  ["redo", "redo"],
];
const views: [CommandId, IconName][] = [
  ["fit", "fit"],
  ["find", "find"],
  ["commands", "command"],
  ["shortcuts", "help"],
];

export class Toolbar {
  private readonly name = element("h1", {});
  private readonly saving = element("p", { class: "saving", role: "status" });
  private readonly buttons = new Map<CommandId, HTMLButtonElement>();
  private readonly space = button("", () => this.commands.run("space"), { class: "wide" });
  readonly root: HTMLElement;

  constructor(
    private readonly planner: Planner,
    private readonly commands: Commands,
  ) {
    const group = (entries: [CommandId, IconName][], name: string) =>
      element(
        "div",
        { class: "group", role: "group", "aria-label": name },
        ...entries.map(([id, image]) => this.button(id, image)),
      );
    this.root = element(
      "header",
      { class: "toolbar" },
      this.name,
      group(tools, text.groups.tools),
      group(drawing, text.groups.draw),
      group(steps, text.groups.edit),
      element("div", { class: "group", role: "group", "aria-label": text.groups.view }, this.space),
      element("span", { class: "gap" }),
      group(views, text.groups.help),
      this.saving,
    );
  }

  private button(id: CommandId, image: IconName): HTMLButtonElement {
    const made = commandButton(this.commands, id, image);
    this.buttons.set(id, made);
    return made;
  }

  update(): void {
    const { isPlan, title } = this.planner;
    this.name.textContent = title;
    document.title = say(text.access.page_title, title);
    for (const [id, made] of this.buttons) {
      made.disabled = !this.commands.isEnabled(id);
      const isOn = this.commands.get(id).isOn?.();
      if (isOn !== undefined) made.setAttribute("aria-pressed", String(isOn));
    }
    this.space.replaceChildren(icon(isPlan ? "cube" : "plan"), isPlan ? text.view.space : text.view.plan);
    this.space.title = say(text.access.with_key, text.commands.space, "D");
    this.showSaving();
  }

  private showSaving(): void {
    const { saving, locked, isReady } = this.planner.document;
    const words = !isReady
      ? text.saving.loading
      : locked
        ? text.saving.locked
        : saving.state === "lost"
          ? saving.edits > 0
            ? counted(text.saving.lost_edits, saving.edits)
            : text.saving.lost
          : text.saving[saving.state];
    if (this.saving.textContent !== words) this.saving.textContent = words;
    this.saving.dataset.state = locked ? "locked" : saving.state;
  }
}
