// The 3-D picture: fetched when it is shown, and again after changes.

import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments } from "three";

import { readFrame } from "../../data/page_data";
import { sceneryOf, type Scenery } from "../../data/scenery";
import { colourOf } from "../../scene/palette";
import type { Stage } from "../../scene/stage";
import type { Devices } from "../document/devices";
import { isObject, type Json } from "../document/json";
import type { Part, Point } from "../document/messages";
import { canGrab } from "../units/chosen";
import { deviceItem, isDeviceFree, itemOf } from "../view/hit";
import type { Item } from "../view/selection";
import type { DeviceMarks } from "../plan/marks";
import type { Planner } from "../planner";
import { text } from "../text";
import { prismAt } from "./prisms";
import { UnitDrag } from "./unit_drag";

interface SceneAbout {
  revision: number;
  lower: number[];
  upper: number[];
}

const pause = 300; // ms without changes before the picture is fetched again

export class Space {
  private revision = -1;
  private drawn: readonly Json[] = [];
  private timer: ReturnType<typeof setTimeout> | undefined;
  private hasPlace = false;
  private readonly chosen = new LineSegments(
    new BufferGeometry(),
    new LineBasicMaterial({ depthTest: false, transparent: true }),
  );

  constructor(
    private readonly planner: Planner,
    private readonly stage: Stage,
    private readonly marks: DeviceMarks,
    private readonly address: string,
  ) {
    this.chosen.renderOrder = 4;
    this.chosen.frustumCulled = false;
    stage.extras.add(this.chosen);
    this.listen(stage.canvas);
  }

  /** After a change of the store or of the view. */
  update(): void {
    const { planner } = this;
    this.chosen.visible = !planner.isPlan;
    const { revision, json } = planner.document;
    // Values that have not changed are the same objects.
    const now = surfacesOf(json);
    const isSame = this.drawn.length === now.length && this.drawn.every((value, k) => value === now[k]);
    if (this.revision >= 0 && isSame) this.revision = revision;
    if (planner.isPlan || this.revision === revision) return;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.fetch(), this.revision < 0 ? 0 : pause);
  }

  private async fetch(): Promise<void> {
    const { revision: wanted, json } = this.planner.document;
    try {
      const response = await fetch(new URL("scene", this.address), { cache: "no-store" });
      if (!response.ok) throw new Error(String(response.status));
      const page = readFrame<SceneAbout>(await response.arrayBuffer());
      this.stage.replace(sceneryOf(page) as Scenery);
      this.revision = Math.max(page.about.revision ?? wanted, wanted);
      this.drawn = surfacesOf(json);
      if (!this.hasPlace) this.stage.showAll();
      this.hasPlace = true;
      this.showSelection();
    } catch {
      this.planner.say(text.notices.no_scene, true);
    }
  }

  /** Edges of the selected elements. */
  showSelection(): void {
    const { selection } = this.planner;
    const lines = selection.items.flatMap((item) => this.planner.partsOf(item)).flatMap(edgesOf);
    this.chosen.geometry.dispose();
    this.chosen.geometry = new BufferGeometry();
    this.chosen.geometry.setAttribute("position", new BufferAttribute(new Float32Array(lines), 3));
    this.chosen.material.color = colourOf(this.stage.canvas, "--accent");
    this.stage.draw();
  }

  private listen(canvas: HTMLCanvasElement): void {
    let pressed: PointerEvent | null = null;
    const drag = new UnitDrag(this.planner, this.stage);
    // Before the controls of the view, which would turn it.
    canvas.addEventListener(
      "pointerdown",
      (event) => {
        canvas.focus({ preventScroll: true });
        pressed = event.button === 0 ? event : null;
        const mark = pressed && event.pointerType !== "touch" && !this.planner.isPlan ? this.markAt(event) : null;
        if (mark?.devices.kind !== "unit" || !canGrab(this.planner, mark.index)) return;
        canvas.setPointerCapture(event.pointerId);
        drag.press(mark.index, this.placeOf(event));
      },
      { capture: true },
    );
    canvas.addEventListener("pointermove", (event) => drag.move(this.placeOf(event)));
    canvas.addEventListener("pointercancel", () => drag.cancel());
    canvas.addEventListener("pointerup", (event) => {
      if (drag.release()) return;
      if (!pressed || Math.hypot(event.clientX - pressed.clientX, event.clientY - pressed.clientY) > 4) return;
      const { selection } = this.planner;
      const item = this.itemAt(event);
      if (item && event.shiftKey) selection.toggle(item);
      else selection.set(item ? [item] : []);
    });
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  }

  /** Pixels of the canvas. */
  private placeOf({ clientX, clientY }: PointerEvent): Point {
    const box = this.stage.canvas.getBoundingClientRect();
    return [clientX - box.left, clientY - box.top];
  }

  /** The label or unit at the pointer, if it can be selected. */
  private markAt(event: PointerEvent): { devices: Devices; index: number } | null {
    const mark = this.marks.named(this.stage.pick(...this.placeOf(event)));
    return mark && isDeviceFree(mark.devices, mark.index, this.planner.layers) ? mark : null;
  }

  private itemAt(event: PointerEvent): Item | null {
    const { planner, stage } = this;
    const mark = this.markAt(event);
    if (mark) return deviceItem(mark.devices, mark.index);
    const part = prismAt(planner.document.parts.all, stage.rayAt(...this.placeOf(event)), planner.layers);
    return part && itemOf(part);
  }
}

/** What the picture shows: everything but units. */
const surfacesOf = (json: Json): Json[] =>
  isObject(json) ? Object.entries(json).flatMap(([key, value]) => (key === "transceivers" ? [] : [key, value])) : [];

/** The edges of a prism. */
function edgesOf({ outline, height = 0 }: Part): number[] {
  return outline.flatMap(([x, y], k) => {
    const [u, v] = outline[(k + 1) % outline.length];
    return [x, y, 0, u, v, 0, x, y, height, u, v, height, x, y, 0, x, y, height];
  });
}
