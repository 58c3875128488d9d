// Which column is what, and how places are counted.

import { say } from "../../data/text";
import { element } from "../../panel/dom";
import { inForm } from "../planogram/guess";
import {
  faces,
  isRequired,
  lengthUnits,
  rolesOf,
  type Face,
  type Form,
  type Mapping,
  type Measure,
  type Role,
} from "../planogram/mapping";
import type { Shop } from "../planogram/shop";
import type { Table } from "../table/table";
import { columnName, roleName } from "./names";
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
      this.row("form", text.planogram.form, Object.entries(text.planogram.forms), mapping.form, (form) =>
        this.change(inForm(this.table, mapping, form as Form)),
      ),
      ...rolesOf(mapping.form).flatMap((role) => [this.roleRow(mapping, role), ...this.below(mapping, role, set)]),
    ];
  }

  private roleRow(mapping: Mapping, role: Role): HTMLElement {
    const { form, columns } = mapping;
    const needed = isRequired(form, role);
    const none =
      role === "place" && !needed ? text.planogram.by_order : needed ? text.planogram.choose : text.form.none;
    const options = this.table.header.map((_, column): Option => [String(column), columnName(this.table, column)]);
    return this.row(
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
        this.row(
          "holder",
          text.planogram.holder,
          Object.entries(text.planogram.holders),
          mapping.bySegment ? "segment" : "planogram",
          (value) => set({ bySegment: value === "segment" }),
        ),
      ];
    if (role === "face" && columns.face === undefined)
      return [
        this.row(
          "one-face",
          text.planogram.one_face,
          faces.map((face) => [face, text.planogram.faces[face]]),
          mapping.face,
          (value) => set({ face: value as Face }),
        ),
      ];
    if (role === "level")
      return [
        this.row(
          "from-top",
          text.planogram.from_top,
          Object.entries(text.planogram.directions),
          mapping.fromTop ? "top" : "bottom",
          (value) => set({ fromTop: value === "top" }),
        ),
        this.row(
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
        this.row(
          "from-left",
          text.planogram.from_left,
          Object.entries(text.planogram.begins),
          mapping.fromLeft ? "left" : "fixture",
          (value) => set({ fromLeft: value === "left" }),
        ),
      ];
    if (role === "type")
      return [
        this.row(
          "one-type",
          text.planogram.one_type,
          this.shop.types.map((type) => [type, type]),
          mapping.type,
          (type) => set({ type }),
        ),
      ];
    return [];
  }

  private measureRow(mapping: Mapping, set: (changed: Partial<Mapping>) => void): HTMLElement {
    const distances = lengthUnits.map((unit): Option => [unit, say(text.planogram.distance_in, unit)]);
    return this.row(
      "measure",
      text.planogram.measure,
      [["position", text.planogram.position], ...distances],
      mapping.measure,
      (measure) => set({ measure: measure as Measure }),
    );
  }

  private row(
    key: string,
    name: string,
    options: readonly (readonly [string, string])[],
    value: string,
    chosen: (value: string) => void,
    isMissing = false,
  ): HTMLElement {
    const id = `table-${key}`;
    const select = element("select", {
      id,
      "data-key": id,
      "aria-invalid": isMissing ? "true" : undefined,
      on: { change: () => chosen(select.value) },
    });
    for (const [own, words] of options) select.append(element("option", { value: own, text: words }));
    select.value = value;
    return element("div", { class: "row" }, element("label", { for: id, text: name }), select);
  }
}
