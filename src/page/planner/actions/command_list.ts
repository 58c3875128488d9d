// The commands of the planner.

import type { Command } from "../access/commands";
import { alignments } from "../elements/arrange";
import { layers } from "../view/layers";
import type { Gestures } from "../gesture/gestures";
import type { Planner } from "../planner";
import { text } from "../text";
import { say } from "../../data/text";
import { assignType } from "./assign";
import { copySelection, deleteSelection, duplicateSelection, paste } from "./copy";
import { alignSelection, distributeSelection, mirrorSelection, shiftSelection, turnSelection } from "./move";
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
}

function editCommands({ planner, gestures }: Surroundings): Command[] {
  const { document } = planner;
  const some = () => whyNot(planner) === null;
  const why = () => whyNoCopy(planner);
  const copyable = () => some() && planner.selected.some(({ kind }) => kind !== "room");
  const several = () => planner.selected.length > 1 && document.locked === null;
  const many = () => planner.selected.length > 2 && document.locked === null;
  const isCopy = () => planner.selection.items.some(({ kind, path }) => kind !== "element" && path !== null);
  const step = async (what: "undo" | "redo") => {
    const { steps, position } = document.history;
    const label = steps[what === "undo" ? position - 1 : position]?.label ?? "";
    if (await document[what]()) planner.say(say(text.notices[what], label));
  };
  const names = {
    left: "align_left",
    centre: "align_centre",
    right: "align_right",
    top: "align_top",
    middle: "align_middle",
    bottom: "align_bottom",
  } as const;
  return [
    {
      id: "undo",
      group: "edit",
      keys: ["Ctrl+Z"],
      where: "page",
      run: () => {
        if (!gestures.cancel()) void step("undo");
      },
      isEnabled: () => gestures.scope.kind !== "idle" || document.canUndo,
    },
    {
      id: "redo",
      group: "edit",
      keys: ["Ctrl+Y", "Ctrl+Shift+Z"],
      where: "page",
      run: () => void step("redo"),
      isEnabled: () => document.canRedo,
    },
    {
      id: "cut",
      group: "edit",
      keys: ["Ctrl+X"],
      where: "page",
      run: () => copySelection(planner) && void deleteSelection(planner),
      isEnabled: copyable,
      why,
    },
    {
      id: "copy",
      group: "edit",
      keys: ["Ctrl+C"],
      where: "page",
      run: () => void copySelection(planner),
      isEnabled: () => planner.selected.some(({ kind }) => kind !== "room"),
    },
    {
      id: "paste",
      group: "edit",
      keys: ["Ctrl+V"],
      where: "page",
      run: () => void paste(planner, planner.pointer),
      isEnabled: () => planner.clip.copied.length > 0,
    },
    {
      id: "duplicate",
      group: "edit",
      keys: ["Ctrl+D"],
      where: "page",
      run: () => void duplicateSelection(planner),
      isEnabled: copyable,
      why,
    },
    {
      id: "delete",
      group: "edit",
      keys: ["Delete", "Backspace"],
      where: "page",
      run: () => void deleteSelection(planner),
      isEnabled: copyable,
      why,
    },
    {
      id: "edit_source",
      group: "edit",
      keys: ["Enter"],
      where: "plan",
      run: () => selectSource(planner),
      isEnabled: isCopy,
    },
    {
      id: "dissolve",
      group: "edit",
      keys: [],
      where: "page",
      run: () => void dissolve(planner),
      isEnabled: () => document.locked === null && canDissolve(planner),
    },
    {
      id: "rotate",
      group: "arrange",
      keys: ["R"],
      where: "page",
      run: () => void turnSelection(planner, 90),
      isEnabled: some,
      why,
    },
    {
      id: "rotate_back",
      group: "arrange",
      keys: ["Shift+R"],
      where: "page",
      run: () => void turnSelection(planner, -90),
      isEnabled: some,
      why,
    },
    {
      id: "mirror_x",
      group: "arrange",
      keys: ["Shift+H"],
      where: "page",
      run: () => void mirrorSelection(planner, 0),
      isEnabled: some,
      why,
    },
    {
      id: "mirror_y",
      group: "arrange",
      keys: ["Shift+V"],
      where: "page",
      run: () => void mirrorSelection(planner, 1),
      isEnabled: some,
      why,
    },
    ...alignments.map(
      (how): Command => ({
        id: names[how],
        group: "arrange",
        keys: [],
        where: "page",
        run: () => void alignSelection(planner, how),
        isEnabled: several,
      }),
    ),
    {
      id: "distribute_x",
      group: "arrange",
      keys: [],
      where: "page",
      run: () => void distributeSelection(planner, 0),
      isEnabled: many,
    },
    {
      id: "distribute_y",
      group: "arrange",
      keys: [],
      where: "page",
      run: () => void distributeSelection(planner, 1),
      isEnabled: many,
    },
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

function arrowCommand({ planner, gestures, turnSpace }: Surroundings, [x, y]: [number, number], isFast: boolean): void {
  const { unit } = planner.document;
  const why = planner.selection.items.length > 0 ? whyNot(planner) : null;
  const metres = (isFast ? 10 : 1) * unit.step * unit.factor;
  if (planner.tool === "measure")
    gestures.moveCross(x * crossPixels * (isFast ? 10 : 1), -y * crossPixels * (isFast ? 10 : 1));
  else if (why !== null) planner.say(why, true);
  else if (planner.selected.length > 0) void shiftSelection(planner, x * metres, y * metres, true);
  else if (planner.isPlan || !turnSpace(x, y)) planner.viewport.pan(-x * arrowPixels, y * arrowPixels);
}

function moveCommands(around: Surroundings): Command[] {
  const keys = Object.keys(arrows);
  const run = (isFast: boolean) => (key: string) => arrowCommand(around, arrows[key], isFast);
  return [
    ...keys.map(
      (key): Command => ({
        id: `nudge_${key.slice(5).toLowerCase()}` as Command["id"],
        group: "arrange",
        family: "nudge",
        keys: [key],
        where: "plan",
        run: () => run(false)(key),
      }),
    ),
    ...keys.map(
      (key): Command => ({
        id: `move_${key.slice(5).toLowerCase()}` as Command["id"],
        group: "arrange",
        family: "move",
        keys: [`Shift+${key}`],
        where: "plan",
        run: () => run(true)(key),
      }),
    ),
  ];
}

function selectCommands({ planner, gestures }: Surroundings): Command[] {
  return [
    { id: "select_all", group: "select", keys: ["Ctrl+A"], where: "page", run: () => selectAll(planner) },
    { id: "next", group: "select", keys: ["PageDown"], where: "plan", run: () => nextItem(planner, 1) },
    { id: "previous", group: "select", keys: ["PageUp"], where: "plan", run: () => nextItem(planner, -1) },
    {
      id: "leave",
      group: "select",
      keys: ["Escape"],
      where: "page",
      // First the gesture, then the tool, then the selection.
      run: () => {
        if (gestures.cancel()) return;
        if (planner.tool !== "select") planner.setTool("select");
        else planner.selection.clear();
      },
    },
    {
      id: "select",
      group: "tools",
      keys: ["V"],
      where: "page",
      run: () => planner.setTool("select"),
      isOn: () => planner.tool === "select",
    },
    {
      id: "measure",
      group: "tools",
      keys: ["M"],
      where: "page",
      run: () => planner.setTool("measure"),
      isOn: () => planner.tool === "measure",
      isEnabled: () => planner.isPlan,
    },
    {
      id: "measure_here",
      group: "tools",
      keys: ["Enter"],
      where: "plan",
      run: () => gestures.measureAtCross(),
      isEnabled: () => planner.tool === "measure",
    },
    ...Array.from(
      { length: 9 },
      (_, k): Command => ({
        id: `type_${k + 1}` as Command["id"],
        group: "types",
        family: "type",
        keys: [String(k + 1)],
        where: "plan",
        run: () => assignType(planner, k),
        isEnabled: () => planner.selected.length > 0,
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
    {
      id: "space",
      group: "view",
      keys: ["D"],
      where: "page",
      run: () => planner.setPlan(!planner.isPlan),
      isOn: () => !planner.isPlan,
    },
    {
      id: "fit",
      group: "view",
      keys: ["0", "F"],
      where: "page",
      run: () => (planner.isPlan ? showAll(planner) : fit()),
    },
    {
      id: "fit_selection",
      group: "view",
      keys: ["Shift+2"],
      where: "page",
      run: () => showSelection(planner),
      isEnabled: () => planner.selection.items.length > 0 && planner.isPlan,
    },
    { id: "zoom_in", group: "view", keys: ["+", "="], where: "page", run: () => zoom(1.25) },
    { id: "zoom_out", group: "view", keys: ["-"], where: "page", run: () => zoom(1 / 1.25) },
    {
      id: "wheel",
      group: "view",
      keys: [],
      where: "page",
      run: () => planner.setWheelPans(!planner.wheelPans),
      isOn: () => planner.wheelPans,
    },
    ...(["names", "label", "unit"] as const).map(
      (layer): Command => ({
        id: `show_${layer}`,
        group: "view",
        keys: [],
        where: "page",
        run: () => planner.layers.show(layer, !planner.layers.isShown(layer)),
        isOn: () => planner.layers.isShown(layer),
      }),
    ),
    {
      id: "show_layers",
      group: "view",
      keys: [],
      where: "page",
      run: () => planner.layers.showAll(),
      isEnabled: () => layers.some((layer) => !planner.layers.isShown(layer)),
    },
    { id: "find", group: "help", keys: ["Ctrl+F"], where: "everywhere", run: find },
    { id: "commands", group: "help", keys: ["Ctrl+K", "/"], where: "page", run: openCommands },
    { id: "shortcuts", group: "help", keys: ["?"], where: "page", run: openShortcuts },
    { id: "menu", group: "help", keys: ["Shift+F10", "ContextMenu"], where: "plan", run: openMenu },
    { id: "region", group: "help", keys: ["F6"], where: "everywhere", run: focusNext },
  ];
}

export const commandList = (around: Surroundings): Command[] => [
  ...selectCommands(around),
  ...editCommands(around),
  ...moveCommands(around),
  ...viewCommands(around),
];
