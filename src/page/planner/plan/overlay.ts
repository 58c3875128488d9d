// The drawing above the plan, in pixels: the selection, its handles, the marquee, measurements and readings; rings around
// labels and units with problems or warnings.

import type { Part, Point } from "../document/messages";
import { drawingPath } from "../backdrop/drawing";
import { worldAt } from "../backdrop/strokes";
import { traces } from "../draw/traces";
import { moveReadout, sizeReadout, turnReadout } from "../gesture/drags";
import type { Gestures } from "../gesture/gestures";
import { gripsOf } from "../gesture/grips";
import { boundsBetween, rectangle } from "../geometry/bounds";
import { lengthText } from "../geometry/units";
import { between, distance, directionOf, minus, unitAt } from "../geometry/vector";
import type { Planner } from "../planner";
import { placeWords } from "../units/mount";
import { deviceItem, isOpenLine } from "../view/hit";
import type { Item } from "../view/selection";
import { guidesOf, reading, snapMarks } from "./guides";
import { markedOf } from "./shapes";
import { pathOf, svg } from "./svg";

const gripSize = 8; // pixels

export class Overlay {
  readonly root = svg("svg", { class: "overlay", "aria-hidden": "true" });

  constructor(
    private readonly planner: Planner,
    private readonly gestures: Gestures,
  ) {}

  update(): void {
    this.root.replaceChildren(...(this.planner.isPlan ? this.drawn() : []));
  }

  private drawn(): Node[] {
    const { scope } = this.gestures;
    const isBusy = scope.kind === "moving" || scope.kind === "rotating";
    return [
      ...this.flawed(),
      ...this.state(),
      ...this.hovered(),
      ...this.selected(),
      ...(isBusy || scope.kind === "marquee" ? [] : this.grips()),
      ...this.outlines(),
      ...this.marquee(),
      ...this.measures(),
      ...this.picture(),
      ...(scope.kind === "moving" ? guidesOf(this.planner, scope.guides) : []),
      ...this.drawing(),
      ...this.carried(),
      ...this.reading(),
    ];
  }

  private screen(points: readonly Point[]): Point[] {
    return points.map((point) => this.planner.viewport.toScreen(point));
  }

  private outline(part: Part, className: string): SVGPathElement {
    return svg("path", { class: className, d: pathOf(this.screen(part.outline), isOpenLine(part)) });
  }

  private flawed(): Node[] {
    const { document, layers } = this.planner;
    const { problems, warnings } = markedOf(this.planner);
    const ring = (path: string, className: string) =>
      [document.labels, document.units].flatMap((devices) => {
        const index = layers.isShown(devices.kind) ? devices.withPath(path) : undefined;
        return index === undefined ? [] : this.dots(deviceItem(devices, index), className);
      });
    return [
      ...[...warnings].flatMap((path) => ring(path, "doubtful")),
      ...[...problems].flatMap((path) => ring(path, "wrong")),
    ];
  }

  /** Open labels of a plan; or people and objects of a state of the shop, and the labels that are missed in it. */
  private state(): Node[] {
    const { document, plans } = this.planner;
    const { state } = plans;
    const labels = (state?.missed ?? plans.open).filter((index) => index < document.labels.count);
    if (!state) return labels.flatMap((index) => this.dots(deviceItem(document.labels, index), "doubtful"));
    return [
      ...state.blocks.map((outline) => svg("path", { class: "state-block", d: pathOf(this.screen(outline), false) })),
      ...document.parts.all.flatMap((part) =>
        part.kind === "fixture" && state.open_doors.includes(part.id) ? [this.outline(part, "state-doors")] : [],
      ),
      ...labels.flatMap((index) => this.dots(deviceItem(document.labels, index), "wrong")),
    ];
  }

  private hovered(): Node[] {
    const { hovered, scope } = this.gestures;
    if (!hovered || scope.kind !== "idle" || this.planner.tool !== "select") return [];
    return [
      ...this.planner.partsOf(hovered).map((part) => this.outline(part, "hover")),
      ...this.dots(hovered, "hover"),
    ];
  }

  private dots(item: Item, className: string): Node[] {
    return this.screen(this.planner.pointsOf(item)).map(([cx, cy]) =>
      svg("circle", { class: className, cx, cy, r: 9 }),
    );
  }

  private selected(): Node[] {
    const { planner } = this;
    const { items } = planner.selection;
    const drawn = items.flatMap((item) => [
      ...planner
        .partsOf(item)
        .map((part) => this.outline(part, part.locked && item.kind === "copy" ? "chosen locked" : "chosen")),
      ...this.dots(item, "chosen"),
    ]);
    const bounds = items.length > 1 ? planner.selectionBounds : null;
    if (bounds) drawn.push(svg("path", { class: "around", d: pathOf(this.screen(rectangle(bounds))) }));
    return [...drawn, ...this.front()];
  }

  /** An arrow in the direction that a selected fixture faces. */
  private front(): Node[] {
    const { planner } = this;
    const [item] = planner.selection.items;
    if (planner.selection.items.length !== 1 || !item) return [];
    return planner.partsOf(item).flatMap((part) => {
      if (!part.footing || part.kind !== "fixture") return [];
      const { at, rotation, length, depth } = part.footing;
      const [u, v] = [unitAt(rotation), unitAt(rotation + 90)];
      const tip: Point = [at[0] + 0.5 * length * u[0], at[1] + 0.5 * length * u[1]];
      const size = Math.min(0.35 * depth, 0.25 * length);
      const point = (x: number, y: number): Point => [tip[0] + x * u[0] + y * v[0], tip[1] + x * u[1] + y * v[1]];
      const arrow = [point(-size, 1.5 * size), point(0, 0.5 * size), point(size, 1.5 * size)];
      return size * planner.viewport.scale > 3
        ? [svg("path", { class: "front", d: pathOf(this.screen(arrow), true) })]
        : [];
    });
  }

  private grips(): Node[] {
    return gripsOf(this.planner).flatMap(({ handle, screen: [x, y] }) => {
      if (handle === "turn")
        return [
          svg("path", {
            class: "stem",
            d: pathOf(
              [
                [x, y],
                [x, y + 20],
              ],
              true,
            ),
          }),
          svg("circle", { class: "grip turn", cx: x, cy: y, r: 5.5, "data-grip": "turn" }),
        ];
      const half = 0.5 * (handle.isCorner ? gripSize : gripSize - 1);
      return [
        svg("rect", {
          class: handle.id.startsWith("edge") ? "grip edge" : "grip",
          x: x - half,
          y: y - half,
          width: 2 * half,
          height: 2 * half,
          rx: 1.5,
          transform: `rotate(${-handle.turn} ${x} ${y})`,
          "data-grip": handle.id,
        }),
      ];
    });
  }

  /** Outlines of the drawing for which a menu is open. */
  private outlines(): Node[] {
    return (this.planner.outlines ?? []).map((outline) =>
      svg("path", { class: "marquee", d: pathOf(this.screen(outline)) }),
    );
  }

  private marquee(): Node[] {
    const { scope } = this.gestures;
    if (scope.kind !== "marquee") return [];
    const d = pathOf(this.screen(rectangle(boundsBetween(scope))));
    return [svg("path", { class: scope.to[0] < scope.from[0] ? "marquee touching" : "marquee", d })];
  }

  private measures(): Node[] {
    const { scope, measured } = this.gestures;
    const { planner } = this;
    const lines = (all: readonly [Point, Point][]) => all.flatMap(([a, b]) => this.measure(a, b));
    if (scope.kind !== "measuring") return lines(measured);
    const { from, to } = scope;
    return [
      ...lines(from ? [...measured, [from, to.at]] : measured),
      ...(planner.pointer === null ? [] : snapMarks(planner, to)),
    ];
  }

  /** The dragged unit with the way from its old place. */
  private carried(): Node[] {
    const { mover, document } = this.planner;
    const { shown } = mover;
    if (!shown) return [];
    const [x, y] = document.units.at(shown.index);
    const [from, to] = this.screen([
      [x, y],
      [shown.mount.position[0], shown.mount.position[1]],
    ]);
    return [
      svg("path", { class: "guide", d: pathOf([from, to], true) }),
      svg("circle", { class: "chosen", cx: to[0], cy: to[1], r: 9 }),
      ...(mover.isDragging ? [reading([to[0], to[1] + 30], placeWords(shown.mount, document.unit))] : []),
    ];
  }

  private drawing(): Node[] {
    const { scope } = this.gestures;
    const { planner } = this;
    if (scope.kind !== "drawing") return [];
    return [
      ...traces(planner, scope),
      ...(scope.end && (planner.pointer || scope.byKeys) ? snapMarks(planner, scope.end) : []),
    ];
  }

  /** Lines of known length while their tool or the panel of the picture is open, and the line or crop in progress. */
  private picture(): Node[] {
    const { planner } = this;
    const { scope } = this.gestures;
    const { drawing, tool } = planner;
    if (!drawing) return [];
    const at = (pixel: Point) => worldAt(planner, pixel);
    const isOpen = planner.typePath === drawingPath && planner.selection.items.length === 0;
    const { factor } = planner.document.unit;
    const nodes = [drawing.scale, drawing.check].flatMap((line) =>
      line && (isOpen || tool === "scale" || tool === "check")
        ? this.measure(at(line.from), at(line.to), line.length * factor)
        : [],
    );
    if (scope.kind === "cropping") {
      const [[x, y], [u, v]] = [scope.from, scope.to];
      const corners: Point[] = [scope.from, [u, y], [u, v], [x, v]];
      nodes.push(svg("path", { class: "marquee", d: pathOf(this.screen(corners.map(at))) }));
    }
    if (scope.kind !== "scaling") return nodes;
    const end = scope.to ?? scope.at;
    const d = (scope.from && end ? pathOf(this.screen([at(scope.from), at(end)]), true) : "") + this.crossOf(end);
    const marks = scope.mark && !scope.to && planner.pointer ? snapMarks(planner, scope.mark) : [];
    return [...nodes, svg("path", { class: "measure", d }), ...marks];
  }

  private crossOf(pixel: Point | null): string {
    return pixel ? crossAt(...this.planner.viewport.toScreen(worldAt(this.planner, pixel))) : "";
  }

  /** `length`: m, if it is not that of the plan. */
  private measure(a: Point, b: Point, length = distance(a, b)): Node[] {
    const [p, q] = this.screen([a, b]);
    const way = directionOf(minus(q, p));
    const [nx, ny] = unitAt(way + 90).map((value) => 6 * value);
    const ends: [Point, Point][] = [p, q].map(([x, y]) => [
      [x - nx, y - ny],
      [x + nx, y + ny],
    ]);
    const d = [[p, q], ...ends].map((line) => pathOf(line, true)).join("");
    return [
      svg("path", { class: "measure", d }),
      reading(between(p, q), lengthText(length, this.planner.document.unit)),
    ];
  }

  private reading(): Node[] {
    const { scope } = this.gestures;
    const { planner } = this;
    const words =
      scope.kind === "moving"
        ? moveReadout(planner, scope)
        : scope.kind === "rotating"
          ? turnReadout(scope)
          : scope.kind === "resizing"
            ? sizeReadout(planner, scope)
            : "";
    if (words === "" || !planner.pointer) return [];
    const [x, y] = planner.viewport.toScreen(planner.pointer);
    return [reading([x, y + 34], words)];
  }
}

const crossAt = (x: number, y: number): string => `M${x - 8} ${y}H${x + 8}M${x} ${y - 8}V${y + 8}`;
