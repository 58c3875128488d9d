// Puts the planner's parts together.

import { element, setText } from "../../panel/dom";
import { Names } from "../../scene/names";
import { onThemeChange } from "../../scene/palette";
import { Stage } from "../../scene/stage";
import type { Scenery } from "../../data/scenery";
import { Commands, type CommandId } from "../access/commands";
import { openFind } from "../access/find";
import { chordText } from "../access/keys";
import { openMenu } from "../access/menu";
import { outlineMenu } from "../actions/outlines";
import { openPicker } from "../access/picker";
import { openShortcuts } from "../access/shortcuts";
import { commandList } from "../actions/command_list";
import { showAll } from "../actions/source";
import { Arrivals, deviceFiles, tableFiles } from "../backdrop/arrivals";
import { Backdrop } from "../backdrop/backdrop";
import { drawingPath } from "../backdrop/drawing";
import { LengthField } from "../backdrop/length_field";
import { EdgeFields } from "../draw/edge_fields";
import { beginsInPlan } from "../draw/tools";
import { Loupe } from "../backdrop/loupe";
import { boundsOf, middleOf } from "../geometry/bounds";
import { Gestures } from "../gesture/gestures";
import { DeviceMarks } from "../plan/marks";
import { Overlay } from "../plan/overlay";
import { ScaleBar } from "../plan/scale_bar";
import { Shapes } from "../plan/shapes";
import type { Planner } from "../planner";
import { PlanPanel } from "../planning/panel";
import { HistoryList } from "../side/history_list";
import { LayerList } from "../side/layer_list";
import { ObjectList } from "../side/object_list";
import { ProblemList } from "../side/problem_list";
import { Properties } from "../side/properties";
import { TypeLists } from "../side/type_list";
import { Space } from "../space/space";
import { text } from "../text";
import { placesOnPlan } from "../units/chosen";
import { Banner } from "./banner";
import { listenToKeys } from "./keyboard";
import { LightView } from "./light_view";
import { Rail } from "./rail";
import { StatusLine } from "./status";
import { Toolbar } from "./toolbar";

const usualMarks = 5000;
/** Fixtures with narrower outlines on the screen have no names, pixels. */
const leastNamed = 26;

const elementMenu: CommandId[][] = [
  ["edit_source", "dissolve"],
  ["cut", "copy", "paste", "duplicate", "delete"],
  ["unit_switch", "unit_pin", "unit_exclude", "unit_install", "unit_remove"],
  ["unit_turn", "unit_turn_back", "unit_tilt", "unit_exchange", "unit_power"],
  ["rotate", "mirror_x", "mirror_y"],
  ["align_left", "align_centre", "align_right", "align_top", "align_middle", "align_bottom"],
  ["distribute_x", "distribute_y", "labels", "number"],
  ["fit_selection", "select_all", "fit", "space"],
];

export class Page {
  readonly commands = new Commands();
  readonly gestures: Gestures;
  readonly stage: Stage;

  private readonly surface = element("div", {
    class: "surface",
    tabindex: 0,
    role: "application",
    "aria-label": text.access.plan,
  });
  private readonly canvas = element("canvas", { class: "marks", role: "application", "aria-label": text.access.space });
  /** Why there is no 3-D picture. */
  private readonly absent = element("p", { class: "absent", role: "status", hidden: true });
  private readonly names = new Names();
  private readonly plan = element("section", { class: "plan", "aria-label": text.access.drawing });
  private readonly arrivals: Arrivals;
  private readonly backdrop: Backdrop;
  private readonly loupe: Loupe;
  private readonly lengthField: LengthField;
  private readonly edgeFields: EdgeFields;
  private readonly shapes: Shapes;
  private readonly overlay: Overlay;
  private readonly marks: DeviceMarks;
  private readonly space: Space;
  private readonly scaleBar: ScaleBar;
  private readonly rail: Rail;
  private readonly properties: Properties;
  private isFitted = false;

  constructor(
    root: HTMLElement,
    private readonly planner: Planner,
    address: string,
  ) {
    this.gestures = new Gestures(planner, this.surface);
    this.arrivals = new Arrivals(planner, address);
    this.commands.add(
      commandList({
        planner,
        gestures: this.gestures,
        find: () => openFind(planner, () => this.focusPlan()),
        openCommands: () => this.openCommands(),
        openShortcuts: () => openShortcuts(this.commands),
        openMenu: () => this.menuAtSelection(),
        focusNext: () => this.focusNext(),
        turnSpace: (right, up) => {
          this.stage.turn(right, up);
          return true;
        },
        zoom: (factor) => (planner.isPlan ? planner.viewport.zoom(factor) : this.stage.zoom(factor)),
        fit: () => this.stage.showAll(),
        choosePicture: () => this.arrivals.choose(),
        chooseTable: () => this.arrivals.choose(tableFiles),
        chooseFile: () => this.arrivals.choose(deviceFiles),
        showField: (pointer) => this.properties.focusOn(pointer),
      }),
    );
    this.backdrop = new Backdrop(planner, this.plan);
    this.loupe = new Loupe(planner, this.gestures);
    this.lengthField = new LengthField(planner, this.gestures, () => this.focusPlan());
    this.edgeFields = new EdgeFields(planner, this.gestures, () => this.focusPlan());
    this.shapes = new Shapes(planner);
    this.overlay = new Overlay(planner, this.gestures);
    this.scaleBar = new ScaleBar(planner);
    this.properties = new Properties(planner, this.commands);
    const objects = new ObjectList(planner);
    const plans = new PlanPanel(planner, address);
    const toolbar = new Toolbar(planner, this.commands);
    const status = new StatusLine(planner, this.gestures, this.commands);
    const banner = new Banner(planner);
    this.stage = new Stage(this.canvas, emptyScenery([0, 0], [10, 10]), { marks: usualMarks, overlay: true });
    this.marks = new DeviceMarks(planner, this.stage);
    const isOpen = () => this.rail.isOpen("light");
    const light = new LightView(planner, this.gestures, this.stage, this.marks, this.surface, isOpen);
    this.rail = new Rail(
      [
        { id: "objects", icon: "objects", content: objects },
        { id: "layers", icon: "layers", content: new LayerList(planner) },
        { id: "light", icon: "light", content: light.panel },
        { id: "plans", icon: "plans", content: plans },
        { id: "types", icon: "types", content: new TypeLists(planner) },
        { id: "problems", icon: "problems", content: new ProblemList(planner) },
        { id: "history", icon: "history", content: new HistoryList(planner) },
      ],
      () => this.resize(),
    );
    this.plan.append(
      this.backdrop.root,
      this.shapes.root,
      this.canvas,
      this.absent,
      this.names.root,
      this.overlay.root,
      this.surface,
      this.scaleBar.root,
      this.loupe.root,
      this.lengthField.root,
      this.edgeFields.root,
      light.card.root,
    );
    root.replaceChildren(
      toolbar.root,
      element(
        "main",
        {},
        this.rail.root,
        this.rail.side,
        element("div", { class: "middle" }, banner.root, this.plan, status.root),
        this.properties.root,
        this.arrivals.root,
      ),
    );
    this.stage.setPlan(true);
    this.space = new Space(planner, this.stage, this.marks, address);
    this.stage.onDrawn = () => {
      if (!planner.isPlan) this.names.update(this.stage, placesOnPlan(planner));
      this.markDrawn();
      this.marks.markDrawn();
    };
    this.stage.onPicture = () => this.showPicture();
    planner.changes.onFlushed = () => this.stage.drawPending();
    this.commands.onRefused = (why) => planner.say(why, true);
    planner.onTool = () => this.gestures.useTool();
    this.gestures.onMenu = ([x, y]) => this.openMenuAt(x, y);
    this.gestures.onOpen = () => this.commands.run("edit_source");
    listenToKeys(
      planner,
      this.commands,
      this.gestures,
      [this.surface, this.canvas],
      (file) => void this.arrivals.take(file),
      (typed) => this.edgeFields.begin(typed),
    );

    const { changes } = planner;
    changes.listen(["document"], () => this.opened());
    changes.listen(["document"], () => this.followPicture());
    changes.listen(["layers"], () => void planner.picture.followLayers());
    changes.listen(["document"], () => this.shapes.fadeRoom());
    changes.listen(["document", "picture", "layers", "viewport", "tool"], () => this.backdrop.update());
    changes.listen(["document", "preview", "viewport", "tool", "layers"], () => {
      this.loupe.update();
      this.lengthField.update();
      this.edgeFields.update();
    });
    changes.listen(["layers"], () => planner.typePath === drawingPath && this.properties.update());
    changes.listen(["document", "preview", "selection", "layers", "warnings"], () => this.shapes.update());
    changes.listen(["viewport"], () => this.follow());
    changes.listen(["devices"], () => this.marks.rebuild());
    changes.listen(["preview"], () => this.marks.displace());
    changes.listen(["selection", "layers", "tool"], () => this.marks.update());
    changes.listen(["document", "preview", "selection", "viewport", "tool", "devices", "layers", "warnings"], () =>
      this.overlay.update(),
    );
    changes.listen(["viewport", "document", "tool"], () => this.scaleBar.update());
    changes.listen(["tool"], () => this.showTool());
    changes.listen(["document", "preview", "devices", "layers", "viewport", "tool"], () => this.showNames());
    changes.listen(["document", "tool"], () => this.space.update());
    changes.listen(["selection", "document", "tool"], () => this.space.showSelection());
    changes.listen(["document", "selection", "layers", "devices", "warnings", "presets"], () => this.rail.update());
    changes.listen(["selection"], () => objects.follow());
    changes.listen(["light"], () => objects.followUnits());
    changes.listen(["plans", "light", "status"], () => this.rail.isOpen("plans") && plans.update());
    changes.listen(["proposed"], () => this.marks.update());
    changes.listen(["document", "warnings"], () => this.countProblems());
    changes.listen(["document", "selection", "devices", "warnings", "status", "tool", "presets"], () =>
      this.properties.update(),
    );
    changes.listen(["document", "selection", "tool", "status", "devices"], () => toolbar.update());
    changes.listen(["document", "status"], () => banner.update());
    changes.listen(["document", "selection", "preview", "viewport", "tool", "status", "devices", "layers"], () =>
      status.update(),
    );
    onThemeChange(() => this.marks.recolour());
    new ResizeObserver(() => this.resize()).observe(this.plan);
    this.resize();
    this.showTool();
    changes.note("document", "tool", "status");
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.plan;
    this.planner.viewport.resize(clientWidth, clientHeight);
    this.stage.resize(clientWidth, clientHeight);
  }

  /** Once: shows the whole store. */
  private opened(): void {
    const { planner } = this;
    if (this.isFitted || !planner.document.isReady) return;
    this.isFitted = true;
    const project = `${planner.document.name}/${planner.document.file}`;
    planner.layers.open(project);
    planner.look.open(project);
    const bounds = planner.wholeBounds;
    if (bounds) this.stage.replace(emptyScenery(bounds.lower, bounds.upper));
    showAll(planner);
  }

  /** Another tab may replace or remove the picture in which a line is drawn. */
  private followPicture(): void {
    const { planner } = this;
    const { drawing, tool } = planner;
    if (planner.picture.follow(drawing) && this.gestures.scope.kind === "scaling") this.gestures.cancel();
    if (!drawing && (tool === "scale" || tool === "check" || tool === "crop")) planner.setTool("select");
  }

  private follow(): void {
    const { viewport, isPlan } = this.planner;
    this.shapes.place();
    if (isPlan) this.stage.placeAbove(viewport.centre[0], viewport.centre[1], viewport.scale);
  }

  private showTool(): void {
    const { planner, plan, canvas, surface, stage } = this;
    plan.classList.toggle("space", !planner.isPlan);
    plan.dataset.tool = planner.tool;
    canvas.tabIndex = planner.isPlan ? -1 : 0;
    const hadFocus = document.activeElement === surface || document.activeElement === canvas;
    surface.hidden = !planner.isPlan; // takes the focus from it
    stage.setPlan(planner.isPlan);
    this.showPicture();
    this.follow();
    // Arrow keys move the cross of a line, wherever its tool was chosen.
    if (hadFocus || beginsInPlan(planner.tool)) this.focusPlan();
  }

  private showPicture(): void {
    const isAbsent = !this.planner.isPlan && !this.stage.hasPicture;
    setText(this.absent, isAbsent ? text.access.no_space : "");
    this.names.root.hidden = isAbsent;
  }

  private focusPlan(): void {
    (this.planner.isPlan ? this.surface : this.canvas).focus({ preventScroll: true });
  }

  /** For measurements: once, when outlines and marks are drawn. */
  private markDrawn(): void {
    const { labels, units } = this.planner.document;
    if (this.isFitted && labels.count + units.count > 0 && performance.getEntriesByName("drawn").length === 0)
      performance.mark("drawn");
  }

  private showNames(): void {
    const { planner } = this;
    const { scale } = planner.viewport;
    const named = planner.layers.isShown("names")
      ? planner.document.parts.all.filter(
          ({ kind, id, outline }) =>
            (kind === "fixture" || kind === "zone") &&
            id !== "" &&
            planner.layers.isShown(kind) &&
            isWide(outline, scale),
        )
      : [];
    this.names.set(
      named.flatMap(({ id, outline, height = 0 }) => {
        const bounds = boundsOf(outline);
        return bounds ? [{ id, at: [...middleOf(bounds), height] }] : [];
      }),
    );
    this.names.update(this.stage, placesOnPlan(planner));
  }

  private countProblems(): void {
    const { problems, warnings } = this.planner.document;
    this.rail.showProblems(problems.length + warnings.length, problems.length > 0);
  }

  private openMenuAt(x: number, y: number): void {
    const { planner } = this;
    const box = this.plan.getBoundingClientRect();
    const outline = planner.isPlan ? planner.traced.outlineAt(planner.viewport.toWorld([x, y])) : null;
    planner.offerOutlines(outline ? [outline] : []);
    openMenu(this.commands, [...elementMenu, outlineMenu], box.left + x, box.top + y, () =>
      planner.offerOutlines(null),
    );
  }

  private menuAtSelection(): void {
    const { planner } = this;
    const bounds = planner.selectionBounds;
    const [x, y] = bounds
      ? planner.viewport.toScreen(middleOf(bounds))
      : [0.5 * planner.viewport.width, 0.5 * planner.viewport.height];
    this.openMenuAt(
      Math.min(Math.max(x, 0), planner.viewport.width),
      Math.min(Math.max(y, 0), planner.viewport.height),
    );
  }

  private openCommands(): void {
    openPicker(text.access.commands, text.access.commands_hint, (typed) => {
      const wanted = typed.toLowerCase();
      return this.commands.all
        .filter(({ id, group }) => `${text.commands[id]} ${text.groups[group]}`.toLowerCase().includes(wanted))
        .map(({ id, keys }) => ({
          name: text.commands[id],
          note: keys.map(chordText).join("  "),
          isEnabled: this.commands.isEnabled(id),
          choose: () => this.commands.run(id),
        }));
    });
  }

  /** Moves the focus between list, plan and panel. */
  private focusNext(): void {
    const regions = [
      this.rail.root.querySelector<HTMLElement>("[tabindex='0']"),
      this.planner.isPlan ? this.surface : this.canvas,
      this.properties.root,
    ];
    const areas = [this.rail.side, this.plan, this.properties.root];
    const active = document.activeElement;
    const at = areas.findIndex((area, k) => area.contains(active) || regions[k] === active);
    const next = (at + 1) % regions.length;
    const list =
      next === 0 ? this.rail.side.querySelector<HTMLElement>("[role='tabpanel']:not([hidden]) [tabindex='0']") : null;
    (list ?? regions[next])?.focus();
  }
}

function isWide(outline: readonly [number, number][], scale: number): boolean {
  const bounds = boundsOf(outline);
  return (
    bounds !== null &&
    Math.max(bounds.upper[0] - bounds.lower[0], bounds.upper[1] - bounds.lower[1]) * scale >= leastNamed
  );
}

/** A room without anything in it, until the 3-D picture is fetched. */
function emptyScenery(lower: readonly number[], upper: readonly number[]): Scenery {
  const none = { outline: new Float32Array(), height: new Float32Array() };
  return {
    lower: [lower[0], lower[1], 0],
    upper: [upper[0], upper[1], 10],
    part: { look: new Uint8Array(), corners: new Uint8Array(), ...none },
    mesh: { vertex: new Float32Array(), triangle: new Uint32Array() },
    room: null,
    states: [],
    block: none,
    door: {},
  };
}
