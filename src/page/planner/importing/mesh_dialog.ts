// The dialog that makes a fixture of a mesh: its unit of length, the axis that points up, and its materials.

import { grouped } from "../../data/format";
import { say } from "../../data/text";
import { button, element } from "../../panel/dom";
import { EditBuilder } from "../document/edit";
import type { JsonObject } from "../document/json";
import { idsOf } from "../elements/copies";
import { firstFree } from "../elements/row_ids";
import { namesIn } from "../form/initial";
import { drawingUnits, factorOf, tidy } from "../geometry/units";
import type { Host } from "./host";
import { text } from "./text";

type Triple = [number, number, number];

/** As the program answers to an upload (docs/formats/planner.md): in units of the file, z up as the format says. */
export interface MeshFacts {
  lower: Triple;
  upper: Triple;
  materials: { name: string; triangles: number }[];
}

/** m: what stands in a shop. */
const [least, most] = [0.1, 15];
const usualUnits = ["m", "mm", "cm", "in", "ft"];

const sizeOf = ({ lower, upper }: MeshFacts): Triple => upper.map((value, k) => value - lower[k]) as Triple;

/** The bounds with another axis up: y and z are exchanged, and one of them is mirrored. */
function turned(facts: MeshFacts, isGltf: boolean): MeshFacts {
  const { lower, upper } = facts;
  const [low, high]: [Triple, Triple] = isGltf
    ? [
        [lower[0], lower[2], -upper[1]],
        [upper[0], upper[2], -lower[1]],
      ]
    : [
        [lower[0], -upper[2], lower[1]],
        [upper[0], -lower[2], upper[1]],
      ];
  return { ...facts, lower: low, upper: high };
}

function likelyUnit(facts: MeshFacts, isGltf: boolean): string {
  const size = Math.max(...sizeOf(facts));
  const fits = (unit: string) => size * factorOf(unit) >= least && size * factorOf(unit) <= most;
  return isGltf ? "m" : (usualUnits.find(fits) ?? "m");
}

/** Patterns match names; these match one name alone. */
const patternOf = (name: string): string => (name === "" ? "*" : name.replace(/[*?]/g, "?"));

const plain = (name: string): string => name.toLowerCase().replace(/[^\p{L}\p{N}]+/gu, "");

/** `file`: its name in the folder of the project. */
export function openMesh(host: Host, file: string, given: MeshFacts): void {
  const { planner } = host;
  const { document, viewport } = planner;
  const isGltf = /\.gl(b|tf)$/i.test(file);
  const usualUp = isGltf ? "y" : "z";
  const known = namesIn(document.json, "materials", document.shared);
  const row = (label: string, ...controls: (HTMLElement | string)[]) =>
    element("label", { class: "field" }, element("span", { text: label }), ...controls);
  const unit = element("select", { "data-key": "mesh-unit" });
  const up = element(
    "select",
    { "data-key": "mesh-up" },
    ...["z", "y"].map((axis) => element("option", { value: axis, text: axis, selected: axis === usualUp })),
  );
  const oriented = () => (up.value === usualUp ? given : turned(given, isGltf));
  const showSizes = () => {
    const chosen = unit.value || likelyUnit(given, isGltf);
    unit.replaceChildren(
      ...[...drawingUnits.keys()].map((name) => {
        const size = sizeOf(oriented()).map((length) => Number((length * factorOf(name)).toPrecision(3)));
        return element("option", {
          value: name,
          text: say(text.mesh.size, name, ...size),
          selected: name === chosen,
        });
      }),
    );
  };
  up.addEventListener("change", showSizes);
  showSizes();
  const materials = given.materials.map(({ name, triangles }) => {
    const same = known.find((own) => plain(own) === plain(name) && name !== "");
    const control = element(
      "select",
      { "data-key": `mesh-material/${name}` },
      element("option", { value: "", text: text.mesh.choose }),
      ...known.map((own) => element("option", { value: own, text: own, selected: own === same })),
    );
    control.addEventListener("change", () => showChoices());
    const shown = name === "" ? text.mesh.unnamed : name;
    const count = element("small", { text: say(text.mesh.triangles, grouped(triangles)) });
    return { name, control, row: row(shown, control, count) };
  });
  /** A guess would be wrong without a word, so each material is chosen. */
  const showChoices = () => {
    const open = materials.filter(({ control }) => control.value === "");
    for (const { control } of materials) control.setAttribute("aria-invalid", String(control.value === ""));
    button_.disabled = open.length > 0;
  };
  const add = async () => {
    const { lower, upper } = oriented();
    const scale = factorOf(unit.value);
    const [x, y] = viewport.centre;
    const middle = [0, 1].map((k) => 0.5 * scale * (lower[k] + upper[k]));
    const inFile = (metres: number) => tidy(metres / document.unit.factor, document.unit);
    const taken = idsOf(
      document.json,
      document.parts.all.map(({ id }) => id),
    );
    const id = `M${firstFree(taken, "M{n}", 1)}`;
    // The first pattern that matches applies, so that of the nameless surfaces comes last.
    const named = [...materials].sort((a, b) => Number(a.name === "") - Number(b.name === ""));
    const patterns = Object.fromEntries(named.map(({ name, control }) => [patternOf(name), control.value]));
    const fixture: JsonObject = {
      type: "mesh",
      id,
      at: [inFile(x - middle[0]), inFile(y - middle[1]), inFile(-scale * lower[2])],
      file,
      ...(scale === 1 ? {} : { scale }),
      ...(up.value === usualUp ? {} : { up: up.value }),
      materials: patterns,
    };
    const builder = new EditBuilder(document.json);
    const path = builder.append("/fixtures", fixture);
    dialog.close();
    if (!(await document.edit({ label: say(text.edits.add_mesh, id), ops: builder.ops }))) return;
    planner.selection.setPaths([path]);
    planner.say(say(text.mesh.added, id));
  };
  const button_ = button(text.mesh.add, () => void add(), { class: "primary", "data-key": "mesh-add" });
  showChoices();
  const dialog = host.openDialog(
    say(text.mesh.title, file),
    "mesh",
    element(
      "div",
      { class: "fields" },
      row(text.mesh.unit, unit),
      row(text.mesh.up, up),
      element("h3", { text: text.mesh.materials }),
      element("p", { class: "note", text: text.mesh.materials_says }),
      element("div", { class: "materials" }, ...materials.map(({ row: own }) => own)),
      element("footer", {}, button_),
    ),
  );
}
