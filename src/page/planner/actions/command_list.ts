// The commands of the planner.

import type { Command } from "../access/commands";
import { alignments } from "../elements/arrange";
import { countField } from "../draw/panel";
import { drawTools, isDrawTool, type DrawTool } from "../draw/tools";
import type { Gestures } from "../gesture/gestures";
import type { Planner } from "../planner";
import { text } from "../text";
import { say } from "../../data/text";
import { drawingPath } from "../backdrop/drawing";
import { editDrawing, turnPicture } from "../backdrop/edits";
import { chosenUnits } from "../units/chosen";
import { unitCommands } from "../units/commands";
import { assignType, canAssign } from "./assign";
import { canTake, outlineUses, takeOutlines } from "./outlines";
import { canNumber, numberFixtures } from "./rename";
import { copySelection, deleteSelection, duplicateSelection, paste } from "./copy";
import { alignSelection, distributeSelection, mirrorSelection, shiftElements, turnElements } from "./move";
import { canDissolve, dissolve, nextItem, selectAll, selectSource, showAll, showSelection } from "./source";
import { whyNoCopy, whyNot } from "./why_not";

/** What other parts of the page do for commands. */
export interface Surroundings {
  planner: Planner;
  gestures: Gestures;
  find: () => void;
  openCommands: () => void;
  openShortcuts: () => void;
  openMenu: () => void;
  focusNext: () => void;
  turnSpace: (right: number, up: number) => boolean;
  zoom: (factor: number) => void;
  fit: () => void;
  choosePicture: () => void;
  chooseTable: () => void;
  chooseFile: () => void;
  showField: (pointer: string) => void;
}

const command = (
  group: Command["group"],
  id: Command["id"],
  keys: string[],
  run: () => void,
  more: Partial<Command> = {},
): Command => ({ id, group, keys, where: "page", run, ...more });

function editCommands({ planner, gestures, showField }: Surroundings): Command[] {
  const { document } = planner;
  const some = () => whyNot(planner) === null;
  const why = () => whyNoCopy(planner);
  const copyable = () => some() && planner.selected.some(({ kind }) => kind !== "room");
  const several = () => planner.selected.length > 1 && document.locked === null;
  const many = () => planner.selected.length > 2 && document.locked === null;
  const isCopy = () => planner.selection.items.some(({ kind, path }) => kind !== "element" && path !== null);
  const areUnits = () => chosenUnits(planner).length > 0;
  const turn = (degrees: number) => void turnElements(planner, planner.selected, degrees);
  const step = async (what: "undo" | "redo") => {
    if (!(await document[what]())) return;
    const { steps, position } = document.history; // the answer follows the change
    planner.say(say(text.notices[what], steps[what === "undo" ? position : position - 1]?.label ?? ""));
  };
  return [
    command(
      "edit",
      "undo",
      ["Ctrl+Z"],
      () => {
        if (!gestures.cancel()) void step("undo");
      },
      { isEnabled: () => gestures.scope.kind !== "idle" || document.canUndo },
    ),
    command("edit", "redo", ["Ctrl+Y", "Ctrl+Shift+Z"], () => void step("redo"), { isEnabled: () => document.canRedo }),
    command("edit", "cut", ["Ctrl+X"], () => copySelection(planner) && void deleteSelection(planner), {
      isEnabled: copyable,
      why,
    }),
    command("edit", "copy", ["Ctrl+C"], () => void copySelection(planner), {
      isEnabled: () => planner.selected.some(({ kind }) => kind !== "room"),
    }),
    command("edit", "paste", ["Ctrl+V"], () => void paste(planner, planner.pointer), {
      isEnabled: () => planner.clip.copied.length > 0,
    }),
    command("edit", "duplicate", ["Ctrl+D"], () => void duplicateSelection(planner), { isEnabled: copyable, why }),
    // While something is drawn, Backspace takes corners back. Units have commands of their own with this key.
    command("edit", "delete", ["Delete", "Backspace"], () => void deleteSelection(planner), {
      isEnabled: () => copyable() && !isDrawTool(planner.tool) && !areUnits(),
      why: () => (isDrawTool(planner.tool) ? null : why()),
    }),
    command("edit", "edit_source", ["Enter"], () => selectSource(planner), { where: "plan", isEnabled: isCopy }),
    command("edit", "dissolve", [], () => void dissolve(planner), {
      isEnabled: () => document.locked === null && canDissolve(planner),
    }),
    // Its key draws the room if nothing is selected, or while something is drawn.
    command("arrange", "rotate", ["R"], () => turn(90), {
      isEnabled: () => some() && !isDrawTool(planner.tool) && !areUnits(),
      why: () => (planner.selection.items.length > 0 && !isDrawTool(planner.tool) ? why() : null),
    }),
    command("arrange", "rotate_back", ["Shift+R"], () => turn(-90), { isEnabled: () => some() && !areUnits(), why }),
    command("arrange", "mirror_x", ["Shift+H"], () => void mirrorSelection(planner, 0), { isEnabled: some, why }),
    command("arrange", "mirror_y", ["Shift+V"], () => void mirrorSelection(planner, 1), { isEnabled: some, why }),
    command("arrange", "labels", ["L"], () => showField("/labels"), {
      isEnabled: () => isFixtures(planner),
      why: () => text.why_not.labels,
    }),
    command("arrange", "number", [], () => void numberFixtures(planner), { isEnabled: () => canNumber(planner) }),
    ...alignments.map((how) =>
      command("arrange", `align_${how}`, [], () => void alignSelection(planner, how), { isEnabled: several }),
    ),
    command("arrange", "distribute_x", [], () => void distributeSelection(planner, 0), { isEnabled: many }),
    command("arrange", "distribute_y", [], () => void distributeSelection(planner, 1), { isEnabled: many }),
  ];
}

const arrows: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/** Pixels by which arrow keys move the plan or the cross of a measurement. */
const arrowPixels = 40;
const crossPixels = 5;

const isLineTool = ({ tool }: Planner) =>
  tool === "measure" || tool === "scale" || tool === "check" || isDrawTool(tool);

function arrowCommand({ planner, gestures, turnSpace }: Surroundings, [x, y]: [number, number], isFast: boolean): void {
  const { unit } = planner.document;
  const [chosen, ...others] = chosenUnits(planner);
  const why = planner.selection.items.length > 0 ? whyNot(planner) : null;
  const metres = (isFast ? 10 : 1) * unit.step * unit.factor;
  const pixels = (planner.tool === "scale" || planner.tool === "check" ? 1 : crossPixels) * (isFast ? 10 : 1);
  if (isLineTool(planner)) gestures.moveCross(x * pixels, y * pixels);
  else if (chosen !== undefined && others.length === 0) void planner.mover.nudge(chosen, [x * metres, y * metres]);
  else if (why !== null) planner.say(why, true);
  else if (planner.selected.length > 0) void shiftElements(planner, planner.selected, [x * metres, y * metres], true);
  else if (planner.isPlan || !turnSpace(x, y)) planner.viewport.pan(-x * arrowPixels, y * arrowPixels);
}

function moveCommands(around: Surroundings): Command[] {
  const commands = (family: "nudge" | "move", held: string) =>
    Object.entries(arrows).map(([key, way]) => {
      const id = `${family}_${key.slice(5).toLowerCase()}` as Command["id"];
      return command("arrange", id, [held + key], () => arrowCommand(around, way, family === "move"), {
        family,
        where: "plan",
      });
    });
  return [...commands("nudge", ""), ...commands("move", "Shift+")];
}

function selectCommands({ planner, gestures }: Surroundings): Command[] {
  return [
    command("select", "select_all", ["Ctrl+A"], () => selectAll(planner)),
    command("select", "next", ["PageDown"], () => nextItem(planner, 1), { where: "plan" }),
    command("select", "previous", ["PageUp"], () => nextItem(planner, -1), { where: "plan" }),
    // First the gesture, then the tool, then the selection.
    command("select", "leave", ["Escape"], () => {
      if (gestures.cancel()) return;
      if (planner.tool !== "select") planner.setTool("select");
      else planner.selection.clear();
    }),
    command("tools", "select", ["V"], () => planner.setTool("select"), { isOn: () => planner.tool === "select" }),
    command("tools", "measure", ["M"], () => planner.setTool("measure"), {
      isOn: () => planner.tool === "measure",
      isEnabled: () => planner.isPlan,
      why: () => text.why_not.space,
    }),
    command("tools", "measure_here", ["Enter"], () => gestures.setAtCross(), {
      where: "plan",
      isEnabled: () => isLineTool(planner),
    }),
    ...Array.from({ length: 9 }, (_, k) =>
      command("types", `type_${k + 1}` as Command["id"], [String(k + 1)], () => assignType(planner, k), {
        family: "type",
        where: "plan",
        isEnabled: () => canAssign(planner) && !isDrawTool(planner.tool),
      }),
    ),
  ];
}

function viewCommands({
  planner,
  find,
  openCommands,
  openShortcuts,
  openMenu,
  focusNext,
  zoom,
  fit,
}: Surroundings): Command[] {
  return [
    command("view", "space", ["D"], () => planner.setPlan(!planner.isPlan), { isOn: () => !planner.isPlan }),
    command("view", "fit", ["0", "F"], () => (planner.isPlan ? showAll(planner) : fit())),
    command("view", "fit_selection", ["Shift+2"], () => showSelection(planner), {
      isEnabled: () => planner.selection.items.length > 0 && planner.isPlan,
    }),
    command("view", "zoom_in", ["+", "="], () => zoom(1.25)),
    command("view", "zoom_out", ["-"], () => zoom(1 / 1.25)),
    command("view", "wheel", [], () => planner.setWheelPans(!planner.wheelPans), { isOn: () => planner.wheelPans }),
    ...(["names", "label", "unit"] as const).map((layer) =>
      command("view", `show_${layer}`, [], () => planner.layers.show(layer, !planner.layers.isShown(layer)), {
        isOn: () => planner.layers.isShown(layer),
      }),
    ),
    command("view", "show_layers", [], () => planner.layers.showAll(), {
      isEnabled: () => planner.layers.hidesSome,
    }),
    command("help", "find", ["Ctrl+F"], find, { where: "everywhere" }),
    command("help", "commands", ["Ctrl+K", "/"], openCommands),
    command("help", "shortcuts", ["?"], openShortcuts),
    command("help", "menu", ["Shift+F10", "ContextMenu"], openMenu, { where: "plan" }),
    command("help", "region", ["F6"], focusNext, { where: "everywhere" }),
  ];
}

const drawKeys: Record<DrawTool, string[]> = {
  room: ["R"],
  wall: ["W"],
  opening: ["O"],
  zone: ["Z"],
  run: ["G"],
  block: ["B"],
  hole: [],
  keep_out: ["K"],
  area: ["A"],
  rows: ["N"],
  unit: ["U"],
  rail: ["T"],
  faces: ["C"],
};

const drawCommands = ({ planner, showField }: Surroundings): Command[] => {
  const begin = (tool: DrawTool) => {
    if (tool === "rows") planner.settings.set({ count: 2 }); // another row has another number
    planner.setTool(tool);
    if (tool === "rows") showField(countField);
  };
  return drawTools.map((tool) =>
    command("draw", `draw_${tool}`, drawKeys[tool], () => begin(tool), {
      isOn: () => planner.tool === tool,
      isEnabled: () => planner.isPlan && planner.document.locked === null && (tool !== "rows" || isRow(planner)),
      why: () =>
        planner.document.locked ? text.why_not.locked : planner.isPlan ? text.draw.no_row : text.why_not.space,
    }),
  );
};

const isFixtures = ({ selected }: Planner) => selected.length > 0 && selected.every(({ kind }) => kind === "fixture");

/** Whether the selection is one fixture with a place of its own. */
function isRow({ selected }: Planner): boolean {
  const [row] = selected;
  return selected.length === 1 && row.kind === "fixture" && row.value.against === undefined;
}

function pictureCommands({ planner, choosePicture, chooseTable, chooseFile }: Surroundings): Command[] {
  const { document, look } = planner;
  const hasPicture = () => planner.drawing !== null && document.locked === null;
  const onPlan = {
    isEnabled: () => hasPicture() && planner.isPlan,
    why: () => (hasPicture() ? text.why_not.space : text.why_not.picture),
  };
  const tool = (name: "scale" | "check" | "crop") => () => planner.setTool(name);
  const isOn = (name: "scale" | "check" | "crop") => () => planner.tool === name;
  return [
    command("picture", "choose_picture", [], choosePicture, { isEnabled: () => document.locked === null }),
    command("edit", "choose_table", [], chooseTable, { isEnabled: () => document.locked === null }),
    command("edit", "choose_file", [], chooseFile, { isEnabled: () => document.locked === null }),
    command("picture", "picture", [], () => planner.openType(drawingPath), {
      isEnabled: () => planner.drawing !== null,
    }),
    command("picture", "scale", ["S"], tool("scale"), { ...onPlan, isOn: isOn("scale") }),
    command("picture", "check_scale", [], tool("check"), {
      isEnabled: () => onPlan.isEnabled() && planner.drawing?.scale !== undefined,
      isOn: isOn("check"),
    }),
    command("picture", "crop", [], tool("crop"), { ...onPlan, isOn: isOn("crop") }),
    command("picture", "turn_picture", [], () => turnPicture(planner, 90), { isEnabled: hasPicture }),
    command("picture", "turn_picture_back", [], () => turnPicture(planner, -90), { isEnabled: hasPicture }),
    command("picture", "show_picture", [], () => look.set({ isShown: !look.now.isShown }), {
      isEnabled: () => planner.drawing !== null,
      isOn: () => look.now.isShown,
    }),
    command("picture", "lock_picture", [], () => look.set({ isLocked: !look.now.isLocked }), {
      isEnabled: () => planner.drawing !== null,
      isOn: () => look.now.isLocked,
    }),
    command("picture", "remove_picture", [], () => void editDrawing(planner, text.edits.remove_picture, null), {
      isEnabled: hasPicture,
    }),
  ];
}

const outlineCommands = ({ planner }: Surroundings): Command[] =>
  outlineUses.map((use) =>
    command("picture", `outline_${use}`, [], () => void takeOutlines(planner, use), {
      isEnabled: () => planner.document.locked === null && canTake(planner, use),
      why: () => text.why_not.outline,
    }),
  );

export const commandList = (around: Surroundings): Command[] => [
  ...selectCommands(around),
  ...unitCommands(around.planner, around.showField),
  ...editCommands(around),
  ...moveCommands(around),
  ...drawCommands(around), // after the others, because R turns a selection
  ...pictureCommands(around),
  ...outlineCommands(around),
  ...viewCommands(around),
];
