// Everything that the planner does by a key, a menu or the list of commands.

import type { text } from "../text";

export type CommandId = keyof typeof text.commands;
export type CommandGroup = keyof typeof text.groups;

export interface Command {
  id: CommandId;
  group: CommandGroup;
  /** Commands that differ by their key alone. */
  family?: keyof typeof text.families;
  keys: string[];
  /**
   * Where its keys work: in the plan, where no field has the focus, or everywhere. Keys of the plan have other meanings in
   * lists.
   */
  where: "plan" | "page" | "everywhere";
  run: () => void;
  isEnabled?: () => boolean;
  /** Why it is not enabled, and what to do instead; null: another command of its key is meant. */
  why?: () => string | null;
  /** Of commands that switch something. */
  isOn?: () => boolean;
}

export class Commands {
  private readonly byId = new Map<CommandId, Command>();
  private readonly byKey = new Map<string, Command[]>();
  /** Why the tool whose key was pressed last did not begin: digits after it were meant for it. */
  private refusedTool: string | null = null;
  /** Somebody presses the key of a command that is not enabled. */
  onRefused: (why: string) => void = () => {};

  add(commands: readonly Command[]): void {
    for (const command of commands) {
      this.byId.set(command.id, command);
      for (const key of command.keys) this.byKey.set(key, [...(this.byKey.get(key) ?? []), command]);
    }
  }

  get all(): Command[] {
    return [...this.byId.values()];
  }

  get(id: CommandId): Command {
    const found = this.byId.get(id);
    if (!found) throw new Error(id);
    return found;
  }

  isEnabled(id: CommandId): boolean {
    return this.get(id).isEnabled?.() ?? true;
  }

  run(id: CommandId): void {
    if (this.isEnabled(id)) this.get(id).run();
  }

  /** A click begins something else. */
  forgetRefusal(): void {
    this.refusedTool = null;
  }

  /** Runs the command of a key; false if there is none here. `isBusy`: only the view may change. */
  press(chord: string, place: { inField: boolean; inPlan: boolean; isBusy: boolean }): boolean {
    const here = (this.byKey.get(chord) ?? []).filter(
      ({ where }) => where === "everywhere" || (!place.inField && (where === "page" || place.inPlan)),
    );
    if (this.refusedTool !== null && !place.inField && /^\d$/.test(chord)) {
      this.onRefused(this.refusedTool);
      return true;
    }
    this.refusedTool = null;
    if (place.isBusy && here.every(({ group }) => group !== "view")) return here.length > 0;
    for (const { group, isEnabled, why, run } of here) {
      if (isEnabled?.() ?? true) {
        run();
        break;
      }
      const reason = why?.() ?? null;
      if (reason === null) continue;
      this.onRefused(reason);
      if (group === "draw") this.refusedTool = reason;
      break;
    }
    return here.length > 0;
  }
}
