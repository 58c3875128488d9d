// The state of the planner that its parts share.

import { isSoftware } from "../scene/software";
import { drawingOf, type Drawing } from "./backdrop/drawing";
import { Look } from "./backdrop/look";
import { Picture } from "./backdrop/picture";
import { Traced } from "./backdrop/traced";
import { boundsOfPicture } from "./backdrop/transform";
import { Changes } from "./changes";
import { Presets } from "./draw/presets";
import { ToolSettings } from "./draw/settings";
import type { DrawTool } from "./draw/tools";
import { Connection } from "./document/connection";
import { DeviceAnswers } from "./document/device_answers";
import { StoreDocument } from "./document/document";
import { isObject } from "./document/json";
import type { Part, Point } from "./document/messages";
import type { Clip } from "./elements/copies";
import { inUnit } from "./form/convert";
import { elementAt, type StoreElement } from "./elements/kinds";
import { boundsOf, boundsOfParts, joined, type Bounds } from "./geometry/bounds";
import { Light } from "./light/light";
import { Plans } from "./planning/plans";
import { Snapping } from "./snap/snapping";
import { UnitMover } from "./units/mover";
import { UnitQueue } from "./units/queue";
import { UnitTool } from "./units/tool";
import { Fan } from "./view/fan";
import { Layers } from "./view/layers";
import { copyKey, placeAgain, Selection, type Item, type Place } from "./view/selection";
import { Viewport } from "./view/viewport";

export type Tool = "select" | "measure" | "scale" | "check" | "crop" | DrawTool;

export interface Notice {
  text: string;
  isProblem: boolean;
}

function rememberedWheel(): boolean {
  try {
    return localStorage.getItem("shelfbeam.wheel") === "pan";
  } catch {
    return false;
  }
}

export class Planner {
  readonly changes = new Changes();
  readonly connection: Connection;
  readonly document: StoreDocument;
  readonly selection = new Selection(this.changes);
  readonly layers = new Layers(this.changes);
  readonly viewport = new Viewport(this.changes);
  readonly look = new Look(this.changes);
  readonly picture: Picture;
  readonly fan: Fan;
  readonly traced: Traced;
  readonly snapping: Snapping;
  readonly presets: Presets;
  readonly light: Light;
  readonly plans: Plans;
  readonly settings = new ToolSettings(this.changes);
  readonly answers: DeviceAnswers;
  readonly queue = new UnitQueue(this);
  readonly unitTool: UnitTool;
  readonly mover: UnitMover;
  tool: Tool = "select";
  /** Whether the plan or the 3-D picture is shown. */
  isPlan = true;
  /** Whether turning the wheel moves the plan, as trackpads do, instead of changing its scale. */
  wheelPans = rememberedWheel();
  clip: Clip = { copied: [], unit: "", types: {} };
  /** The type, or the picture of the floor plan, that the panel edits if nothing is selected: a pointer. */
  typePath: string | null = null;
  notice: Notice | null = null;
  /** Closed outlines of the drawing beneath the shop, for which a menu is open, m. */
  outlines: readonly (readonly Point[])[] | null = null;
  /** At once, because the next event of the pointer belongs to the tool. */
  onTool: () => void = () => {};
  private held: Drawing | null = null;
  private pointed: Point | null = null;
  private readonly followers = new Set<(place: Place) => void>();

  constructor(address: string) {
    this.connection = new Connection(address);
    this.document = new StoreDocument(this.connection, this.changes, inUnit);
    this.picture = new Picture(address, this.changes, this.look);
    this.presets = new Presets(this.document, this.changes);
    this.light = new Light(this.document, this.changes, this.connection, isSoftware());
    this.plans = new Plans(this.document, this.changes);
    this.fan = new Fan(this.document.labels, () => (this.isPlan ? this.viewport.scale : 0));
    this.traced = new Traced(this);
    this.snapping = new Snapping(this, this.traced);
    this.document.onStart = () => {
      this.light.restart();
      this.mover.cancel(); // units have other numbers
    };
    this.document.onLight = (event) => this.light.receive(event);
    this.document.onLightFrame = (frame) => this.light.receiveFrame(frame);
    this.document.onChanged = (...change) => this.light.noteChange(...change);
    this.document.onMoved = (place) => this.moved(place);
    this.document.onReplaced = (before) => this.moved(placeAgain(before, this.document.json));
    this.answers = new DeviceAnswers(this.document, this.changes);
    this.unitTool = new UnitTool(this);
    this.mover = new UnitMover(this);
    for (const devices of [this.document.labels, this.document.units])
      devices.onReplaced = (...range) => {
        this.selection.replaceDevices(devices, ...range);
        if (devices.kind === "unit") this.mover.follow();
      };
    this.changes.listen(["document", "devices"], () => this.selection.keep((item) => this.exists(item)));
  }

  /** The pointer's place in the plan, m; null outside of it. It stays on the screen when the plan moves beneath it. */
  get pointer(): Point | null {
    return this.pointed && this.viewport.toWorld(this.pointed);
  }

  set pointer(place: Point | null) {
    this.pointed = place && this.viewport.toScreen(place);
  }

  setTool(tool: Tool): void {
    this.tool = tool;
    this.onTool();
    this.changes.note("tool");
  }

  setPlan(isPlan: boolean): void {
    this.isPlan = isPlan;
    this.setTool("select");
  }

  setWheelPans(wheelPans: boolean): void {
    this.wheelPans = wheelPans;
    try {
      localStorage.setItem("shelfbeam.wheel", wheelPans ? "pan" : "zoom");
    } catch {
      // Private windows may refuse to remember.
    }
  }

  /** Tells the person something, also by a screen reader. */
  say(text: string, isProblem = false): void {
    this.notice = { text, isProblem };
    this.changes.note("status");
  }

  /** Outlines that commands may take; null: none. */
  offerOutlines(outlines: readonly (readonly Point[])[] | null): void {
    this.outlines = outlines;
    this.changes.note("preview");
  }

  /** Shows a type of fixtures, materials, labels or units in the panel. */
  openType(path: string | null): void {
    this.selection.clear();
    this.typePath = path;
    this.changes.note("selection");
  }

  /** The picture of the floor plan, perhaps where a gesture holds it. */
  get drawing(): Drawing | null {
    return this.held ?? drawingOf(this.document.json);
  }

  /** Shows the picture at another place; null: where the store has it. */
  hold(drawing: Drawing | null): void {
    this.held = drawing;
    this.changes.note("picture");
  }

  private moved(place: Place): void {
    this.selection.follow(place);
    for (const follower of this.followers) follower(place);
  }

  /** For what keeps paths of elements while the store may change. The result ends it. */
  follow(follower: (place: Place) => void): () => void {
    this.followers.add(follower);
    return () => this.followers.delete(follower);
  }

  private exists(item: Item): boolean {
    const { document } = this;
    if (item.kind === "element") return elementAt(document.json, item.path) !== null;
    if (item.kind === "copy") return this.partsOf(item).length > 0;
    return item.index < (item.device === "label" ? document.labels : document.units).count;
  }

  /** The selected elements, which can be changed. */
  get selected(): StoreElement[] {
    return this.selection.paths.flatMap((path) => elementAt(this.document.json, path) ?? []);
  }

  partsOf(item: Item): readonly Part[] {
    if (item.kind === "device") return [];
    if (item.kind === "element") return this.document.parts.of(item.path);
    const { parts } = this.document;
    const { key, path } = item;
    // Until the server answers, outlines have the keys of the places before an edit.
    return path === null
      ? [parts.withKey(key) ?? []].flat()
      : parts.of(path).filter((part) => part.locked && copyKey(part.key, path) === key);
  }

  /** The labels or units of an element that have no outline. */
  pointsOf(item: Item): Point[] {
    const { labels, units } = this.document;
    if (item.kind === "device") {
      const devices = item.device === "label" ? labels : units;
      return item.index < devices.count ? [this.fan.place(devices, item.index)] : [];
    }
    if (item.kind === "copy") return [];
    return [labels, units].flatMap((devices) => {
      const index = devices.withPath(item.path);
      return index === undefined ? [] : [this.fan.place(devices, index)];
    });
  }

  boundsOfItem(item: Item): Bounds | null {
    return boundsOfParts(this.partsOf(item)) ?? boundsOf(this.pointsOf(item));
  }

  boundsOfElements(elements: readonly StoreElement[]): Bounds | null {
    return joined(elements.map(({ path }) => this.boundsOfItem({ kind: "element", path })));
  }

  get selectionBounds(): Bounds | null {
    return joined(this.selection.items.map((item) => this.boundsOfItem(item)));
  }

  /** The name of the store, or of its folder. */
  get title(): string {
    const { json, name, file } = this.document;
    const own = isObject(json) ? json.name : "";
    return typeof own === "string" && own !== "" ? own : name || file;
  }

  get wholeBounds(): Bounds | null {
    const { drawing, look, document } = this;
    const picture = drawing && look.now.isShown ? boundsOfPicture(drawing, document.unit) : null;
    return joined([boundsOfParts(document.parts.all), picture]);
  }
}
