// The outlines of the store as SVG, in metres; only those that change are written again.

import { valueAt } from "../document/json";
import type { Part } from "../document/messages";
import { elementAround } from "../elements/kinds";
import { isBare } from "../make/room";
import type { Planner } from "../planner";
import { isOpenLine, itemOf } from "../view/hit";
import { pathOf, svg } from "./svg";

/** From the lowest to the uppermost. */
const order: Part["kind"][] = [
  "room",
  "opening",
  "zone",
  "area",
  "keep_out",
  "fixture",
  "wall",
  "plane",
  "grid",
  "rail",
  "faces",
];

/** Pixels per m. Dashes of long lines take seconds to draw if almost all of the line is outside of the picture. */
const closeScale = 300;

interface Drawn {
  part: Part;
  path: SVGPathElement;
  classes: string;
}

/** Elements with problems and with warnings, by their path, or by their key if they are single copies. */
export interface Marked {
  problems: ReadonlySet<string>;
  warnings: ReadonlySet<string>;
}

export function markedOf({ document }: Planner): Marked {
  const around = (list: readonly { pointer: string; key?: string }[]) =>
    new Set(list.flatMap(({ pointer, key }) => key ?? elementAround(pointer) ?? []));
  return { problems: around(document.problems), warnings: around(document.warnings) };
}

export class Shapes {
  readonly root = svg("svg", { class: "shapes", "aria-hidden": "true" });
  private readonly world = svg("g");
  private readonly groups = new Map<Part["kind"], SVGGElement>();
  private readonly drawn = new Map<string, Drawn>();

  constructor(private readonly planner: Planner) {
    const hatch = svg("pattern", {
      id: "hatch",
      patternUnits: "userSpaceOnUse",
      width: 0.3,
      height: 0.3,
      patternTransform: "rotate(45)",
    });
    hatch.append(svg("path", { d: "M0 0V.3", class: "hatch" }));
    for (const kind of order) {
      const group = svg("g", { class: `kind-${kind}` });
      this.groups.set(kind, group);
      this.world.append(group);
    }
    this.root.append(svg("defs", {}, hatch), this.world);
  }

  /** Follows the viewport. */
  place(): void {
    const { scale, width, height, centre } = this.planner.viewport;
    const [x, y] = [0.5 * width - centre[0] * scale, 0.5 * height + centre[1] * scale];
    this.root.classList.toggle("close", scale > closeScale);
    this.world.setAttribute("transform", `matrix(${scale} 0 0 ${-scale} ${x} ${y})`);
  }

  /** The room of a new shop is in the way of the picture in which people look for their own. */
  fadeRoom(): void {
    const { document, drawing } = this.planner;
    this.root.classList.toggle("bare", drawing !== null && isBare(document.json));
  }

  update(): void {
    const { document, layers } = this.planner;
    for (const [kind, group] of this.groups) group.classList.toggle("off", !layers.isShown(kind));
    const marked = markedOf(this.planner);
    const gone = new Set(this.drawn.keys());
    for (const part of document.parts.all) {
      gone.delete(part.key);
      this.draw(part, marked);
    }
    for (const key of gone) {
      this.drawn.get(key)?.path.remove();
      this.drawn.delete(key);
    }
  }

  private draw(part: Part, marked: Marked): void {
    let drawn = this.drawn.get(part.key);
    const isNew = drawn === undefined;
    if (!drawn) {
      const path = svg("path", { "data-key": part.key, "fill-rule": "evenodd" });
      if (part.kind === "keep_out") path.setAttribute("fill", "url(#hatch)");
      this.groups.get(part.kind)?.append(path);
      drawn = { part, path, classes: "" };
      this.drawn.set(part.key, drawn);
    }
    if (isNew || drawn.part !== part) {
      const outlines = [part.outline, ...(part.holes ?? [])];
      drawn.path.setAttribute("d", outlines.map((outline) => pathOf(outline, isOpenLine(part))).join(""));
      drawn.part = part;
    }
    const classes = this.classesOf(part, marked);
    if (classes !== drawn.classes) {
      drawn.path.setAttribute("class", classes);
      drawn.classes = classes;
    }
  }

  private classesOf(part: Part, { problems, warnings }: Marked): string {
    const { selection } = this.planner;
    const path = part.path ?? "";
    const isIn = (marked: ReadonlySet<string>) => marked.has(path) || marked.has(part.key);
    const isSelected = selection.has(itemOf(part)) || (part.path !== null && selection.has({ kind: "element", path }));
    return [
      part.form ? `form-${part.form}` : "",
      part.type ? `type-${part.type}` : "",
      isSelected ? "selected" : "",
      isIn(problems) ? "wrong" : isIn(warnings) ? "doubtful" : "",
      part.key.startsWith("new ") ? "new" : "",
      part.unfinished ? "unfinished" : "",
      part.kind === "area" && !Array.isArray(valueAt(this.planner.document.json, `${path}/area`)) ? "follows" : "",
    ]
      .filter((name) => name !== "")
      .join(" ");
  }
}
