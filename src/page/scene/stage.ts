// The picture: cameras, objects, and picking of the mark at a point. Draws only after changes.

import {
  ColorManagement,
  Group,
  LinearSRGBColorSpace,
  NearestFilter,
  OrthographicCamera,
  PerspectiveCamera,
  Raycaster,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
  WebGLRenderTarget,
} from "three";
import { MapControls } from "three/examples/jsm/controls/MapControls.js";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

import { Fixtures } from "./fixtures";
import { FlatPlan } from "./flat";
import { Links } from "./links";
import type { Marks } from "./marks";
import { colourOf } from "./palette";
import { isSoftware } from "./software";
import type { Scenery } from "../data/scenery";

ColorManagement.enabled = false;

const fieldOfView = 40;
const highest = 1000; // m; above and below what can be in a store
const mostSmooth = 10000; // marks
/** The initial direction of view, and the share of the picture that the store fills. */
const firstWay = new Vector3(-0.36, -0.72, 0.78).normalize();
const fill = 0.95;
const pickSize = 15; // CSS pixels per side

/** Positions in m; `zoom` applies to the plan view. */
export interface CameraPlace {
  at: number[];
  target: number[];
  zoom: number;
}

export interface StageOptions {
  /** The usual number of marks. */
  marks: number;
  /**
   * The plan shows marks only, above what lies behind the canvas, and its camera is placed by `placeAbove` instead of the
   * pointer.
   */
  overlay?: boolean;
}

export class Stage {
  readonly links = new Links();
  /** Objects of the caller. */
  readonly extras = new Group();
  fixtures: Fixtures;
  drawCalls = 0;
  /** Median time of the last measured frames, ms; null before the first measurement. */
  frameTime: number | null = null;
  onDrawn: () => void = () => {};
  /** The browser has taken the picture away, or given it back. */
  onPicture: () => void = () => {};

  /** Null without WebGL. */
  private readonly renderer: WebGLRenderer | null;
  private readonly flat: FlatPlan;
  private readonly scene = new Scene();
  private readonly perspective = new PerspectiveCamera(fieldOfView, 1, 0.1, 1000);
  private readonly above = new OrthographicCamera(-1, 1, 1, -1, 0.1, 1000);
  readonly orbit: OrbitControls; // of the 3-D view
  private readonly pan: MapControls;
  private marks: Marks[] = [];
  private readonly pickTarget = new WebGLRenderTarget(pickSize, pickSize, {
    minFilter: NearestFilter,
    magFilter: NearestFilter,
  });
  private isPlan = false;
  private pending = false;
  private width = 1;
  private height = 1;

  constructor(
    readonly canvas: HTMLCanvasElement,
    private scenery: Scenery,
    private readonly options: StageOptions,
  ) {
    const alpha = options.overlay ?? false;
    const antialias = options.marks <= mostSmooth && !(alpha && isSoftware()); // edges that are worth their time
    const context = canvas.getContext("webgl2", { alpha: true, antialias, powerPreference: "high-performance" });
    this.flat = new FlatPlan(canvas);
    this.renderer = context && new WebGLRenderer({ canvas, context });
    if (this.renderer) this.renderer.outputColorSpace = LinearSRGBColorSpace;
    for (const event of ["webglcontextlost", "webglcontextrestored"])
      canvas.addEventListener(event, () => {
        this.blendMarks();
        this.recolour();
        this.onPicture();
      });
    this.fixtures = new Fixtures(scenery);
    this.scene.add(this.fixtures.group, this.links.mesh, this.extras);
    this.perspective.up.set(0, 0, 1);
    this.above.up.set(0, 1, 0);
    this.orbit = new OrbitControls(this.perspective, canvas);
    this.pan = new MapControls(this.above, canvas);
    this.orbit.maxPolarAngle = 0.5 * Math.PI - 0.02;
    this.orbit.zoomToCursor = true;
    this.pan.zoomToCursor = true;
    this.pan.enableRotate = false;
    this.pan.screenSpacePanning = true;
    for (const controls of [this.orbit, this.pan]) controls.addEventListener("change", () => this.draw());
    this.pan.enabled = false;
    canvas.style.touchAction = "pan-y";
    this.showAll();
  }

  /** Shows another store, or the same after changes, from the same place. */
  replace(scenery: Scenery): void {
    this.scene.remove(this.fixtures.group);
    this.fixtures.dispose();
    this.scenery = scenery;
    this.fixtures = new Fixtures(scenery);
    this.scene.add(this.fixtures.group);
    this.setPlan(this.isPlan);
    this.recolour();
  }

  add(...marks: Marks[]): void {
    for (const added of marks) {
      this.marks.push(added);
      this.scene.add(added.mesh);
    }
    this.blendMarks();
  }

  remove(...marks: Marks[]): void {
    this.marks = this.marks.filter((mark) => !marks.includes(mark));
    for (const removed of marks) {
      this.scene.remove(removed.mesh);
      removed.dispose();
    }
  }

  /** What draws; null without WebGL, and while the browser has taken it away. */
  private get drawing(): WebGLRenderer | null {
    return this.renderer?.getContext().isContextLost() ? null : this.renderer;
  }

  /** Without a picture, marks of an overlay are drawn all the same. */
  get hasPicture(): boolean {
    return this.drawing !== null;
  }

  private get isOverlay(): boolean {
    return this.isPlan && this.options.overlay === true;
  }

  private blendMarks(): void {
    const { antialias = false } = this.renderer?.getContext().getContextAttributes() ?? {};
    for (const marks of this.marks) marks.blend(this.isOverlay, antialias);
  }

  /** Moves the camera back from the middle of the store until its corners fill the picture. */
  private fit(): { middle: Vector3; distance: number } {
    const [a, b] = [this.scenery.lower, this.scenery.upper];
    const middle = new Vector3(0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), a[2] + 0.2 * (b[2] - a[2]));
    const right = new Vector3().crossVectors(this.perspective.up, firstWay).normalize();
    const up = new Vector3().crossVectors(firstWay, right);
    const tangent = fill * Math.tan((0.5 * fieldOfView * Math.PI) / 180);
    let distance = 1;
    for (let corner = 0; corner < 8; ++corner) {
      const at = new Vector3(...[0, 1, 2].map((axis) => ((corner >> axis) & 1 ? b : a)[axis])).sub(middle);
      const wide = Math.abs(at.dot(right)) / (this.width / this.height);
      distance = Math.max(distance, at.dot(firstWay) + Math.max(wide, Math.abs(at.dot(up))) / tangent);
    }
    return { middle, distance };
  }

  showAll(): void {
    const [a, b] = [this.scenery.lower, this.scenery.upper];
    const wide = this.width / this.height;
    const { middle, distance } = this.fit();
    this.perspective.position.copy(middle).addScaledVector(firstWay, distance);
    this.orbit.target.copy(middle);
    this.perspective.near = Math.max(0.05, distance / 500);
    this.perspective.far = 6 * distance;
    this.orbit.update();
    // An overlay stays where it is: the picture may arrive when the plan is shown again.
    if (!this.options.overlay) {
      this.above.position.set(middle.x, middle.y, b[2] + 10);
      this.above.far = b[2] - a[2] + 20;
      this.pan.target.set(middle.x, middle.y, a[2]);
      this.above.zoom = 1 / (1.06 * Math.max(b[1] - a[1], (b[0] - a[0]) / wide));
      this.pan.update();
    }
    this.updateCameras();
  }

  setPlan(plan: boolean): void {
    this.isPlan = plan;
    this.orbit.enabled = !plan;
    this.pan.enabled = plan && !this.options.overlay;
    this.fixtures.group.visible = !this.isOverlay;
    this.renderer?.setClearAlpha(this.isOverlay ? 0 : 1);
    this.blendMarks();
    this.draw();
  }

  /** Puts the camera of the plan above a point; `scale`: CSS pixels per m. */
  placeAbove(x: number, y: number, scale: number): void {
    // Marks may lie outside of the scenery, which is that of the last 3-D picture, if there was one.
    this.above.position.set(x, y, highest);
    this.above.far = 2 * highest;
    this.pan.target.set(x, y, 0);
    this.above.zoom = scale / this.height;
    this.pan.update();
    this.updateCameras();
    this.draw();
  }

  cameraPlace(): CameraPlace {
    const [camera, controls] = this.current();
    return { at: camera.position.toArray(), target: controls.target.toArray(), zoom: 1 / this.above.zoom };
  }

  setCameraPlace({ at, target, zoom }: CameraPlace): void {
    const [camera, controls] = this.current();
    camera.position.set(at[0], at[1], at[2]);
    controls.target.set(target[0], target[1], target[2]);
    this.above.zoom = 1 / zoom;
    this.moved();
  }

  private current(): [PerspectiveCamera, OrbitControls] | [OrthographicCamera, MapControls] {
    return this.isPlan ? [this.above, this.pan] : [this.perspective, this.orbit];
  }

  /** Turns (in the plan: shifts) by steps of one key press. */
  turn(right: number, up: number): void {
    if (this.isPlan) {
      this.shift(right, up);
      return;
    }
    const way = this.perspective.position.clone().sub(this.orbit.target);
    const distance = way.length();
    const around = Math.atan2(way.y, way.x) + right * 0.12;
    const tilt = Math.min(Math.max(Math.acos(way.z / distance) - up * 0.08, 0.02), this.orbit.maxPolarAngle);
    way.set(Math.sin(tilt) * Math.cos(around), Math.sin(tilt) * Math.sin(around), Math.cos(tilt));
    this.perspective.position.copy(this.orbit.target).addScaledVector(way, distance);
    this.moved();
  }

  shift(right: number, up: number): void {
    const [camera, controls] = this.current();
    const step = this.isPlan ? 0.08 / this.above.zoom : 0.06 * camera.position.distanceTo(controls.target);
    const x = new Vector3().setFromMatrixColumn(camera.matrix, 0).setZ(0).normalize();
    const ahead = new Vector3(-x.y, x.x, 0);
    const move = x.multiplyScalar(right * step).addScaledVector(ahead, up * step);
    camera.position.add(move);
    controls.target.add(move);
    this.moved();
  }

  zoom(factor: number): void {
    if (this.isPlan) this.above.zoom *= factor;
    else this.perspective.position.lerpVectors(this.orbit.target, this.perspective.position.clone(), 1 / factor);
    this.moved();
  }

  /** Looks at a point from a distance in metres, from the side that it faces, if any. */
  lookAt(point: number[], distance: number, facing: number[] | null): void {
    const [camera, controls] = this.current();
    const way = camera.position.clone().sub(controls.target);
    controls.target.set(point[0], point[1], this.isPlan ? controls.target.z : point[2]);
    if (this.isPlan) this.above.zoom = Math.max(this.above.zoom, 0.5 / distance);
    else {
      // Along the shelf and from above, so that the opposite shelf does not hide the point.
      if (facing) way.set(0.5 * facing[0] + 0.6 * facing[1], 0.5 * facing[1] - 0.6 * facing[0], 0.55);
      way.setLength(facing ? distance : Math.min(way.length(), distance));
    }
    camera.position.copy(controls.target).add(way);
    this.moved();
  }

  resize(width: number, height: number): void {
    if (width < 1 || height < 1) return;
    this.width = width;
    this.height = height;
    this.renderer?.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer?.setSize(width, height, false);
    this.perspective.aspect = width / height;
    this.updateCameras();
    this.draw();
  }

  recolour(): void {
    this.renderer?.setClearColor(colourOf(this.canvas, "--stage"), this.isOverlay ? 0 : 1);
    this.fixtures.recolour(this.canvas);
    const { direct, reflected, unknown } = this.links.mesh.material.uniforms;
    direct.value = colourOf(this.canvas, "--direct");
    reflected.value = colourOf(this.canvas, "--reflected");
    unknown.value = colourOf(this.canvas, "--edge");
    this.draw();
  }

  draw(): void {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => this.drawPending());
  }

  /** Does not wait for the next frame. */
  drawPending(): void {
    if (!this.pending) return;
    this.pending = false;
    this.render();
    this.onDrawn();
  }

  /** Draws one frame, then times several (limited by count and ms) and stores the median time. */
  measure(frames: number, longest = Infinity): number {
    const gl = this.drawing?.getContext();
    if (!gl) return NaN;
    const pixel = new Uint8Array(4);
    const times: number[] = [];
    let end = 0;
    // The first frame compiles the shaders.
    for (let k = 0; k <= frames && (k < 2 || performance.now() < end); ++k) {
      const begin = performance.now();
      if (k === 1) end = begin + longest;
      this.render();
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      if (k > 0) times.push(performance.now() - begin);
    }
    times.sort((a, b) => a - b);
    this.frameTime = times[Math.floor(times.length / 2)];
    this.onDrawn();
    return this.frameTime;
  }

  /** The visible mark nearest to a point of the canvas (CSS pixels); 0 for none. */
  pick(x: number, y: number): number {
    const { drawing } = this;
    if (!drawing) return 0;
    const [camera] = this.current();
    const reach = (pickSize - 1) / 2;
    camera.setViewOffset(this.width, this.height, x - reach - 0.5, y - reach - 0.5, pickSize, pickSize);
    for (const marks of this.marks) marks.uniform("picking").value = true;
    const links = this.links.mesh.visible;
    this.links.mesh.visible = false;
    drawing.setRenderTarget(this.pickTarget);
    const clear = colourOf(this.canvas, "--stage");
    drawing.setClearColor(0, 0);
    this.withoutColour(() => drawing.render(this.scene, camera));
    const pixels = new Uint8Array(4 * pickSize * pickSize);
    drawing.readRenderTargetPixels(this.pickTarget, 0, 0, pickSize, pickSize, pixels);
    drawing.setRenderTarget(null);
    drawing.setClearColor(clear, this.isOverlay ? 0 : 1);
    this.links.mesh.visible = links;
    for (const marks of this.marks) marks.uniform("picking").value = false;
    camera.clearViewOffset();

    const idents = new Uint32Array(pixels.buffer);
    let nearest = Infinity;
    let found = 0;
    idents.forEach((ident, k) => {
      const away = Math.hypot((k % pickSize) - reach, Math.floor(k / pickSize) - reach);
      if (ident !== 0 && away < nearest) [nearest, found] = [away, ident];
    });
    return found;
  }

  /** CSS pixels. */
  get size(): { width: number; height: number } {
    return { width: this.width, height: this.height };
  }

  /** The position of a point of the store on the canvas in CSS pixels, and its depth, below 1 within the view. */
  project(point: number[]): { x: number; y: number; depth: number } {
    const [camera] = this.current();
    camera.updateMatrixWorld();
    const at = new Vector3(point[0], point[1], point[2]).project(camera);
    return { x: 0.5 * (at.x + 1) * this.width, y: 0.5 * (1 - at.y) * this.height, depth: at.z };
  }

  /** The line of sight through a point of the canvas (CSS pixels). */
  rayAt(x: number, y: number): { from: number[]; way: number[] } {
    const [camera] = this.current();
    const caster = new Raycaster();
    caster.setFromCamera(new Vector2((2 * x) / this.width - 1, 1 - (2 * y) / this.height), camera);
    return { from: caster.ray.origin.toArray(), way: caster.ray.direction.toArray() };
  }

  private withoutColour(draw: () => void): void {
    const materials = this.fixtures.materials();
    for (const material of materials) material.colorWrite = false;
    draw();
    for (const material of materials) material.colorWrite = true;
  }

  private updateCameras(): void {
    this.perspective.updateProjectionMatrix();
    const wide = this.width / this.height;
    [this.above.left, this.above.right, this.above.top, this.above.bottom] = [-0.5 * wide, 0.5 * wide, 0.5, -0.5];
    this.above.updateProjectionMatrix();
  }

  private moved(): void {
    this.current()[1].update();
    this.updateCameras();
    this.draw();
  }

  private render(): void {
    const [camera] = this.current();
    const pixel = this.isPlan
      ? 1 / this.above.zoom / this.height
      : (2 * Math.tan((0.5 * fieldOfView * Math.PI) / 180)) / this.height;
    for (const marks of this.marks) {
      marks.uniform("pixel").value = pixel;
      marks.uniform("perspective").value = !this.isPlan;
    }
    this.links.mesh.material.uniforms.view.value.set(this.width, this.height);
    const { drawing, width, height } = this;
    const { x, y } = this.above.position;
    if (drawing || !this.isOverlay) this.flat.hide();
    else this.flat.draw(this.marks, this.links, { middle: [x, y], scale: this.above.zoom * height, width, height });
    if (!drawing) return;
    drawing.render(this.scene, camera);
    this.drawCalls = drawing.info.render.calls;
  }
}
