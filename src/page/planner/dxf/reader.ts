// Reads DXF files, strictly: what is not understood is refused or noted, never guessed.

import { assemble } from "./assembly";
import { type Block, emptyBlock, linkBlocks, modelSpace } from "./blocks";
import { blockEnds, Contents, sectionEnds } from "./contents";
import { type DxfDrawing, type DxfLimits, dxfLimits, type DxfNoteCode } from "./drawing";
import { DxfError } from "./error";
import { charsetOf } from "./file/charset";
import { Entity } from "./file/entity";
import { Groups } from "./file/groups";
import { type Header, readHeader } from "./header";
import { Layers } from "./layers";
import { Notes } from "./notes";
import { Lines } from "./shape/lines";
import { characters } from "./text";

/** A circle of 158, 50 or 16 lines. */
const shares: readonly number[] = [5000, 500, 50];
/** Of files with more lines than this, a second reading takes too long. */
const mostReadAgain = 500_000;
/** Files of old programs name no version. */
const oldest = "AC1009";
const unicode = "AC1021";
/** Blocks of layouts, and none. */
const notInserted = /^$|^[*$](MODEL|PAPER)_SPACE/i;
/** Notes of what is shown after all. */
const doubts: ReadonlySet<DxfNoteCode> = new Set(["code_page", "not_utf8", "utf8", "tilted", "coarse"]);
/** Of a drawing that is refused, the message names so many kinds of objects. */
const mostNamed = 5;
const plain = (bytes: Uint8Array): string => String.fromCharCode(...bytes.subarray(0, 1024));

/** Whether the file begins with these characters. */
const beginsWith = (bytes: Uint8Array, text: string): boolean => plain(bytes.subarray(0, text.length)) === text;

/** Where the text begins. */
function checkKind(bytes: Uint8Array, limits: DxfLimits): number {
  if (bytes.length > limits.bytes) throw new DxfError("too_large", { bytes: bytes.length, limit: limits.bytes });
  if (beginsWith(bytes, "AutoCAD Binary DXF")) throw new DxfError("binary");
  const version = plain(bytes.subarray(0, 6));
  if (/^(AC1\.\d|AC\d{4}|MC0\.0)/.test(version)) throw new DxfError("dwg", { version });
  return beginsWith(bytes, "\u00ef\u00bb\u00bf") ? 3 : 0;
}

/** A section of the file: whatever it is, a DXF file begins with one. */
function findFirstSection(groups: Groups): void {
  try {
    do groups.advance();
    while (groups.code === 999);
  } catch {
    throw new DxfError("not_dxf");
  }
  if (!groups.isAt("SECTION")) throw new DxfError("not_dxf");
}

class Reader {
  readonly lines: Lines;
  private readonly notes = new Notes();
  private readonly layers = new Layers();
  private readonly blocks = new Map<string, Block>();
  private readonly model = emptyBlock(modelSpace);
  private readonly classes: string[] = [];
  private readonly entity = new Entity();
  private readonly groups: Groups;
  private readonly contents: Contents;
  private header: Header = { version: null, page: null, unit: null, measurement: null };

  constructor(
    private readonly bytes: Uint8Array,
    private readonly begin: number,
    private readonly limits: DxfLimits,
    private readonly share: number,
  ) {
    this.lines = new Lines(limits.lines, share);
    this.groups = new Groups(bytes, begin, plain);
    const { groups, entity, lines, layers, notes, classes } = this;
    this.contents = new Contents(groups, entity, lines, layers, limits, notes, classes);
  }

  read(): DxfDrawing {
    const { groups, notes, limits, model, lines } = this;
    findFirstSection(groups);
    this.decode();
    for (; !groups.isAt("EOF"); groups.advance()) if (groups.isAt("SECTION")) this.readSection();
    linkBlocks(model, this.blocks, limits, notes);
    if (this.share !== shares[0]) notes.add("coarse", null, lines.pieces(2 * Math.PI));
    const assembled = assemble(model, lines, this.layers, limits, notes);
    if (assembled.layers.length === 0) this.refuse();
    const { version, unit, measurement } = this.header;
    return { version: version ?? oldest, ...assembled, unit, measurement, notes: notes.list() };
  }

  /** Nothing is shown. */
  private refuse(): never {
    const { notes, model } = this;
    const missing = notes.list().filter(({ code }) => !doubts.has(code));
    if (model.objects === 0 || missing.length === 0) throw new DxfError("empty", { paper: notes.count("paper_space") });
    throw new DxfError("unshown", {}, missing.sort((a, b) => b.count - a.count).slice(0, mostNamed));
  }

  /** Texts are decoded as the header says, which comes first. */
  private decode(): void {
    const { version, page } = this.header;
    const stated = this.begin > 0 ? unicode : (version ?? oldest);
    this.groups.decodeBy(charsetOf(stated, page, this.bytes, (code) => this.notes.add(code, page)));
  }

  /** Ends at the last group of the section. */
  private readSection(): void {
    const { groups } = this;
    groups.advance();
    const section = groups.code === 2 ? groups.name() : "";
    if (section === "HEADER") {
      this.header = readHeader(groups);
      this.decode();
    }
    while (groups.code !== 0) groups.advance();
    while (!groups.isAt("ENDSEC")) {
      if (groups.isAt("EOF")) throw new DxfError("truncated", { line: groups.line });
      if (section === "ENTITIES") this.contents.read(this.model, sectionEnds);
      else if (section === "BLOCKS" && groups.isAt("BLOCK")) this.readBlock();
      else if (section === "TABLES" || section === "CLASSES") this.readEntry();
      else this.skipEntity();
    }
  }

  private skipEntity(): void {
    const { groups } = this;
    do groups.advance();
    while (groups.code !== 0);
  }

  private readEntry(): void {
    const { groups, entity } = this;
    entity.read(groups, true);
    if (entity.type === "LAYER" && entity.text(2) !== "") this.layers.define(entity);
    else if (entity.type === "CLASS") this.classes.push(entity.text(1));
  }

  private readBlock(): void {
    const { groups, entity } = this;
    entity.read(groups, true);
    const block = emptyBlock(entity.text(2));
    block.base = entity.point(10);
    if ((entity.number(70) & 4) !== 0) this.notes.add("xref", characters(entity.text(1)) || block.name);
    this.contents.read(block, blockEnds);
    if (!notInserted.test(block.name)) this.blocks.set(block.name.toUpperCase(), block);
  }
}

/** Throws a DxfError for files that cannot be read. The arrays of the drawing can be transferred. */
export function readDxf(bytes: Uint8Array, options: Partial<DxfLimits> = {}): DxfDrawing {
  const limits = { ...dxfLimits, ...options };
  const begin = checkKind(bytes, limits);
  for (const share of shares) {
    const reader = new Reader(bytes, begin, limits, share);
    try {
      return reader.read();
    } catch (error) {
      const { count, curved } = reader.lines;
      const isTooMany = error instanceof DxfError && error.code === "too_many";
      // Coarser curves may help.
      if (!isTooMany || curved === 0 || (count > mostReadAgain && 4 * curved < count)) throw error;
      if (share === shares[shares.length - 1]) throw error;
    }
  }
  throw new DxfError("empty");
}
