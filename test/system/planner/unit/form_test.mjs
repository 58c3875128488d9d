import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

import { EditBuilder } from "../../../../src/page/planner/document/edit";
import { elementsOf } from "../../../../src/page/planner/elements/kinds";
import { inUnit } from "../../../../src/page/planner/form/convert";
import { initialObject, initialValue } from "../../../../src/page/planner/form/initial";
import { groupOfElement, groupOfStore, groupOfType, measureOf } from "../../../../src/page/planner/form/schema";
import { inheritedAt, pointerOfPath, presentAt, setIn, shownAt } from "../../../../src/page/planner/form/targets";
import { alternativeOf, commonFields, fieldsOf, variantOf } from "../../../../src/page/planner/form/variants";
import { unitNamed } from "../../../../src/page/planner/geometry/units";
import { text } from "../../../../src/page/planner/text";
import { parse } from "../jsonc.mjs";
import { points } from "./support.mjs";

const fixtureTypes = ["gondola", "freezer", "box", "prism", "cylinder", "panel", "mesh"];
const kinds = "room zone wall opening label plane unit grid area rail faces keep_out".split(" ");
const groups = [
  ...fixtureTypes.map((type) => groupOfElement("fixture", type)),
  ...kinds.map((kind) => groupOfElement(kind, "")),
  ...["materials", "label_types", "transceiver_types"].map((list) => groupOfType(list, "")),
  groupOfStore(),
];

/** All fields, also those within others. */
function fieldsIn(type) {
  if (type.kind === "group")
    return type.group.variants.flatMap(({ fields }) => fields.flatMap((field) => [field, ...fieldsIn(field.type)]));
  if (type.kind === "list") return fieldsIn({ kind: "group", group: type.item });
  if (type.kind === "either") return type.options.flatMap(fieldsIn);
  return type.kind === "map" ? fieldsIn(type.value) : [];
}
const allFields = groups.flatMap((group) => fieldsIn({ kind: "group", group }));

test("every key of the schema has a name", () => {
  assert.ok(allFields.length > 200);
  const missing = new Set(allFields.map(({ key }) => key).filter((key) => !Object.hasOwn(text.fields, key)));
  assert.deepEqual([...missing], []);
  const used = new Set(allFields.map(({ key }) => key));
  assert.deepEqual(
    Object.keys(text.fields).filter((key) => !used.has(key)),
    [],
  );
});

test("numbers have the right unit of measure", () => {
  const expected = {
    length: "length at spacing positions shelves from offset below_ceiling thickness radius z shift",
    degrees: "rotation_deg tilt_deg roll_deg",
    none: "stocking order peak eta count normal axes scale",
  };
  const measures = (key) =>
    new Set(
      allFields
        .filter((field) => field.key === key)
        .flatMap(({ type }) => (type.kind === "either" ? type.options : [type]))
        .flatMap(({ measure }) => measure ?? []),
    );
  for (const [measure, keys] of Object.entries(expected))
    for (const key of keys.split(" ")) assert.deepEqual([...measures(key)], [measure], key);
  const suffixed = ["at_m", "wavelength_nm", "absorption_per_m", "unit_power_db"];
  assert.deepEqual(suffixed.map(measureOf), ["m", "nm", "1/m", "dB"]);
});

test("only values that nobody types are shown as JSON", () => {
  assert.deepEqual(
    [...new Set(allFields.filter(({ type }) => type.kind === "json").map(({ key }) => key))],
    ["holes", "intensity"],
  );
});

const examples = process.env.EXAMPLES;
const folder = readdirSync(examples, { withFileTypes: true }).filter((entry) => entry.isDirectory());

/** A fixture with the keys of its preset, as far as the choice of a form needs them. */
function effective(json, element) {
  const preset = json.presets?.[element.preset];
  return preset ? { ...effective(json, preset), ...element } : element;
}

test("forms show every key of the examples", () => {
  const omitted = ["type", "variation", "zones", "inner_walls"];
  let count = 0;
  for (const { name } of folder) {
    const json = parse(readFileSync(join(examples, name, "store.json"), "utf8"));
    for (const { kind, value } of elementsOf(json)) {
      const whole = effective(json, value);
      const group = groupOfElement(kind, String(whole.type ?? ""));
      if (!group) continue; // the preset is in a catalogue
      const fields = fieldsOf(variantOf(group, whole), whole).map(({ key }) => key);
      const hidden = Object.keys(value).filter((key) => !fields.includes(key) && !omitted.includes(key));
      assert.deepEqual(hidden, [], `${name}: ${JSON.stringify(value)}`);
      count += fields.length;
    }
  }
  assert.ok(count > 1000);
});

test("alternatives: a fixture stands at a place or against something", () => {
  const [variant] = groupOfElement("fixture", "gondola").variants;
  const keys = (value) => fieldsOf(variant, value).map(({ key }) => key);
  assert.deepEqual(alternativeOf(variant, { against: {} }), ["against"]);
  assert.ok(keys({ at: [0, 0] }).includes("at") && !keys({ at: [0, 0] }).includes("against"));
  assert.ok(keys({ against: {} }).includes("against") && !keys({ against: {} }).includes("at"));
});

test("variants: by type, or by their keys", () => {
  const box = groupOfElement("fixture", "box");
  assert.equal(variantOf(box, { min: [0, 0, 0], max: [1, 1, 1] }).name, "min");
  assert.equal(variantOf(box, { at: [0, 0, 0], size: [1, 1, 1] }).name, "size");
  assert.equal(variantOf(groupOfElement("room", ""), { outline: [] }).name, "outline");
  assert.equal(variantOf(groupOfType("materials", ""), { type: "plastic" }).name, "plastic");
  const emission = groupOfType("transceiver_types", "").variants[0].fields.find(({ key }) => key === "emission").type
    .group;
  assert.deepEqual(
    emission.variants.map(({ name }) => name),
    ["sin2theta", "isotropic", "lambertian", "table", "ies", "eulumdat"],
  );
});

test("several elements have their common fields", () => {
  const fields = ["gondola", "freezer", "box"].map((type) => groupOfElement("fixture", type).variants[0].fields);
  const common = commonFields(fields.slice(0, 2)).map(({ key }) => key);
  assert.ok(common.includes("height") && common.includes("goods") && !common.includes("shelves"));
  assert.ok(!commonFields(fields).some(({ key }) => key === "at"));
});

test("values: own, of a preset, default, mixed", () => {
  const inherited = { depth: 0.9, labels: { type: "large" } };
  const details = { effective: inherited, inherited, resolved: null };
  const target = (own) => ({
    ...{ path: "/fixtures/0", details },
    ...{ own: { preset: "row", ...own }, effective: { ...inherited, ...own } },
  });
  const shown = (targets, pointer, fallback) => shownAt(targets, pointer, () => fallback);
  const fromPreset = { own: undefined, base: 0.9, origin: "row", isMixed: false, isOwn: false };
  assert.deepEqual(shown([target({})], "/depth", 1), fromPreset);
  assert.equal(shown([target({})], "/height", 2).base, 2);
  assert.equal(shown([target({ depth: 3 })], "/depth", 1).own, 3);
  assert.equal(shown([target({ depth: 3 })], "/depth", 1).base, 0.9);
  assert.equal(shown([target({ depth: 3 }), target({})], "/depth", 1).isMixed, true);
  assert.equal(shown([target({ depth: 0.9 }), target({})], "/depth", 1).isMixed, false);
  assert.equal(presentAt(target({}), "/labels/type"), "large");
});

test("first values are complete", () => {
  const json = { materials: { steel: {} }, label_types: { small: {} } };
  const around = { json, shared: {}, unit: unitNamed("mm"), part: null };
  const labels = groupOfElement("fixture", "gondola").variants[0].fields.find(({ key }) => key === "labels").type;
  assert.deepEqual(initialValue(labels, "labels", around), { type: "small", spacing: 1000 });
  const against = groupOfElement("fixture", "gondola").variants[0].fields.find(({ key }) => key === "against").type;
  assert.deepEqual(initialObject(against.group, 0, around), { wall: 0, from: 0 });
  const footing = { at: [1, 2], rotation: 90, length: 3, depth: 1 };
  const part = { kind: "fixture", type: "box", outline: points("0,2 1,5"), footing, height: 2 };
  const box = groupOfElement("fixture", "box").variants;
  const value = (variant, key) =>
    initialValue(box[variant].fields.find((field) => field.key === key).type, key, { ...around, part });
  assert.deepEqual(
    [value(0, "at"), value(0, "size"), value(1, "max")],
    points("1000,2000,0 3000,1000,2000 1000,5000,2000"),
  );
});

test("lengths of presets of a catalogue are in the unit of the store", () => {
  const fixture = (length, shelves, spacing) => ({
    ...{ type: "gondola", length, shelves, labels: { type: "small", spacing, tilt_deg: 20 } },
    repeat: { count: 3, step: [0, 2.4] }, // of the store
  });
  const units = { length: "mm", shelves: "mm", labels: "mm" };
  const found = inUnit(fixture(1330, [350, 800], 300), units, unitNamed("m"));
  assert.deepEqual(found, fixture(1.33, [0.35, 0.8], 0.3));
});

test("paths of problems lead to their fields", () => {
  for (const [path, pointer] of [
    ["fixtures[3].labels.spacing", "/fixtures/3/labels/spacing"],
    ["fixtures[0].depth (preset 'run 1.33')", "/fixtures/0/depth"],
    ["room", "/room"],
    ["transceivers.grids[0].min[1]", "/transceivers/grids/0/min/1"],
  ])
    assert.equal(pointerOfPath(path), pointer);
});

test("a change in a list of a preset writes the whole list", () => {
  const inherited = { labels: [{ height: 0.8, type: "a" }, { height: 0.9 }], sides: { inner: [{ x: 1 }] } };
  const edited = (own, ...changes) => {
    const builder = new EditBuilder({ fixtures: [own] });
    const target = { path: "/fixtures/0", own, effective: { ...inherited, ...own }, details: { inherited } };
    for (const [pointer, value] of changes) setIn(builder, target, pointer, value);
    return builder.json.fixtures[0];
  };
  const both = [{ height: 0.75, type: "a" }, { height: 0.9 }];
  assert.deepEqual(edited({}, ["/labels/0/height", 0.75]), { labels: both });
  assert.deepEqual(edited({}, ["/labels/0/height", 0.75], ["/labels/1/height", 1]), {
    labels: [both[0], { height: 1 }],
  });
  assert.deepEqual(edited({}, ["/labels/0/type", null]), { labels: [{ height: 0.8 }, { height: 0.9 }] });
  assert.deepEqual(edited({}, ["/sides/inner/0/x", 2]), { sides: { inner: [{ x: 2 }] } });
  assert.deepEqual(edited({ labels: [{ height: 1 }] }, ["/labels/0/height", 2]), { labels: [{ height: 2 }] });
  assert.deepEqual(edited({}, ["/labels", []], ["/depth", 2]), { labels: [], depth: 2 });
  const target = (own) => ({ path: "", own, effective: { ...inherited, ...own }, details: { inherited } });
  assert.equal(inheritedAt(target({}), "/labels/0/type"), "a");
  assert.equal(inheritedAt(target({ labels: [{ height: 1 }] }), "/labels/0/type"), undefined);
});
