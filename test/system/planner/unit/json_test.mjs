import assert from "node:assert/strict";
import { test } from "node:test";

import fc from "fast-check";

import { EditBuilder } from "../../../../src/page/planner/document/edit";
import {
  applyOps,
  Conflict,
  equal,
  inverseOf,
  placesAfter,
  pointerTo,
  tokensOf,
  valueAt,
} from "../../../../src/page/planner/document/json";
import { times } from "./support.mjs";

const store = {
  name: "Kiosk",
  "a/b~c": 1,
  fixtures: [
    { id: "A", at: [1, 2] },
    { id: "B", at: [3, 4] },
    { id: "C", at: [5, 6] },
  ],
};

test("pointers escape their keys", () => {
  assert.equal(pointerTo("", "a/b~c", 0), "/a~1b~0c/0");
  assert.deepEqual(tokensOf("/a~1b~0c/0"), ["a/b~c", "0"]);
  assert.equal(valueAt(store, "/a~1b~0c"), 1);
  assert.equal(valueAt(store, "/fixtures/1/at/0"), 3);
  for (const missing of ["/fixtures/3", "/fixtures/x", "/name/0", "/toString"])
    assert.equal(valueAt(store, missing), undefined);
});

test("a change must find what it expects", () => {
  const wrong = [
    { path: "/fixtures/0/at/0", before: 2, after: 3 },
    { path: "/name", after: "new" },
    { path: "/missing", before: 1 },
    { path: "/fixtures/4", after: {} },
    { path: "/none/at", after: 1 },
  ];
  for (const op of wrong) assert.throws(() => applyOps(store, [op]), Conflict, op.path);
});

test("places follow insertions and removals before them", () => {
  const ops = [{ path: "/fixtures/0", before: store.fixtures[0] }];
  assert.equal(placesAfter(ops, store)("/fixtures/1/at"), "/fixtures/0/at");
  assert.equal(placesAfter(ops, store)("/fixtures/0"), null);
  assert.equal(placesAfter(ops, store)("/name"), "/name");
  assert.equal(placesAfter([{ path: "/fixtures/1", after: {} }], store)("/fixtures/1"), "/fixtures/2");
  assert.equal(placesAfter([{ path: "/fixtures/1", after: {} }], store)("/fixtures/0"), "/fixtures/0");
});

test("a builder writes only what differs", () => {
  const builder = new EditBuilder(store);
  builder.set("/fixtures/0/at", [1, 2.5]);
  builder.set("/fixtures/1/labels/spacing", 0.5);
  builder.set("/fixtures/2/id", "C");
  builder.set("/fixtures/2/none", undefined);
  assert.deepEqual(builder.ops, [
    { path: "/fixtures/0/at/1", before: 2, after: 2.5 },
    { path: "/fixtures/1/labels", after: { spacing: 0.5 } },
  ]);
  assert.equal(builder.append("/fixtures", { id: "D" }), "/fixtures/3");
  assert.equal(builder.append("/labels", { id: "L" }), "/labels/0");
  assert.deepEqual(builder.get("/labels"), [{ id: "L" }]);
});

/** Random changes of a random store. */
const changes = fc.array(
  fc.record({
    what: fc.constantFrom("set", "remove", "insert"),
    path: fc.constantFrom("/fixtures/0/at", "/fixtures/1", "/fixtures/0/labels", "/name", "/rooms/x"),
    index: fc.nat(3),
    value: fc.jsonValue({ maxDepth: 2 }).filter((value) => !JSON.stringify(value).includes("__proto__")),
  }),
  { maxLength: 12 },
);

test("edits and their inverses cancel", () => {
  fc.assert(
    fc.property(changes, (list) => {
      const builder = new EditBuilder(store);
      for (const { what, path, index, value } of list)
        try {
          if (what === "set") builder.set(path, value);
          else if (what === "remove") builder.set(path, undefined);
          else builder.insert("/fixtures", index, value);
        } catch (error) {
          assert.ok(error instanceof Conflict);
        }
      const after = applyOps(store, builder.ops);
      assert.ok(equal(after, builder.json));
      assert.ok(equal(applyOps(after, inverseOf(builder.ops)), store));
    }),
    { numRuns: times(200, 5000) },
  );
});
