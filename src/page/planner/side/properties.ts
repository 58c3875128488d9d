// The panel of the selection: elements, a copy, a label or unit, a type of the project, or the store itself.

import { button, element } from "../../panel/dom";
import { counted } from "../../data/format";
import { commandButton } from "../access/command_button";
import { drawingPath } from "../backdrop/drawing";
import { PicturePanel } from "../backdrop/panel";
import type { IconName } from "../access/icons";
import type { CommandId, Commands } from "../access/commands";
import { presetsFor } from "../actions/assign";
import { overrideOf } from "../actions/override";
import { EditBuilder } from "../document/edit";
import { isObject, splitPointer, valueAt, type Json, type JsonObject } from "../document/json";
import { withoutPlace } from "../document/messages";
import { ToolPanel } from "../draw/panel";
import { isDrawTool } from "../draw/tools";
import { contextOf } from "../elements/context";
import { kinds, type StoreElement } from "../elements/kinds";
import { nameOf, namesOf } from "../elements/names";
import type { Group } from "../form/field";
import type { TypeList } from "../elements/types";
import { Form, type FormContext } from "../form/form";
import { isTyping, nameFully } from "../form/inputs";
import { showProblems } from "../form/problems";
import { groupOfElement, groupOfStore } from "../form/schema";
import { pointerOfPath, type Target } from "../form/targets";
import type { Planner } from "../planner";
import { chosenUnits, stateWords } from "../units/chosen";
import { UnitPanel } from "../units/panel";
import { deviceFacts } from "./device_facts";
import { say, text } from "../text";
import type { Item, Place } from "../view/selection";
import { LabelLight } from "./label_light";
import { placeRows } from "./place";
import { ProfilePicture } from "./profile_picture";
import { basesFor, typeGroup } from "./type_group";
import { deleteType, duplicateType, nameField } from "./type_list";

/** More elements are shown without the values of their presets. */
const mostDetails = 60;

export class Properties {
  readonly root = element("aside", { class: "properties", "aria-label": text.properties.title, tabindex: -1 });
  private readonly unfolded = new Set<string>(["/labels", "/repeat"]);
  private isStale = false;
  /** What the form edits. */
  private targets: Target[] = [];
  /** The elements that it shows. */
  private shown: StoreElement[] = [];
  private readonly picture: PicturePanel;
  private readonly profile: ProfilePicture;
  private readonly light: LabelLight;
  private readonly units: UnitPanel;

  constructor(
    private readonly planner: Planner,
    private readonly commands: Commands,
  ) {
    this.picture = new PicturePanel(planner, commands);
    this.profile = new ProfilePicture(planner.document, planner.changes);
    this.light = new LabelLight(planner);
    planner.changes.listen(["light"], () => this.light.update());
    this.units = new UnitPanel(planner, commands);
    nameFully(this.root);
    this.root.addEventListener("focusout", () => {
      if (this.isStale) setTimeout(() => this.update());
    });
    planner.follow((place) => {
      for (const list of [this.targets, this.shown]) follow(list, place);
    });
  }

  /** Builds the panel again; a field that is being typed in stays until it is left. */
  update(): void {
    const focused = document.activeElement;
    const isInside = focused instanceof HTMLElement && this.root.contains(focused);
    this.isStale = isInside && isTyping(focused);
    if (this.isStale) {
      for (const target of this.targets) this.refresh(target);
      showProblems(this.root, this.problemsOf(this.targets));
      return;
    }
    const key = isInside ? focused.dataset.key : undefined;
    const { scrollTop } = this.root;
    this.targets = [];
    this.shown = [];
    this.root.replaceChildren(...this.content());
    showProblems(this.root, this.problemsOf(this.targets));
    this.root.scrollTop = scrollTop;
    if (key === undefined) return;
    const again = this.root.querySelector<HTMLElement>(`[data-key="${CSS.escape(key)}"]`);
    (again ?? this.root).focus({ preventScroll: true });
    if (again instanceof HTMLInputElement && again.type === "text") again.select();
  }

  /** Unfolds a field of the elements, or a group of fields, and goes to its first control. */
  focusOn(pointer: string): void {
    this.unfolded.add(pointer);
    this.update();
    const field = this.root.querySelector(`[data-field="${CSS.escape(pointer)}"]`);
    const controls = field?.querySelectorAll<HTMLElement>("input, select, button") ?? [];
    const control = [...controls].find((one) => one.checkVisibility());
    control?.focus();
    if (control instanceof HTMLInputElement) control.select();
  }

  /** A typed component of a place leaves the others as another tab made them. */
  private refresh(target: Target): void {
    const { document } = this.planner;
    const context = contextOf(document, target.path);
    const own = context?.value ?? valueAt(document.json, target.path);
    if (isObject(own)) Object.assign(target, { own, effective: context?.effective ?? own });
  }

  private content(): Node[] {
    const { selection, typePath, document, tool } = this.planner;
    if (!document.isReady) return [];
    const elements = this.planner.selected;
    const ofTool = isDrawTool(tool) ? new ToolPanel(this.planner).content(tool) : [];
    // Candidates may be selected together with entries of the list.
    const item = selection.items.find(({ kind }) => kind !== "element");
    const hasOthers = item !== undefined && chosenUnits(this.planner).length > 0;
    if (elements.length > 0 && !hasOthers) return [...ofTool, ...this.elements(elements)];
    if (ofTool.length > 0) return ofTool;
    if (item?.kind === "copy") return this.copy(item);
    if (item?.kind === "device") return this.labelOrUnit(item);
    const { drawing } = this.planner;
    if (typePath === drawingPath && drawing) return this.picture.content(drawing);
    const value = typePath === null ? undefined : valueAt(document.json, typePath);
    if (typePath !== null && isObject(value)) return this.type(typePath, value);
    return this.store();
  }

  private header(title: string, subtitle: string, ...more: (Node | null)[]): HTMLElement {
    return element(
      "header",
      {},
      element("h2", { text: title }),
      element("p", { class: "subtitle", text: subtitle }),
      ...more,
    );
  }

  private tools(...ids: [CommandId, IconName][]): HTMLElement {
    const buttons = ids
      .filter(([id]) => this.commands.isEnabled(id))
      .map(([id, name]) => commandButton(this.commands, id, name));
    return element("div", { class: "tools" }, ...buttons);
  }

  private form(
    targets: Target[],
    groups: readonly Group[],
    name: string,
    { override, ...around }: Partial<FormContext["around"] & Pick<FormContext, "override">> = {},
  ): HTMLElement {
    const { document } = this.planner;
    this.targets = targets;
    const context: FormContext = {
      targets,
      around: { json: document.json, shared: document.shared, unit: document.unit, part: null, ...around },
      isDisabled: document.locked !== null,
      problems: this.problemsOf(targets),
      unfolded: this.unfolded,
      write: (what, write) => {
        const builder = new EditBuilder(document.json);
        for (const target of targets) write(builder, target);
        void document.edit({ label: say(text.edits.change, what, name), ops: builder.ops });
      },
      override,
    };
    return element("section", { class: "form" }, ...new Form(context).elementRows(groups));
  }

  /** By the pointer relative to the element; "" for those of the element as a whole. */
  private problemsOf(targets: readonly Target[]): Map<string, string> {
    const found = new Map<string, string>();
    const add = (at: string, sentence: string) => {
      const before = found.get(at);
      found.set(at, before === undefined ? sentence : `${sentence}\n${before}`);
    };
    const { problems, warnings, file } = this.planner.document;
    for (const problem of [...warnings, ...problems])
      for (const target of targets) {
        const full = pointerOfPath(problem.path);
        const sentence = withoutPlace(problem, file);
        if (full.startsWith(`${target.path}/`)) add(full.slice(target.path.length), sentence);
        else if (full === target.path || (problem.pointer === target.path && target.path !== "")) add("", sentence);
      }
    return found;
  }

  private elements(elements: StoreElement[]): Node[] {
    const { document } = this.planner;
    this.shown = elements;
    const contexts = elements.flatMap(({ path }) => contextOf(document, path) ?? []);
    const targets = contexts.map(
      ({ path, kind, value, effective }): Target => ({
        path,
        own: value,
        effective,
        details: kind === "fixture" && contexts.length <= mostDetails ? document.details.now(path) : null,
      }),
    );
    const groups = contexts.flatMap(
      ({ kind, effective, parts }) => groupOfElement(kind, String(effective.type ?? parts[0]?.type ?? "")) ?? [],
    );
    const [first] = contexts;
    const single = contexts.length === 1 ? first : null;
    const type = single ? (single.effective.type ?? single.parts[0]?.type) : undefined;
    const subtitle = single ? this.subtitleOf(single, type) : text.properties.several;
    const name = namesOf(elements);
    const hasPlace = single ? single.effective.at === undefined && single.effective.position === undefined : true;
    const isDisabled = document.locked !== null;
    const hasPreset = targets.some(({ own }) => own.preset !== undefined);
    return [
      this.header(
        single ? nameOf(single) : name,
        subtitle,
        this.kindChips(),
        this.tools(
          ["rotate", "turn"],
          ["unit_turn", "turn"],
          ["mirror_x", "mirror_x"],
          ["mirror_y", "mirror_y"],
          ["duplicate", "duplicate"],
          ["fit_selection", "show"],
          ["delete", "delete"],
          ["unit_remove", "delete"],
        ),
        contexts.length > 1
          ? this.tools(
              ["align_left", "align_left"],
              ["align_centre", "align_centre"],
              ["align_right", "align_right"],
              ["align_top", "align_top"],
              ["align_middle", "align_middle"],
              ["align_bottom", "align_bottom"],
              ["distribute_x", "distribute_x"],
              ["distribute_y", "distribute_y"],
            )
          : null,
      ),
      ...this.units.content(),
      ...this.light.content(),
      ...[hasPlace ? placeRows(this.planner, elements, isDisabled) : null].filter((row) => row !== null),
      ...(groups.length === contexts.length
        ? [
            this.form(targets, groups, name, {
              part: first.parts[0] ?? null,
              ...(elements.every(({ kind }) => kind === "fixture") && {
                override: overrideOf(this.planner, elements, single),
                presets: presetsFor(this.planner, elements),
              }),
            }),
          ]
        : []),
      ...(hasPreset ? [element("p", { class: "note", text: text.properties.grey })] : []),
      // At the end, because warnings come later than the fields, and must not move them.
      element("div", { class: "whole", "data-field": "" }),
    ];
  }

  private subtitleOf({ kind, path }: StoreElement, type: Json | undefined): string {
    const { units } = this.planner.document;
    const unit = kind === "unit" ? units.withPath(path) : undefined;
    if (unit !== undefined) return stateWords(units, unit);
    return kind === "fixture" ? optionText(type) : kind === "room" ? "" : text.kinds[kind];
  }

  /** For a selection of several kinds: a click keeps one of them. */
  private kindChips(): HTMLElement | null {
    const { selected, selection } = this.planner;
    const found = kinds.flatMap((kind) => {
      const paths = selected.filter((one) => one.kind === kind).map(({ path }) => path);
      return paths.length > 0 ? [{ kind, paths }] : [];
    });
    if (found.length < 2) return null;
    return element(
      "div",
      { class: "chips" },
      ...found.map(({ kind, paths }) =>
        button(counted(text.counted[kind], paths.length), () => selection.setPaths(paths), {
          class: "chip",
          title: text.properties.keep_kind,
          "data-key": `chip-${kind}`,
        }),
      ),
    );
  }

  private copy(item: Extract<Item, { kind: "copy" }>): Node[] {
    const [part] = this.planner.partsOf(item);
    if (!part) return [];
    const why = part.locked === "repeat" ? text.properties.of_row : text.properties.of_file;
    return [
      this.header(part.id || text.kinds[part.kind], optionText(part.type), this.tools(["fit_selection", "show"])),
      element("p", { class: "locked", text: why }),
      this.commandButtons("edit_source", "dissolve"),
    ];
  }

  /** Of the commands that are enabled. */
  private commandButtons(...ids: CommandId[]): HTMLElement {
    const made = ids
      .filter((id) => this.commands.isEnabled(id))
      .map((id) => button(text.commands[id], () => this.commands.run(id), { "data-key": id }));
    return element("div", { class: "buttons" }, ...made);
  }

  private labelOrUnit(item: Extract<Item, { kind: "device" }>): Node[] {
    const { selection, document } = this.planner;
    const units = this.units.content();
    const tools = this.tools(["unit_turn", "turn"], ["fit_selection", "show"], ["unit_remove", "delete"]);
    if (units.length > 0 && selection.items.length > 1)
      return [this.header(counted(text.counted.units, selection.items.length), "", tools), ...units];
    const answer = this.planner.answers.now(item.device, item.index);
    const isUnit = item.device === "unit";
    const kind = isUnit ? stateWords(document.units, item.index) : text.kinds.label;
    return [
      this.header(answer?.id ?? "…", kind, units.length > 0 ? tools : null),
      ...units,
      listOf(answer ? deviceFacts(answer, document.unit, !isUnit || item.path === null) : []),
      ...this.light.content(),
      element("p", { class: "locked", text: text.properties[sourceOf(item)] }),
      this.commandButtons("edit_source", "dissolve"),
    ];
  }

  private type(path: string, value: JsonObject): Node[] {
    const [list, name] = splitPointer(path);
    const kind = list.slice(1) as TypeList;
    const group = typeGroup(this.planner.document.json, kind, value);
    const actions = element(
      "div",
      { class: "buttons" },
      button(text.types.duplicate, () => duplicateType(this.planner, path), { "data-key": "duplicate-type" }),
      button(text.types.delete, () => deleteType(this.planner, path), { "data-key": "delete-type" }),
      button(text.types.close, () => this.planner.openType(null), { "data-key": "close-type" }),
    );
    const target: Target = { path, own: value, effective: value, details: null };
    return [
      this.header(name, text.types.singular[kind], actions, nameField(this.planner, path)),
      element("div", { class: "whole", "data-field": "" }),
      ...(kind === "transceiver_types" ? this.profile.content(value) : []),
      ...(group ? [this.form([target], [group], name, { presets: basesFor(this.planner, name, value) })] : []),
    ];
  }

  private store(): Node[] {
    const { document, selection, drawing } = this.planner;
    const json = isObject(document.json) ? document.json : {};
    const target: Target = { path: "", own: json, effective: json, details: null };
    const facts: [string, string][] = [
      [text.properties.folder, document.name],
      [text.properties.file, document.file],
      [text.properties.unit, document.unit.name],
      [text.properties.version, document.version],
      [text.layers.names.label, String(document.labels.count)],
      [text.layers.names.unit, String(document.units.count)],
    ];
    return [
      this.header(this.planner.title, text.properties.store),
      this.form([target], [groupOfStore()], text.properties.store),
      listOf(facts),
      json.room === undefined
        ? element("p", { class: "note", text: text.properties.no_room })
        : element(
            "div",
            { class: "buttons" },
            button(text.properties.room, () => selection.setPaths(["/room"]), { "data-key": "room" }),
          ),
      this.commandButtons(drawing ? "picture" : "choose_picture", "choose_table", "choose_file"),
      element("p", { class: "note", text: text.properties.hint }),
    ];
  }
}

/** Fields write to the elements for which they were made, wherever these are by then. */
function follow(list: { path: string }[], place: Place): void {
  const moved = list.flatMap((one) => {
    const path = place(one.path);
    return path === null ? [] : [Object.assign(one, { path })];
  });
  list.splice(0, list.length, ...moved);
}

const sourceOf = ({ path, device }: Extract<Item, { kind: "device" }>) =>
  path === null ? "of_file" : device === "unit" ? "of_candidates" : "of_element";

const listOf = (facts: readonly [string, string][]): HTMLElement =>
  element("dl", {}, ...facts.flatMap(([term, fact]) => [element("dt", { text: term }), element("dd", { text: fact })]));

function optionText(type: Json | undefined): string {
  return (text.options as Record<string, string>)[String(type)] ?? String(type ?? text.kinds.fixture);
}
