// The 3-D view: picture, controls and their connections.

import { Card } from "./panel/card";
import { modesOf, type Mode } from "./scene/classes";
import { button, Choice, element, setText } from "../panel/dom";
import { counted, grouped, percentage, significant } from "../data/format";
import { decibels } from "./data/decibels";
import { Legend } from "./panel/legend";
import { LabelList, UnitList } from "./panel/lists";
import { Levels, Thresholds } from "./panel/settings";
import { ShopChoice } from "./panel/shop";
import { Model } from "./data/model";
import { Names } from "../scene/names";
import { onThemeChange } from "../scene/palette";
import { Picture } from "./scene/picture";
import { Stage } from "../scene/stage";
import { changedUnits, fromHash, initialState, toHash, type Selection } from "./data/state";
import { verdicts, type Signals, type Store } from "./data/store";
import { partsOf, plural, say, text } from "./data/text";

const slowestHover = 60; // ms per frame

export class View {
  readonly model: Model;
  readonly stage: Stage;
  readonly picture: Picture;

  private readonly root: HTMLElement;
  private readonly canvas = element("canvas", { class: "v3-canvas", tabindex: 0, role: "application" });
  private readonly frame = element("div", { class: "v3-stage" });
  private readonly names = new Names();
  /** Why there is no picture. */
  private readonly absent = element("p", { class: "v3-absent", role: "status" });
  private readonly tip = element("div", { class: "v3-tip", hidden: true });
  private readonly answer = element("p", { class: "v3-answer", role: "status" });
  private readonly changes = element("p", { class: "v3-note" });
  private readonly legend: Legend;
  private readonly hint = element("p", { class: "v3-note" });
  private readonly figures = element("p", { class: "v3-note v3-figures" });
  private readonly reset: HTMLButtonElement;
  private readonly copied = element("span", { class: "v3-note", role: "status" });
  private readonly dimension: Choice<"space" | "plan">;
  private readonly colour: Choice<Mode>;
  private readonly parts: { update: () => void }[];

  constructor(root: HTMLElement, store: Store, signals: Signals) {
    this.root = root;
    this.model = new Model(store, signals);
    this.canvas.setAttribute("aria-label", text.picture.description);
    this.legend = new Legend(this.model);
    this.names.set(store.fixtures);
    this.frame.append(this.canvas, this.absent, this.names.root, this.tip);
    this.dimension = new Choice(
      "v3-dimension",
      text.tools.view,
      [
        ["space", text.tools.space],
        ["plan", text.tools.plan],
      ],
      (value) => this.setPlan(value === "plan"),
    );
    this.colour = new Choice(
      "v3-colour",
      text.tools.colour,
      modesOf(store).map((mode) => [mode, text.tools.colours[mode]]),
      (mode) => {
        this.model.state.mode = mode;
        if (this.model.state.selection?.kind === "unit") this.model.state.selection = null;
        this.model.changed();
      },
    );
    this.reset = button(text.tools.reset, () => this.restore(null), { title: text.tools.reset_title });
    const card = new Card(this.model, (selection) => this.lookAt(selection));
    const [levels, thresholds] = [new Levels(this.model), new Thresholds(this.model)];
    const shop = new ShopChoice(this.model);
    const units = new UnitList(this.model);
    const labels = new LabelList(this.model, (label) => {
      this.model.select({ kind: "label", index: label });
      this.lookAt({ kind: "label", index: label });
    });
    const showList = (shown: "units" | "labels") => {
      units.root.hidden = shown !== "units";
      labels.root.hidden = shown !== "labels";
      (shown === "units" ? units : labels).update();
    };
    const lists = new Choice(
      "v3-lists",
      text.lists.choose,
      [
        ["units", text.lists.units.name],
        ["labels", text.lists.labels.name],
      ],
      showList,
    );
    lists.show("units");
    const boxed = { class: "v3-box", "aria-label": text.lists.title };
    labels.root.hidden = true;
    this.parts = [card, levels, thresholds, shop, units, labels];
    root.replaceChildren(
      element(
        "div",
        { class: "v3" },
        element("div", { class: "v3-head" }, this.answer, this.changes),
        element(
          "div",
          { class: "v3-tools" },
          this.dimension.root,
          this.colour.root,
          element(
            "div",
            { class: "v3-row" },
            button(text.tools.whole, () => this.stage.showAll()),
            this.reset,
            button(text.tools.link, () => void this.copyLink(), { title: text.tools.link_title }),
            document.fullscreenEnabled ? button(text.tools.full_screen, () => void this.toggleFullScreen()) : null,
            this.copied,
          ),
        ),
        store.states.length > 0 ? shop.root : null,
        element(
          "div",
          { class: "v3-body" },
          element("div", { class: "v3-main" }, this.frame, this.legend.root, this.hint),
          element(
            "div",
            { class: "v3-side" },
            card.root,
            element("section", boxed, lists.root, units.root, labels.root),
          ),
          element("div", { class: "v3-pair" }, thresholds.root, levels.root),
        ),
        this.figures,
      ),
    );

    this.stage = new Stage(this.canvas, store, { marks: store.labels.ids.length });
    this.picture = new Picture(this.stage, this.model);
    this.stage.onDrawn = () => {
      this.names.update(
        this.stage,
        this.model.unitsOn().map((unit) => this.picture.place("unit", unit)),
      );
      this.showFigures();
    };
    this.stage.onPicture = () => this.showPicture();
    this.showPicture();
    this.model.onChange(() => this.update());
    onThemeChange(() => this.picture.recolour());
    new ResizeObserver(() => this.stage.resize(this.frame.clientWidth, this.frame.clientHeight)).observe(this.frame);
    this.stage.resize(this.frame.clientWidth, this.frame.clientHeight);
    this.listen();
    addEventListener("hashchange", () => this.restore(location.hash));
    this.restore(location.hash);
    requestAnimationFrame(() => this.stage.measure(5, 300));
  }

  /** Without a picture, the lists and the requirements beside it work all the same. */
  private showPicture(): void {
    const { hasPicture } = this.stage;
    setText(this.absent, hasPicture ? "" : text.picture.absent);
    this.names.root.hidden = !hasPicture;
  }

  /** Shows the view of a link; without a valid link, the original plan. */
  restore(hash: string | null): void {
    const { store } = this.model;
    const linked = hash === null ? initialState(store) : fromHash(store, hash);
    if (hash !== null && linked === null && hash !== "" && this.root.dataset.ready) return;
    const state = linked ?? initialState(store);
    this.stage.setPlan(state.plan);
    this.stage.showAll();
    if (state.camera) this.stage.setCameraPlace(state.camera);
    if (hash === null && location.hash.startsWith("#view=")) history.replaceState(null, "", "#");
    this.model.replace(state);
    this.root.dataset.ready = "1";
  }

  /** The hash that restores this view. */
  link(): string {
    return toHash(this.model.store, { ...this.model.state, camera: this.stage.cameraPlace() });
  }

  private async copyLink(): Promise<void> {
    location.hash = this.link();
    try {
      await navigator.clipboard.writeText(location.href);
      this.copied.textContent = text.tools.link_copied;
    } catch {
      this.copied.textContent = text.tools.link_shown;
    }
    setTimeout(() => (this.copied.textContent = ""), 4000);
  }

  private async toggleFullScreen(): Promise<void> {
    if (document.fullscreenElement) await document.exitFullscreen();
    else await this.root.requestFullscreen();
  }

  private lookAt({ kind, index }: NonNullable<Selection>): void {
    const { normal } = this.model.store.label;
    const facing = kind === "label" ? Array.from(normal.subarray(3 * index, 3 * index + 3)) : null;
    this.stage.lookAt(this.picture.place(kind, index), kind === "label" ? 2.4 : 12, facing);
  }

  private setPlan(plan: boolean): void {
    this.model.state.plan = plan;
    this.stage.setPlan(plan);
    this.model.changed();
  }

  private update(): void {
    const { state } = this.model;
    this.dimension.show(state.plan ? "plan" : "space");
    this.colour.show(state.mode);
    this.showAnswer();
    this.legend.update(this.picture.update());
    for (const part of this.parts) part.update();
    const hints = state.plan ? text.picture.plan : text.picture.space;
    this.hint.textContent = matchMedia("(pointer: coarse)").matches ? hints.touch : hints.mouse;
    this.stage.draw();
  }

  private showAnswer(): void {
    const { coverage, state, store } = this.model;
    const { added, removed } = changedUnits(store, state);
    const all = store.labels.ids.length;
    const units = this.model.unitsOn().length;
    const share = say(text.numbers.share, grouped(coverage.reached), grouped(all));
    const reached = element("strong", { text: share, "data-fact": "reached" });
    this.answer.replaceChildren(...partsOf(plural(text.answer.reached, units), grouped(units), reached));
    this.answer.classList.toggle("short", coverage.reached < all);
    const name = (unit: number) => store.units.ids[unit];
    const some = (list: number[]) => {
      const first = list.slice(0, 4).map(name).join(", ");
      return list.length > 4 ? say(text.answer.some, first, list.length - 4) : first;
    };
    const parts: string[] = [];
    if (added.length) parts.push(say(text.answer.added, some(added)));
    if (removed.length) parts.push(say(text.answer.removed, some(removed)));
    if (!this.model.hasPlannedThresholds()) parts.push(text.answer.requirements);
    const planned = store.units.selected.length;
    const sentences = parts.length
      ? [
          counted(text.answer.changed, planned, grouped(this.model.plannedReached), parts.join("; ")),
          ...(store.certificate ? [text.answer.not_certified] : []),
        ]
      : planned
        ? [text.answer.original, ...this.certified()]
        : [text.answer.no_plan];
    this.changes.textContent = sentences.join(" ");
  }

  /** The verdicts of the certificate, for the line above the picture. */
  private certified(): string[] {
    const { certificate, label } = this.model.store;
    if (!certificate) return [];
    const counts = verdicts.map((_, verdict) => label.verdict.reduce((sum, of) => sum + (of === verdict ? 1 : 0), 0));
    const words = verdicts.flatMap((verdict, k) =>
      k === 0 || counts[k] > 0 ? [say(text.answer.verdicts[verdict], grouped(counts[k]))] : [],
    );
    return [say(text.answer.certified, percentage(certificate.confidence), words.join(", "))];
  }

  private showFigures(): void {
    const { frameTime, drawCalls } = this.stage;
    const labels = this.picture.labelsShown();
    this.canvas.dataset.labels = String(labels);
    this.canvas.dataset.drawCalls = String(drawCalls);
    if (frameTime === null) return;
    this.canvas.dataset.frameTime = frameTime.toFixed(1);
    this.figures.textContent = say(
      text.picture.drawn,
      counted(text.picture.labels, labels),
      counted(text.picture.levels, this.model.state.levels.filter(Boolean).length),
      `${significant(frameTime, 2)}\u00a0ms`,
    );
  }

  private listen(): void {
    let pressed: { x: number; y: number } | null = null;
    this.canvas.addEventListener("pointerdown", (event) => {
      pressed = event.isPrimary && event.button === 0 ? { x: event.clientX, y: event.clientY } : null;
      this.tip.hidden = true;
    });
    this.canvas.addEventListener("pointerup", (event) => {
      if (!pressed || Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) > 4) return;
      pressed = null;
      this.model.select(this.markAt(event));
    });
    let hovering = false;
    this.canvas.addEventListener("pointermove", (event) => {
      if (event.pointerType !== "mouse" || event.buttons !== 0 || hovering) return;
      if ((this.stage.frameTime ?? 0) > slowestHover) return;
      hovering = true;
      requestAnimationFrame(() => {
        hovering = false;
        this.showTip(event);
      });
    });
    this.canvas.addEventListener("pointerleave", () => (this.tip.hidden = true));
    // Scrolling moves the page until a click gives the picture the focus.
    this.frame.addEventListener(
      "wheel",
      (event) => {
        if (document.activeElement !== this.canvas && !document.fullscreenElement) event.stopPropagation();
      },
      { capture: true },
    );
    this.canvas.addEventListener("keydown", (event) => {
      if (this.key(event)) event.preventDefault();
    });
  }

  private key(event: KeyboardEvent): boolean {
    if (event.ctrlKey || event.metaKey || event.altKey) return false;
    const arrows: Record<string, [number, number]> = {
      ArrowLeft: [-1, 0],
      ArrowRight: [1, 0],
      ArrowUp: [0, 1],
      ArrowDown: [0, -1],
    };
    const arrow = arrows[event.key];
    if (arrow) {
      if (event.shiftKey) this.stage.shift(...arrow);
      else this.stage.turn(...arrow);
      return true;
    }
    if (event.key === "+" || event.key === "=") this.stage.zoom(1.2);
    else if (event.key === "-") this.stage.zoom(1 / 1.2);
    else if (event.key === "0" || event.code === "Digit0" || event.key === "Home") this.stage.showAll();
    else if (event.key === "Escape" && this.model.state.selection) this.model.select(null);
    else return false;
    this.stage.draw();
    return true;
  }

  private markAt(event: PointerEvent): ReturnType<Picture["named"]> {
    const box = this.canvas.getBoundingClientRect();
    return this.picture.named(this.stage.pick(event.clientX - box.left, event.clientY - box.top));
  }

  private showTip(event: PointerEvent): void {
    const mark = this.markAt(event);
    this.tip.hidden = mark === null;
    this.canvas.style.cursor = mark === null ? "grab" : "pointer";
    if (mark === null) return;
    const { coverage, store } = this.model;
    const { factor, name } = store.unit;
    this.tip.textContent =
      mark.kind === "label"
        ? say(
            text.picture.label,
            store.labels.names[mark.index],
            `${significant(coverage.signal[mark.index] / factor)}\u00a0${name}`,
            decibels(coverage.margin(mark.index)),
          )
        : counted(text.picture.unit, coverage.reach[mark.index], store.units.ids[mark.index]);
    const box = this.frame.getBoundingClientRect();
    const x = event.clientX - box.left;
    this.tip.style.left = `${Math.min(x + 12, box.width - this.tip.offsetWidth - 4)}px`;
    this.tip.style.top = `${Math.max(event.clientY - box.top - 34, 2)}px`;
  }
}
