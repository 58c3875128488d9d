import assert from "node:assert/strict";
import { test } from "node:test";

import { Changes } from "../../../../src/page/planner/changes";
import { Lost, Refused } from "../../../../src/page/planner/document/connection";
import { Devices } from "../../../../src/page/planner/document/devices";
import { StoreDocument } from "../../../../src/page/planner/document/document";
import { EditBuilder } from "../../../../src/page/planner/document/edit";
import { noPreview } from "../../../../src/page/planner/document/preview";
import { placeAgain, Selection } from "../../../../src/page/planner/view/selection";
import { square } from "./support.mjs";

globalThis.requestAnimationFrame = (run) => setTimeout(run);

const partAt = (index, x, id) => ({
  ...{ key: `fixtures/${index}`, path: `/fixtures/${index}`, kind: "fixture" },
  ...{ id, outline: square(x, 0, 1) },
});
const store = {
  fixtures: [
    { id: "A", at: [0, 0] },
    { id: "B", at: [2, 0] },
    { id: "C", at: [4, 0] },
  ],
};
const history = { steps: [], position: 0 };
const project = {
  ...{ event: "project", name: "shop", file: "store.json", version: "1", tab: 1, revision: 5, json: store, unit: "m" },
  ...{ parts: [partAt(0, 0, "A"), partAt(1, 2, "B"), partAt(2, 4, "C")], problems: [], history, locked: null },
};
const settled = () => new Promise((done) => setTimeout(done, 5));

/** A server that answers when the test says so. */
class Connection {
  isOpen = true;
  hasEnded = false;
  sent = [];
  reopened = 0;
  nextId() {
    this.id = (this.id ?? 0) + 1;
    return this.id;
  }
  request(what, members, id = this.nextId()) {
    return new Promise((resolve, reject) => this.sent.push({ what, members, id, resolve, reject }));
  }
  close() {
    ++this.reopened;
  }
}

function opened() {
  const connection = new Connection();
  const document = new StoreDocument(connection, new Changes());
  connection.onEvent(project);
  const set = (label, path, value) => {
    const builder = new EditBuilder(document.json);
    builder.set(path, value);
    return { label, ops: builder.ops };
  };
  const move = (index, x) => set(`Move ${index}`, `/fixtures/${index}/at/0`, x);
  const remove = (index) => set("Delete", `/fixtures/${index}`, undefined);
  return { connection, document, move, remove };
}

const changed = (revision, ops, more = {}) => ({
  ...{ event: "changed", revision, ops, problems: [], history, locked: null },
  ...more,
});
const placesIn = ({ json }) => json.fixtures.map(({ at }) => at[0]);

test("an edit shows at once, and stays when it is confirmed", async () => {
  const { connection, document, move } = opened();
  const edit = move(0, 9);
  const preview = { ...noPreview, parts: new Map([["fixtures/0", partAt(0, 9, "A")]]) };
  const done = document.edit(edit, preview);
  assert.equal(document.json.fixtures[0].at[0], 9);
  assert.equal(document.parts.of("/fixtures/0")[0].outline[0][0], 9);
  assert.equal(document.saving.state, "saving");
  const [{ id, resolve }] = connection.sent;
  connection.onEvent(changed(6, edit.ops, { tab: 1, request: id, parts: { set: [partAt(0, 9, "A")], remove: [] } }));
  resolve({ revision: 6 });
  assert.equal(await done, true);
  assert.equal(document.saving.state, "saved");
  assert.equal(document.json.fixtures[0].at[0], 9);
  assert.equal(document.revision, 6);
});

test("a refused edit is taken back with the reason, and nothing counts as saved", async () => {
  const { connection, document, move } = opened();
  const reasons = [];
  document.onRefused = (label, { message }) => reasons.push(`${label}: ${message}`);
  const done = document.edit(move(1, 9), { ...noPreview, parts: new Map([["fixtures/1", partAt(1, 9, "B")]]) });
  connection.sent[0].reject(new Refused({ message: "disk is full" }));
  assert.equal(await done, false);
  assert.deepEqual(document.json, store);
  assert.equal(document.parts.of("/fixtures/1")[0].outline[0][0], 2);
  assert.equal(document.saving.state, "refused");
  assert.deepEqual(reasons, ["Move 1: disk is full"]);
});

test("places return when a removal is refused", async () => {
  const { connection, document, remove } = opened();
  let path = "/fixtures/2";
  document.onMoved = (place) => (path = place(path));
  const done = document.edit(remove(0));
  assert.equal(path, "/fixtures/1");
  connection.sent[0].reject(new Refused({ message: "disk is full" }));
  assert.equal(await done, false);
  assert.equal(path, "/fixtures/2");
});

test("another window's edit comes below those that wait", async () => {
  const { connection, document, move } = opened();
  void document.edit(move(0, 9));
  connection.onEvent(changed(6, [{ path: "/fixtures/2/at/0", before: 4, after: 7 }], { tab: 2, request: 1 }));
  assert.deepEqual(placesIn(document), [9, 2, 7]);
});

test("places and selection follow a removal before the server knows it", async () => {
  const { connection, document, remove } = opened();
  const selection = new Selection(new Changes());
  document.onMoved = (place) => selection.follow(place);
  selection.setPaths(["/fixtures/2", "/fixtures/0"]);
  void document.edit(remove(0), { ...noPreview, hidden: new Set(["fixtures/0"]) });
  assert.deepEqual(selection.paths, ["/fixtures/1"]);
  assert.equal(document.parts.of("/fixtures/1")[0].id, "C");
  assert.equal(document.parts.all.length, 2);
  const [{ id, members }] = connection.sent;
  const parts = { set: [partAt(0, 2, "B"), partAt(1, 4, "C")], remove: ["fixtures/2"] };
  connection.onEvent(changed(6, members.ops, { tab: 1, request: id, parts }));
  assert.deepEqual(selection.paths, ["/fixtures/1"]);
  assert.deepEqual(
    document.parts.all.map(({ id: name }) => name),
    ["B", "C"],
  );
});

test("after undo the selection finds its elements by their ids", () => {
  const { connection, document } = opened();
  const selection = new Selection(new Changes());
  document.onReplaced = (before) => selection.follow(placeAgain(before, document.json));
  selection.setPaths(["/fixtures/1"]);
  const json = { fixtures: [{ id: "new", at: [0, 0] }, ...store.fixtures] };
  connection.onEvent(changed(6, undefined, { json, parts: { set: [], remove: [] } }));
  assert.deepEqual(selection.paths, ["/fixtures/2"]);
});

test("after another store without ids, the selection finds its elements by their values", () => {
  const [a, b, c] = [1, 2, 3].map((x) => ({ at: [x, 0] }));
  const before = { fixtures: [a, b, c] };
  const placeIn = (fixtures) => placeAgain(before, { fixtures })("/fixtures/1");
  assert.equal(placeIn([b, c]), "/fixtures/0");
  assert.equal(placeIn([a, c]), null);
  assert.equal(placeIn([a, { at: [9, 0] }, c]), "/fixtures/1", "a changed value of the same list");
});

test("selected copies and labels follow", () => {
  const selection = new Selection(new Changes());
  const copy = { kind: "copy", key: "fixtures/2#3", path: "/fixtures/2" };
  const label = (index, path) => ({ kind: "device", device: "label", index, path });
  selection.set([copy, label(1, "/fixtures/1"), label(4, "/fixtures/1"), label(9, "/fixtures/2")]);
  selection.follow((path) => (path === "/fixtures/1" ? null : "/fixtures/1"));
  assert.deepEqual(selection.items, [{ ...copy, key: "fixtures/1#3", path: "/fixtures/1" }, label(9, "/fixtures/1")]);
  const labels = { kind: "label", pathOf: () => "/fixtures/1" };
  selection.replaceDevices(labels, 2, 4, 1);
  assert.deepEqual(selection.items[1], label(6, "/fixtures/1"));
  selection.replaceDevices(labels, 5, 2, 2);
  assert.equal(selection.items.length, 2, "as many labels of the same element");
  selection.replaceDevices(labels, 5, 2, 3);
  assert.equal(selection.items.length, 1);
});

test("after a lost connection, what the server has not received is sent again, once", async () => {
  const { connection, document, move } = opened();
  const received = document.edit(move(0, 9));
  const missed = document.edit(move(1, 8));
  for (const { reject } of connection.sent) reject(new Lost());
  connection.isOpen = false;
  await settled();
  assert.deepEqual(document.saving, { state: "lost", edits: 2, hasEnded: false });
  connection.isOpen = true;
  connection.sent.length = 0;
  const [a, ...others] = store.fixtures;
  connection.onEvent({ ...project, revision: 6, json: { fixtures: [{ ...a, at: [9, 0] }, ...others] } });
  assert.equal(await received, true);
  assert.deepEqual(
    connection.sent.map(({ members }) => members.label),
    ["Move 1"],
  );
  assert.deepEqual(placesIn(document), [9, 8, 4]);
  connection.onEvent(changed(7, connection.sent[0].members.ops, { tab: 1, request: connection.sent[0].id }));
  assert.equal(await missed, true);
});

test("an insertion that the server has is not sent again", async () => {
  const { connection, document } = opened();
  const builder = new EditBuilder(document.json);
  builder.append("/fixtures", { id: "D" });
  const done = document.edit({ label: "Copy", ops: builder.ops });
  connection.sent[0].reject(new Lost());
  await settled();
  connection.sent.length = 0;
  connection.onEvent({ ...project, revision: 6, json: builder.json });
  assert.equal(await done, true);
  assert.equal(connection.sent.length, 0);
  assert.equal(document.json.fixtures.length, 4);
});

test("edits that take each other back, or follow each other, are received or sent in their order", async () => {
  const at = (x) => ({ fixtures: [{ id: "A", at: [x, 0] }, ...store.fixtures.slice(1)] });
  for (const [steps, there, sentAgain] of [
    [[9, 0], 0, []], // whether both have been received or neither
    [[9, 0], 9, ["Move 0"]],
    [[8, 9], 9, []],
    [[8, 9], 8, ["Move 0"]],
  ]) {
    const { connection, document, move } = opened();
    const done = steps.map((x) => document.edit(move(0, x)));
    for (const { reject } of connection.sent) reject(new Lost());
    await settled();
    connection.sent.length = 0;
    connection.onEvent({ ...project, revision: 7, json: at(there) });
    const labels = connection.sent.map(({ members }) => members.label);
    assert.deepEqual(labels, sentAgain, `${steps} at ${there}`);
    for (const [k, { id, members }] of connection.sent.entries())
      connection.onEvent(changed(8 + k, members.ops, { tab: 1, request: id }));
    assert.deepEqual(await Promise.all(done), [true, true]);
    assert.equal(document.json.fixtures[0].at[0], steps[1]);
  }
});

test("without a connection, nothing is undone, and the reason is said", async () => {
  const { connection, document } = opened();
  const reasons = [];
  document.onRefused = (what) => reasons.push(what);
  const done = document.undo();
  connection.sent[0].reject(new Lost());
  assert.equal(await done, false);
  assert.deepEqual(reasons, ["undo"]);
});

test("an own edit that comes after an outside change says so", () => {
  const { connection, document, move } = opened();
  const news = [];
  document.onOthers = ({ by }) => news.push(by === "tab");
  const edit = move(0, 9);
  void document.edit(edit);
  connection.onEvent(changed(6, edit.ops, { tab: 1, request: connection.sent[0].id }));
  assert.deepEqual(news, []);
  void document.edit(move(1, 8));
  connection.onEvent(changed(8, undefined, { json: document.json, tab: 1, request: connection.sent[1].id }));
  assert.deepEqual(news, [false]);
});

test("an event that does not fit begins again", () => {
  const { connection, document } = opened();
  connection.onEvent(changed(6, [{ path: "/fixtures/2/at/0", before: 99, after: 7 }], { tab: 2 }));
  assert.equal(connection.reopened, 1);
  assert.deepEqual(document.json, store);
});

test("a locked store takes no edits", async () => {
  const { connection, document, move } = opened();
  connection.onEvent(changed(5, undefined, { locked: { message: "line 3" } }));
  assert.equal(await document.edit(move(0, 9)), false);
  assert.equal(connection.sent.length, 0);
  assert.equal(document.canUndo, false);
  connection.onEvent(changed(5));
  void document.edit(move(0, 9));
  assert.equal(connection.sent.length, 1);
});

test("labels are replaced in the middle", () => {
  const labels = new Devices("label");
  const frame = (from, remove, heights) => {
    const flat = (of) => Float32Array.from(heights.flatMap(of));
    const arrays = {
      position: flat((z) => [0, 0, z]),
      normal: flat(() => [1, 0, 0]),
      level: Uint8Array.from(heights),
      source_kind: Uint8Array.from(heights, () => 1),
      source: Uint32Array.from(heights),
    };
    return { about: { event: "labels", revision: 1, from, remove }, get: (name) => arrays[name] };
  };
  labels.receive(frame(0, 0, [1, 2, 3, 4]));
  labels.receive(frame(1, 2, [7, 8, 9]));
  assert.deepEqual([...labels.state], [1, 7, 8, 9, 4]);
  assert.deepEqual(labels.at(4), [0, 0, 4]);
  assert.equal(labels.pathOf(2), "/fixtures/8");
  assert.deepEqual(labels.ofElements(new Set(["/fixtures/9"])), new Map([["/fixtures/9", [3]]]));
});
