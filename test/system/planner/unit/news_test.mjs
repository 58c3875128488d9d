import assert from "node:assert/strict";
import { test } from "node:test";

import { newsOf } from "../../../../src/page/planner/actions/news";
import { withoutPlace } from "../../../../src/page/planner/document/messages";
import { EditBuilder } from "../../../../src/page/planner/document/edit";
import { addTypes, typesNamedBy } from "../../../../src/page/planner/elements/types";

const step = (label, time = label) => ({ label, time });
const store = { fixtures: [{ id: "A" }, { id: "B" }] };
const others = (before, after, more = {}) => ({
  by: "tab",
  history: { before, after },
  json: { before: store, after: store },
  ...more,
});

test("steps of another tab: done, undone, done again", () => {
  const none = { steps: [], position: 0 };
  const one = { steps: [step("Move A")], position: 1 };
  const undone = { ...one, position: 0 };
  assert.equal(newsOf(others(none, one)), "Another tab: Move A");
  assert.equal(newsOf(others(one, undone)), "Another tab: Undo Move A");
  assert.equal(newsOf(others(undone, one)), "Another tab: Redo Move A");
  const other = { steps: [step("Delete B")], position: 1 };
  assert.equal(newsOf(others(undone, other)), "Another tab: Delete B");
});

test("changes outside name the elements", () => {
  const history = { steps: [], position: 0 };
  const says = (after) => newsOf(others(history, history, { by: "program", json: { before: store, after } }));
  assert.equal(says({ fixtures: [{ id: "A" }, { id: "B", at: [1, 2] }] }), "Changed outside: B");
  assert.equal(says({ fixtures: [{ id: "B" }] }), "Changed outside: A");
  assert.equal(says({ ...store, name: "Corner" }), "Changed outside: Store");
});

test("sentences lose the store file and the place, and keep other files", () => {
  const short = (path, sentence) => withoutPlace({ path, sentence }, "store.json");
  assert.equal(short("fixtures[2].depth", "store.json: fixtures[2].depth: is 0; more"), "is 0; more");
  assert.equal(short("fixtures[2]", "fixtures[2] (preset 'row'): stands in a wall"), "stands in a wall");
  assert.equal(short("", "store.json: has no room"), "has no room");
  assert.equal(short("presets.row", "chain.json: presets.row: is no object"), "chain.json: presets.row: is no object");
});

test("a clip has the own types that its elements name, also through other types", () => {
  const json = {
    presets: { row: { preset: "base", material: "steel" }, base: { labels: { type: "small" } }, other: {} },
    materials: { steel: { type: "conductor" }, glass: {} },
    label_types: { small: { material: "glass" }, large: {} },
  };
  const types = typesNamedBy([{ id: "other", preset: "row", labels: { level_types: { 1: "large" } } }], json);
  assert.deepEqual(types, {
    presets: { row: json.presets.row, base: json.presets.base },
    materials: json.materials,
    label_types: json.label_types,
  });
  const builder = new EditBuilder({ materials: { steel: { type: "plastic" } } });
  addTypes(builder, types, { label_types: ["small"] });
  assert.deepEqual(builder.json.materials, { steel: { type: "plastic" }, glass: {} });
  assert.deepEqual(Object.keys(builder.json.label_types), ["large"]);
});
