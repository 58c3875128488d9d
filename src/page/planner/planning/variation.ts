// How the shop changes: a switch and its numbers for each cause, which are the section `variation` of the store.

import { element } from "../../panel/dom";
import { icon, type IconName } from "../access/icons";
import { EditBuilder } from "../document/edit";
import { isObject, valueAt, type Json } from "../document/json";
import { namesIn } from "../form/initial";
import { area } from "../geometry/polygon";
import type { Planner } from "../planner";
import { text } from "../text";
import { CheckBox, NumberField } from "./fields";

type Cause = keyof typeof text.variation.causes;

/** A number of a cause: where it is in the store, and how many units of the field make one of the store. */
interface Value {
  path: string;
  /** Empty: a number of people, or a length in the unit of the store. */
  unit: string;
  factor: number;
  most: number;
}

interface Row {
  icon: IconName;
  /** Whether it varies in this store. */
  isOn: (json: Json) => boolean;
  set: (edit: EditBuilder, isOn: boolean) => void;
  numbers: readonly Value[];
  /** Whether the shop can have it. */
  isPossible?: (json: Json) => boolean;
}

const percent = { unit: "%", factor: 100, most: 100 };
/** Assumed for shops whose files say nothing, except for the numbers of people, one for each 40 m². */
const usual = {
  stocking: [0.4, 1],
  still: 0.8,
  people: 40, // m² per person
  size: [0.5, 0.3, 1.75], // m
  clothes: { type: "lambertian", reflectance: 0.4 },
  doors: 0.05,
  mounting: { position: 0.05, tilt_deg: 2 }, // m
  scatter: 0.5, // dB
};

/** Whether a change is not left out by `variation.without`. */
const isLeftIn = (json: Json, key: string): boolean => {
  const without = valueAt(json, "/variation/without");
  return !(Array.isArray(without) && without.includes(key));
};
const leaveIn = (edit: EditBuilder, key: string, isOn: boolean): void => {
  const without = valueAt(edit.json, "/variation/without");
  const others = Array.isArray(without) ? without.filter((one) => one !== key) : [];
  const all = isOn ? others : [...others, key];
  edit.set("/variation/without", all.length > 0 ? all : undefined);
};

const at = (json: Json, key: string): Json | undefined => valueAt(json, `/variation/${key}`);
const isList = (value: Json | undefined): value is Json[] => Array.isArray(value) && value.length > 0;
const doorsOf = (json: Json): Json[] => {
  const fixtures = valueAt(json, "/fixtures");
  const has = (fixture: Json) => isObject(fixture) && fixture.doors !== undefined && fixture.doors !== "none";
  return Array.isArray(fixtures) ? fixtures.filter(has) : [];
};

export class Variation {
  private readonly rows: Record<Cause, Row>;
  private readonly whole = new CheckBox(text.variation.whole);
  private readonly boxes = new Map<Cause, CheckBox>();
  private readonly fields: { number: Value; field: NumberField }[] = [];
  private readonly lines = new Map<Cause, HTMLElement>();
  private readonly list = element("ul", { class: "causes" });
  readonly root: HTMLElement;

  constructor(private readonly planner: Planner) {
    this.rows = {
      stock: {
        icon: "run",
        isOn: (json) => isObject(at(json, "stocking")) || at(json, "stocking") === undefined,
        set: (edit, isOn) => edit.set("/variation/stocking", isOn ? { uniform: usual.stocking } : usual.still),
        numbers: [
          { path: "stocking/uniform/0", ...percent },
          { path: "stocking/uniform/1", ...percent },
        ],
      },
      people: {
        icon: "person",
        isOn: (json) => isList(at(json, "people")),
        set: (edit, isOn) => this.setPeople(edit, isOn),
        numbers: [{ path: "people/0/number/poisson", unit: "", factor: 1, most: 500 }],
      },
      doors: {
        icon: "opening",
        isOn: (json) => !isList(at(json, "doors")) || valueAt(json, "/variation/doors/0/open") !== 0,
        set: (edit, isOn) => edit.set("/variation/doors", [{ fixtures: "*", open: isOn ? usual.doors : 0 }]),
        numbers: [{ path: "doors/0/open", ...percent }],
        isPossible: (json) => doorsOf(json).length > 0,
      },
      mounting: {
        icon: "unit",
        isOn: (json) => at(json, "mounting") !== undefined,
        set: (edit, isOn) => edit.set("/variation/mounting", isOn ? this.inUnit(usual.mounting) : undefined),
        numbers: [
          { path: "mounting/position", unit: "", factor: 1, most: 100 },
          { path: "mounting/tilt_deg", unit: "°", factor: 1, most: 45 },
        ],
      },
      scatter: {
        icon: "light",
        isOn: (json) => at(json, "unit_power_db") !== undefined || at(json, "label_sensitivity_db") !== undefined,
        set: (edit, isOn) => {
          for (const key of ["unit_power_db", "label_sensitivity_db"])
            edit.set(`/variation/${key}`, isOn ? usual.scatter : undefined);
        },
        numbers: [
          { path: "unit_power_db", unit: "dB", factor: 1, most: 20 },
          { path: "label_sensitivity_db", unit: "dB", factor: 1, most: 20 },
        ],
      },
      objects: {
        icon: "block",
        isOn: (json) => isLeftIn(json, "objects"),
        set: (edit, isOn) => leaveIn(edit, "objects", isOn),
        numbers: [],
        isPossible: (json) => isList(at(json, "objects")),
      },
      reflectance: {
        icon: "problems",
        isOn: (json) => isLeftIn(json, "reflectances"),
        set: (edit, isOn) => leaveIn(edit, "reflectances", isOn),
        numbers: [],
      },
    };
    this.whole.input.addEventListener("change", () => this.change((edit) => this.setAll(edit, this.whole.isOn)));
    for (const [cause, row] of Object.entries(this.rows) as [Cause, Row][]) this.list.append(this.line(cause, row));
    this.root = element(
      "details",
      { class: "variation" },
      element("summary", { text: text.variation.title }),
      element("p", { class: "note", text: text.variation.lead }),
      this.whole.root,
      this.list,
    );
  }

  private line(cause: Cause, row: Row): HTMLElement {
    const box = new CheckBox(text.variation.causes[cause], text.variation.says[cause], icon(row.icon));
    box.input.dataset.key = `varies-${cause}`;
    box.input.addEventListener("change", () => this.change((edit) => row.set(edit, box.isOn)));
    this.boxes.set(cause, box);
    const names: Partial<Record<Cause, string[]>> = text.variation.numbers;
    const fields = row.numbers.map((number, k) => {
      const { path, unit, factor, most } = number;
      const field = new NumberField(names[cause]?.[k] ?? "", unit, { least: 0, most });
      field.input.dataset.key = `variation-${path}`;
      field.input.addEventListener("change", () => {
        const { value } = field;
        if (value !== undefined) this.change((edit) => edit.set(`/variation/${path}`, value / factor));
      });
      this.fields.push({ number, field });
      return field.root;
    });
    const made = element("li", {}, box.root, ...fields);
    this.lines.set(cause, made);
    return made;
  }

  update(): void {
    const { json, locked } = this.planner.document;
    const varies = valueAt(json, "/variation") !== undefined;
    Object.assign(this.whole.input, { checked: varies, disabled: locked !== null });
    this.list.hidden = !varies;
    for (const [cause, row] of Object.entries(this.rows) as [Cause, Row][]) {
      const box = this.boxes.get(cause);
      const line = this.lines.get(cause);
      if (box) Object.assign(box.input, { checked: row.isOn(json), disabled: locked !== null });
      if (line) line.hidden = row.isPossible?.(json) === false;
    }
    for (const { number, field } of this.fields) {
      const value = at(json, number.path);
      if (number.path === "mounting/position") field.unit.textContent = this.planner.document.unit.name;
      field.root.hidden = typeof value !== "number";
      if (typeof value !== "number" || field.input === document.activeElement) continue;
      field.input.value = String(Number((value * number.factor).toPrecision(6)));
    }
  }

  private change(make: (edit: EditBuilder) => void): void {
    const edit = new EditBuilder(this.planner.document.json);
    make(edit);
    void this.planner.document.edit({ label: text.variation.edit, ops: edit.ops });
  }

  private setAll(edit: EditBuilder, varies: boolean): void {
    edit.set("/variation", undefined);
    if (!varies) return;
    edit.set("/variation", {});
    this.rows.stock.set(edit, true);
    this.setPeople(edit, true);
    this.rows.mounting.set(edit, true);
    if (doorsOf(edit.json).length > 0) this.rows.doors.set(edit, true);
  }

  private setPeople(edit: EditBuilder, isOn: boolean): void {
    const { document } = this.planner;
    if (!isOn) {
      edit.set("/variation/people", undefined);
      return;
    }
    const name = text.variation.clothes;
    if (!namesIn(edit.json, "materials", document.shared).includes(name)) edit.set(`/materials/${name}`, usual.clothes);
    const room = document.parts.all.find(({ kind }) => kind === "room");
    const number = Math.max(1, Math.round(area(room?.outline ?? []) / usual.people));
    const size = usual.size.map((length) => length / document.unit.factor);
    edit.set("/variation/people", [{ area: "room", number: { poisson: number }, size, material: name }]);
  }

  /** Lengths in the unit of the store. */
  private inUnit({ position, ...others }: typeof usual.mounting): Json {
    return { position: Number((position / this.planner.document.unit.factor).toPrecision(3)), ...others };
  }
}
