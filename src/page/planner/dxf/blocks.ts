// Blocks, and how they stand in one another.

import type { DxfLimits } from "./drawing";
import { DxfError } from "./error";
import type { Notes } from "./notes";
import { combined, type Matrix } from "./shape/matrix";

export const modelSpace = "*Model_Space";

export interface BlockText {
  layer: number;
  at: [number, number];
  anchor: [number, number];
  /** In the direction of reading, with length 1. */
  along: [number, number];
  /** To the upper end of a letter. */
  up: [number, number];
  text: string;
}

export interface Insert {
  name: string;
  layer: number;
  /** From the block, about its base point, to where it stands first. */
  at: Matrix;
  columns: number;
  rows: number;
  /** The steps from column to column and from row to row. */
  column: [number, number];
  row: [number, number];
  /** Of a dimension: it has no other picture than its block. */
  isDimension: boolean;
  block?: Block;
}

export interface Block {
  name: string;
  base: [number, number];
  /** Its lines, from the first to before the last. */
  lines: [number, number];
  /** Its part of the list of outlines. */
  outlines: [number, number];
  texts: BlockText[];
  inserts: Insert[];
  /** Its entities, also those that are not shown. */
  objects: number;
  /** With all that stands in it. */
  content: number;
  levels: number;
}

export const emptyBlock = (name: string): Block => ({
  name,
  base: [0, 0],
  lines: [0, 0],
  outlines: [0, 0],
  texts: [],
  inserts: [],
  objects: 0,
  content: 0,
  levels: 0,
});

/** As many as a reader of hostile files may follow. */
const mostLevels = 32;

const copiesOf = ({ columns, rows }: Insert): number => columns * rows;

/** Counts what a block shows. Its blocks are counted. */
function count(block: Block, limits: DxfLimits, notes: Notes): void {
  const shares = new Map<string, number>();
  block.content = block.lines[1] - block.lines[0] + block.texts.length;
  block.levels = 1;
  for (const insert of block.inserts) {
    if (insert.isDimension && !insert.block?.content) notes.add("dimension");
    if (!insert.block) continue;
    const share = copiesOf(insert) * insert.block.content;
    shares.set(insert.block.name, (shares.get(insert.block.name) ?? 0) + share);
    block.content += share;
    block.levels = Math.max(block.levels, insert.block.levels + 1);
  }
  if (block.levels > mostLevels) throw new DxfError("too_deep", { block: block.name, limit: mostLevels });
  if (block.content > limits.lines) {
    const [name] = [...shares].reduce((most, one) => (one[1] > most[1] ? one : most), [block.name, 0]);
    throw new DxfError("too_many", { block: name, limit: limits.lines });
  }
}

/**
 * Links the inserts of model space and of the blocks that it shows with their blocks, drops those that lead to nothing
 * or back to themselves, and counts the lines before any is copied.
 */
export function linkBlocks(model: Block, blocks: ReadonlyMap<string, Block>, limits: DxfLimits, notes: Notes): void {
  const isOpen = new Map<Block, boolean>([[model, true]]);
  const path: { block: Block; next: number }[] = [{ block: model, next: 0 }];
  while (path.length > 0) {
    const place = path[path.length - 1];
    const { block } = place;
    if (place.next === block.inserts.length) {
      count(block, limits, notes);
      isOpen.set(block, false);
      path.pop();
      continue;
    }
    const insert = block.inserts[place.next++];
    const target = blocks.get(insert.name.toUpperCase());
    if (!target) {
      if (!insert.isDimension) notes.add("missing_block", insert.name);
    } else if (isOpen.get(target)) notes.add("recursive_block", target.name);
    else {
      insert.block = target;
      if (!isOpen.has(target)) {
        isOpen.set(target, true);
        path.push({ block: target, next: 0 });
      }
    }
  }
}

/** What a block shows at one place. */
export interface Shown {
  block: Block;
  at: Matrix;
  /** The layer of objects on layer "0". */
  layer: number;
  /** The layer of everything, or -1. */
  forced: number;
}

/** Visits each copy of each block that shows something. */
export function visitBlocks(shown: Shown, isFrozen: (layer: number) => boolean, visit: (shown: Shown) => void): void {
  visit(shown);
  for (const insert of shown.block.inserts) {
    const { block } = insert;
    if (!block || block.content === 0) continue;
    const layer = insert.layer === 0 ? shown.layer : insert.layer;
    // A frozen layer hides all of its blocks.
    const forced = shown.forced < 0 && isFrozen(layer) ? layer : shown.forced;
    const [a, b, c, d, e, f] = insert.at;
    const [x, y] = block.base;
    for (let row = 0; row < insert.rows; ++row)
      for (let column = 0; column < insert.columns; ++column) {
        const dx = e - a * x - c * y + column * insert.column[0] + row * insert.row[0];
        const dy = f - b * x - d * y + column * insert.column[1] + row * insert.row[1];
        visitBlocks({ block, at: combined(shown.at, [a, b, c, d, dx, dy]), layer, forced }, isFrozen, visit);
      }
  }
}
