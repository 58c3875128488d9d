// Reads the entities of model space or of a block.

import type { Block } from "./blocks";
import type { DxfLimits, DxfNoteCode } from "./drawing";
import { DxfError } from "./error";
import type { Entity } from "./file/entity";
import type { Groups } from "./file/groups";
import type { Layers } from "./layers";
import type { Notes } from "./notes";
import { basicShapes } from "./shape/basic";
import type { Lines } from "./shape/lines";
import { combined, directed, identity, type Matrix, mapped, placed } from "./shape/matrix";
import { Polyline } from "./shape/polyline";
import { type Lettering, letteringOf, paragraphsOf } from "./shape/lettering";

/** What ends the entities of a section, and of a block. */
export const sectionEnds: ReadonlySet<string> = new Set(["ENDSEC", "EOF"]);
export const blockEnds: ReadonlySet<string> = new Set([...sectionEnds, "ENDBLK", "BLOCK"]);
/** Neither drawn nor worth a note. */
const silent: ReadonlySet<string> = new Set(["SEQEND", "POINT", "VERTEX"]);
/** Three-dimensional, as most objects of these kinds are. */
const solids = /^(3DSOLID|BODY|REGION|MESH|\w*SURFACE)$/;
const dimensions: ReadonlySet<string> = new Set(["DIMENSION", "ARC_DIMENSION", "LARGE_RADIAL_DIMENSION"]);
const proxies: ReadonlySet<string> = new Set(["ACAD_PROXY_ENTITY", "ACAD_PROXY_GRAPHIC"]);
const others: ReadonlySet<string> = new Set(["POLYLINE", "INSERT", "TEXT", "MTEXT", "ATTRIB", "ATTDEF"]);
/** The classes of a file are counted from here. */
const firstClass = 500;
const mostInserts = 500_000;

function noteOf(kind: string, otherwise: DxfNoteCode = "unsupported"): DxfNoteCode {
  if (kind.startsWith("AEC")) return "aec";
  return solids.test(kind) ? "solid" : otherwise;
}

const isDrawn = (type: string): boolean =>
  basicShapes.has(type) || others.has(type) || dimensions.has(type) || proxies.has(type);

export class Contents {
  private inserts = 0;
  private texts = 0;

  constructor(
    private readonly groups: Groups,
    private readonly entity: Entity,
    private readonly lines: Lines,
    private readonly layers: Layers,
    private readonly limits: DxfLimits,
    private readonly notes: Notes,
    /** The names of the file's own classes. */
    private readonly classes: readonly string[],
  ) {}

  /** Adds the entities up to one of the ends. */
  read(block: Block, ends: ReadonlySet<string>): void {
    const { groups, lines } = this;
    lines.block = block.name;
    block.lines[0] = lines.count;
    block.outlines[0] = lines.outlines.length;
    for (let type = groups.name(); !ends.has(type); type = groups.name()) this.readEntity(block, type);
    block.lines[1] = lines.count;
    block.outlines[1] = lines.outlines.length;
  }

  private readEntity(block: Block, type: string): void {
    const { groups, entity, notes } = this;
    entity.read(groups, isDrawn(type));
    if (silent.has(type)) return;
    if (!entity.isInPaperSpace) ++block.objects;
    const isShown = this.isShown();
    const shape = basicShapes.get(type);
    if (type === "POLYLINE") this.addPolyline(isShown);
    else if (!isShown) return;
    else if (shape) {
      this.lines.begin(this.layers.index(entity.layer), shape.isPlanar ? this.plane() : identity);
      if (!shape.draw(this.lines, entity)) notes.add("unsupported", type);
    } else if (type === "INSERT") this.addInsert(block);
    else if (dimensions.has(type)) this.addDimension(block);
    else if (type === "MTEXT") this.addText(block, paragraphsOf(entity));
    else if (type === "TEXT" || type === "ATTRIB") this.addText(block, letteringOf(entity));
    else if (type === "ATTDEF") {
      // What an insert shows of it is an ATTRIB, unless it is constant.
      if ((entity.number(70) & 2) !== 0) this.addText(block, letteringOf(entity));
    } else if (proxies.has(type)) {
      const kind = this.classes[entity.number(91) - firstClass] ?? type;
      notes.add(noteOf(kind, "proxy"), kind);
    } else notes.add(noteOf(type), type);
  }

  private isShown(): boolean {
    const { entity } = this;
    const isHiddenAttribute = (entity.type === "ATTRIB" || entity.type === "ATTDEF") && (entity.number(70) & 1) !== 0;
    if (entity.isInPaperSpace) this.notes.add("paper_space");
    else if (entity.isInvisible || isHiddenAttribute) this.notes.add("invisible");
    else return true;
    return false;
  }

  /** From the plane of the entity. */
  private plane(): Matrix {
    const { entity } = this;
    if (entity.isTilted) this.notes.add("tilted");
    return entity.ocs();
  }

  private addPolyline(isShown: boolean): void {
    const { groups, entity, lines, notes } = this;
    const flags = entity.number(70);
    const isMesh = (flags & (16 | 64)) !== 0;
    if (isShown && isMesh) notes.add("solid", (flags & 16) !== 0 ? "POLYMESH" : "POLYFACE");
    const isSpatial = (flags & 8) !== 0;
    const usual: [number, number] = isSpatial ? [0, 0] : [entity.number(40), entity.number(41)];
    const polyline = isShown && !isMesh ? new Polyline(lines, usual) : null;
    if (polyline) lines.begin(this.layers.index(entity.layer), isSpatial ? identity : this.plane());
    while (groups.isAt("VERTEX")) {
      entity.read(groups, polyline !== null);
      // The frame of a curve is not part of it.
      if (!polyline || (entity.number(70) & 16) !== 0) continue;
      polyline.add(entity.number(10), entity.number(20));
      polyline.bend(entity.number(42));
      if (!isSpatial) for (const end of [0, 1] as const) polyline.widen(end, entity.number(40 + end, usual[end]));
    }
    polyline?.finishOutline((flags & 1) !== 0);
  }

  private addInsert(block: Block): void {
    const { entity } = this;
    const turned = combined(this.plane(), placed(entity.point(10), entity.number(50)));
    this.insert(block, {
      name: entity.text(2),
      layer: this.layers.index(entity.layer),
      at: combined(turned, [entity.number(41, 1), 0, 0, entity.number(42, 1), 0, 0]),
      columns: Math.max(1, Math.trunc(entity.number(70, 1))),
      rows: Math.max(1, Math.trunc(entity.number(71, 1))),
      column: directed(turned, [entity.number(44), 0]),
      row: directed(turned, [0, entity.number(45)]),
      isDimension: false,
    });
  }

  /** Its block is drawn in the coordinates of the drawing. */
  private addDimension(block: Block): void {
    const { entity } = this;
    const name = entity.text(2);
    const layer = this.layers.index(entity.layer);
    const at = placed(entity.point(12), 0);
    this.insert(block, { name, layer, at, columns: 1, rows: 1, column: [0, 0], row: [0, 0], isDimension: true });
  }

  private insert(block: Block, insert: Block["inserts"][number]): void {
    if (++this.inserts > mostInserts) throw new DxfError("too_many", { block: block.name, limit: mostInserts });
    block.inserts.push(insert);
  }

  private addText(block: Block, { text, at, anchor, along, up, isPlanar }: Lettering): void {
    if (text.trim() === "") return;
    if (++this.texts > this.limits.texts) {
      this.notes.add("texts_left_out");
      return;
    }
    const plane = this.plane();
    block.texts.push({
      layer: this.layers.index(this.entity.layer),
      at: isPlanar ? mapped(plane, at) : at,
      anchor,
      along: directed(plane, along),
      up: directed(plane, up),
      text,
    });
  }
}
