// The 3-D picture: fetched when it is shown, and again after changes.

import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments } from "three";

import { readFrame } from "../../data/page_data";
import { sceneryOf, type Scenery } from "../../data/scenery";
import { colourOf } from "../../scene/palette";
import type { Stage } from "../../scene/stage";
import type { Part } from "../document/messages";
import { deviceItem, isDeviceFree, itemOf } from "../view/hit";
import type { Item } from "../view/selection";
import type { DeviceMarks } from "../plan/marks";
import type { Planner } from "../planner";
import { text } from "../text";
import { prismAt } from "./prisms";

interface SceneAbout {
  revision: number;
  lower: number[];
  upper: number[];
}

const pause = 300; // ms without changes before the picture is fetched again

export class Space {
  private revision = -1;
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
    if (planner.isPlan || this.revision === planner.document.revision) return;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.fetch(), this.revision < 0 ? 0 : pause);
  }

  private async fetch(): Promise<void> {
    const wanted = this.planner.document.revision;
    try {
      const response = await fetch(new URL("scene", this.address), { cache: "no-store" });
      if (!response.ok) throw new Error(String(response.status));
      const page = readFrame<SceneAbout>(await response.arrayBuffer());
      this.stage.replace(sceneryOf(page) as Scenery);
      this.revision = Math.max(page.about.revision ?? wanted, wanted);
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
    canvas.addEventListener("pointerdown", (event) => {
      canvas.focus({ preventScroll: true });
      pressed = event.button === 0 ? event : null;
    });
    canvas.addEventListener("pointerup", (event) => {
      if (!pressed || Math.hypot(event.clientX - pressed.clientX, event.clientY - pressed.clientY) > 4) return;
      const { selection } = this.planner;
      const item = this.itemAt(event);
      if (item && event.shiftKey) selection.toggle(item);
      else selection.set(item ? [item] : []);
    });
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  }

  private itemAt({ clientX, clientY }: PointerEvent): Item | null {
    const { planner, stage } = this;
    const box = stage.canvas.getBoundingClientRect();
    const [x, y] = [clientX - box.left, clientY - box.top];
    const mark = this.marks.named(stage.pick(x, y));
    if (mark && isDeviceFree(mark.devices, mark.index, planner.layers)) return deviceItem(mark.devices, mark.index);
    const part = prismAt(planner.document.parts.all, stage.rayAt(x, y), planner.layers);
    return part && itemOf(part);
  }
}

/** The edges of a prism. */
function edgesOf({ outline, height = 0 }: Part): number[] {
  return outline.flatMap(([x, y], k) => {
    const [u, v] = outline[(k + 1) % outline.length];
    return [x, y, 0, u, v, 0, x, y, height, u, v, height, x, y, 0, x, y, height];
  });
}
