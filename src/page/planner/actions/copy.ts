// Copies, pastes, duplicates and deletes the selected elements.

import { EditBuilder } from "../document/edit";
import { pointerTo, type Json } from "../document/json";
import type { Part, Point } from "../document/messages";
import { noPreview, type Preview } from "../document/preview";
import { contextOf } from "../elements/context";
import { addCopies, idsOf, type Copied } from "../elements/copies";
import { elementAt, kindOf, listOf, type StoreElement } from "../elements/kinds";
import { addTypes, typesNamedBy, type Types } from "../elements/types";
import { moveElement } from "../elements/motion";
import { namesOf } from "../elements/names";
import { boundsOf, middleOf } from "../geometry/bounds";
import { movedPart, shiftBy } from "../geometry/rigid";
import { stepped } from "../geometry/units";
import { minus } from "../geometry/vector";
import type { Planner } from "../planner";
import { say, text } from "../text";
import { removeUnits } from "../units/act";

function copiesOf(planner: Planner, elements: readonly StoreElement[]): Copied[] {
  return elements
    .filter(({ kind }) => kind !== "room")
    .flatMap(({ path, kind, value }) => {
      const context = contextOf(planner.document, path);
      const bounds = planner.boundsOfItem({ kind: "element", path });
      if (!context || !bounds) return [];
      return [{ kind, value, effective: context.effective, part: context.parts[0] ?? null, middle: middleOf(bounds) }];
    });
}

/** False if nothing that is selected can be copied. */
export function copySelection(planner: Planner): boolean {
  const { document, selected } = planner;
  const copied = copiesOf(planner, selected);
  if (copied.length === 0) return false;
  const types = typesNamedBy(
    copied.map(({ value }) => value),
    document.json,
  );
  planner.clip = { copied, unit: document.unit.name, types };
  planner.say(say(text.notices.copied, namesOf(selected)));
  return true;
}

/** A shift whose numbers have no more decimals than those of a drag. */
export function wholeSteps(planner: Planner, [x, y]: Point): Point {
  const { unit } = planner.document;
  const round = (metres: number) => stepped(metres / unit.factor, unit) * unit.factor;
  return [round(x), round(y)];
}

/** Outlines of the selection, shifted, under keys of their own. */
export function ghostsOf(planner: Planner, elements: readonly StoreElement[], shift: Point): Part[] {
  planner.document.show(null);
  return elements
    .flatMap(({ path }) => planner.document.parts.of(path))
    .map((part) => ({ ...movedPart(part, shiftBy(shift)), key: `new ${part.key}`, path: null }));
}

/** Adds copies, shifted by a distance in m, and selects them. */
async function insertCopies(
  planner: Planner,
  copied: readonly Copied[],
  shift: Point,
  label: string,
  preview: Preview = noPreview,
  types: Types = {},
): Promise<boolean> {
  if (copied.length === 0) return false;
  const { document } = planner;
  if (document.locked) {
    planner.say(text.why_not.locked, true);
    return false;
  }
  const scratch = new EditBuilder(document.json);
  const taken = idsOf(
    document.json,
    document.parts.all.map(({ id }) => id),
  );
  const paths = addCopies(scratch, copied, taken);
  paths.forEach((path, index) => {
    const element = elementAt(scratch.json, path);
    const { effective, part } = copied[index];
    if (element)
      moveElement(
        scratch,
        { ...element, effective: { ...effective, ...element.value }, parts: part ? [part] : [], unit: document.unit },
        shiftBy(shift),
      );
  });
  const builder = new EditBuilder(document.json);
  addTypes(builder, types, document.shared);
  paths.forEach((path, index) => {
    builder.append(listOf(copied[index].kind), scratch.get(path) as Json);
  });
  const done = document.edit({ label, ops: builder.ops }, preview);
  planner.selection.setPaths(paths);
  return done;
}

/** Puts the middle of the copies at a place, or beside the original. */
export function paste(planner: Planner, at: Point | null): Promise<boolean> {
  const { copied, unit, types } = planner.clip;
  if (unit !== planner.document.unit.name) {
    planner.say(say(text.notices.other_unit, unit, planner.document.unit.name), true);
    return Promise.resolve(false);
  }
  const bounds = boundsOf(copied.map(({ middle }) => middle));
  if (!bounds) return Promise.resolve(false);
  const shift = at ? wholeSteps(planner, minus(at, middleOf(bounds))) : aside(planner);
  const elements = copied.map(({ kind, value }, index) => ({ kind, value, index, path: "" }));
  return insertCopies(planner, copied, shift, say(text.edits.paste, namesOf(elements)), noPreview, types);
}

/** Beside the original, m. */
function aside({ document: { unit } }: Planner): Point {
  const way = 50 * unit.step * unit.factor;
  return [way, -way];
}

export function duplicateSelection(planner: Planner): Promise<boolean> {
  const elements = planner.selected;
  const shift = aside(planner);
  const label = say(text.edits.duplicate, namesOf(elements));
  const preview = { ...noPreview, added: ghostsOf(planner, elements, shift) };
  return insertCopies(planner, copiesOf(planner, elements), shift, label, preview);
}

/** Duplicates that a drag puts at another place. */
export function dropCopies(planner: Planner, elements: readonly StoreElement[], shift: Point): Promise<boolean> {
  const label = say(text.edits.copy, namesOf(elements));
  const preview = { ...noPreview, added: ghostsOf(planner, elements, shift) };
  return insertCopies(planner, copiesOf(planner, elements), shift, label, preview);
}

export function deleteSelection(planner: Planner): Promise<boolean> {
  const { document } = planner;
  const elements = planner.selected.filter(({ kind }) => kind !== "room");
  if (elements.length === 0) return Promise.resolve(false);
  const units = elements.flatMap(({ path }) => document.units.withPath(path) ?? []);
  if (units.length === elements.length) return removeUnits(planner, units);
  const label = say(text.edits.delete, namesOf(elements));
  const builder = new EditBuilder(document.json);
  // From the last to the first, so that places stay right.
  const paths = elements.map(({ path }) => path).sort((a, b) => indexOf(b) - indexOf(a));
  for (const path of paths) if (kindOf(path)) builder.set(path, undefined);
  forgetUnits(builder, new Set(elements.flatMap(({ kind, value }) => (kind === "unit" ? [value.id] : []))));
  const keys = paths.flatMap((path) => document.parts.of(path).map(({ key }) => key));
  return document.edit({ label, ops: builder.ops }, { ...noPreview, hidden: new Set(keys) });
}

/** Lists that name units no longer name these, which go in one step with other elements. */
function forgetUnits(builder: EditBuilder, ids: ReadonlySet<Json>): void {
  for (const key of ["installed", "pinned", "excluded", "selected"]) {
    const list = pointerTo("/transceivers", key);
    const names = ids.size > 0 ? builder.get(list) : undefined;
    if (!Array.isArray(names)) continue;
    for (let k = names.length - 1; k >= 0; --k) if (ids.has(names[k])) builder.set(pointerTo(list, k), undefined);
  }
}

const indexOf = (path: string): number => Number(path.slice(path.lastIndexOf("/") + 1));
