// Which column is what, and how places are counted.

import { say } from "../../data/text";
import { inForm } from "../planogram/guess";
import {
  faces,
  hasMergedCells,
  isRequired,
  lengthUnits,
  numericColumns,
  rolesOf,
  type Face,
  type Form,
  type Mapping,
  type Measure,
  type Role,
} from "../planogram/mapping";
import type { Shop } from "../planogram/shop";
import { markOf } from "../table/numbers";
import type { Table } from "../table/table";
import { columnName, roleName } from "./names";
import { choiceRow } from "./source_form";
import { text } from "./text";

type Option = [value: string, name: string];

export class ColumnsForm {
  constructor(
    private readonly table: Table,
    private readonly shop: Shop,
    private readonly change: (mapping: Mapping) => void,
  ) {}

  rows(mapping: Mapping): HTMLElement[] {
    const set = (changed: Partial<Mapping>) => this.change({ ...mapping, ...changed });
    return [
      choiceRow("form", text.planogram.form, Object.entries(text.planogram.forms), mapping.form, (form) =>
        this.change(inForm(this.table, mapping, form as Form)),
      ),
      ...rolesOf(mapping.form).flatMap((role) => [this.roleRow(mapping, role), ...this.below(mapping, role, set)]),
      ...this.markRow(mapping, set),
      ...this.mergedRow(mapping, set),
    ];
  }

  private roleRow(mapping: Mapping, role: Role): HTMLElement {
    const { form, columns } = mapping;
    const needed = isRequired(form, role);
    const none =
      role === "place" && !needed ? text.planogram.by_order : needed ? text.planogram.choose : text.form.none;
    const options = this.table.header.map((_, column): Option => [String(column), columnName(this.table, column)]);
    return choiceRow(
      role,
      roleName(form, role),
      [["", none], ...options],
      String(columns[role] ?? ""),
      (value) => {
        const { [role]: _before, ...others } = columns;
        // A column has one meaning.
        const free = Object.fromEntries(Object.entries(others).filter(([, column]) => String(column) !== value));
        this.change({ ...mapping, columns: value === "" ? free : { ...free, [role]: Number(value) } });
      },
      needed && columns[role] === undefined,
    );
  }

  /** What else has to be known about a column, or in its place. */
  private below(mapping: Mapping, role: Role, set: (changed: Partial<Mapping>) => void): HTMLElement[] {
    const { form, columns } = mapping;
    const counts: Option[] = [0, 1, 2].map((first) => [String(first), String(first)]);
    if (role === "planogram" && columns.planogram !== undefined)
      return [
        choiceRow(
          "holder",
          text.planogram.holder,
          Object.entries(text.planogram.holders),
          mapping.bySegment ? "segment" : "planogram",
          (value) => set({ bySegment: value === "segment" }),
        ),
      ];
    if (role === "face" && columns.face === undefined)
      return [
        choiceRow(
          "one-face",
          text.planogram.one_face,
          faces.map((face) => [face, text.planogram.faces[face]]),
          mapping.face,
          (value) => set({ face: value as Face }),
        ),
      ];
    if (role === "level")
      return [
        choiceRow(
          "from-top",
          text.planogram.from_top,
          Object.entries(text.planogram.directions),
          mapping.fromTop ? "top" : "bottom",
          (value) => set({ fromTop: value === "top" }),
        ),
        choiceRow(
          "first",
          mapping.fromTop ? text.planogram.highest : text.planogram.lowest,
          counts,
          String(mapping.first),
          (value) => set({ first: Number(value) }),
        ),
      ];
    if (role === "place" && form === "fixtures")
      return [
        ...(columns.place === undefined ? [] : [this.measureRow(mapping, set)]),
        ...(columns.place === undefined || mapping.measure !== "position"
          ? []
          : [
              choiceRow("first-place", text.planogram.first_place, counts, String(mapping.firstPlace), (value) =>
                set({ firstPlace: Number(value) }),
              ),
            ]),
        choiceRow(
          "from-left",
          text.planogram.from_left,
          Object.entries(text.planogram.begins),
          mapping.fromLeft ? "left" : "fixture",
          (value) => set({ fromLeft: value === "left" }),
        ),
      ];
    if (role === "type")
      return [
        choiceRow(
          "one-type",
          text.planogram.one_type,
          this.shop.types.map((type) => [type, type]),
          mapping.type,
          (type) => set({ type }),
        ),
      ];
    return [];
  }

  /** Asks for the decimal mark where the numbers do not show it. */
  private markRow(mapping: Mapping, set: (changed: Partial<Mapping>) => void): HTMLElement[] {
    if (markOf(this.table, numericColumns(mapping)) !== null) return [];
    const { point, comma } = text.planogram.decimals;
    const options: Option[] = [
      ["", text.planogram.choose],
      [".", point],
      [",", comma],
    ];
    const chosen = (mark: string) => set({ mark: mark as Mapping["mark"] });
    return [choiceRow("mark", text.planogram.mark, options, mapping.mark, chosen, mapping.mark === "")];
  }

  private mergedRow(mapping: Mapping, set: (changed: Partial<Mapping>) => void): HTMLElement[] {
    if (!hasMergedCells(this.table, mapping)) return [];
    const options = Object.entries(text.planogram.empty_cells);
    return [
      choiceRow("merged", text.planogram.merged, options, mapping.fillsDown ? "above" : "empty", (value) =>
        set({ fillsDown: value === "above" }),
      ),
    ];
  }

  private measureRow(mapping: Mapping, set: (changed: Partial<Mapping>) => void): HTMLElement {
    const distances = lengthUnits.map((unit): Option => [unit, say(text.planogram.distance_in, unit)]);
    return choiceRow(
      "measure",
      text.planogram.measure,
      [["position", text.planogram.position], ...distances],
      mapping.measure,
      (measure) => set({ measure: measure as Measure }),
    );
  }
}
