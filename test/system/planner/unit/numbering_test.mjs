import assert from "node:assert/strict";
import { test } from "node:test";

import fc from "fast-check";

import { EditBuilder } from "../../../../src/page/planner/document/edit";
import { giveIds, inReadingOrder, namesIn, namingOf } from "../../../../src/page/planner/elements/numbering";
import { points } from "./support.mjs";

const at = (x, y, value, path = `/fixtures/${value.id}`) => ({ path, value, middle: [x, y] });

test("from left to right, and from top to bottom", () => {
  const all = [at(5, 1, { id: "d" }), at(1, 1.3, { id: "c" }), at(9, 8, { id: "b" }), at(2, 8.5, { id: "a" })];
  assert.deepEqual(
    inReadingOrder(all).map(({ value }) => value.id),
    ["a", "b", "c", "d"],
  );
});

test("rows have as many numbers as copies, and none is taken twice", () => {
  const row = { id: "G{n}", repeat: { first: 5, count: 3, step: [0, 2] } };
  const naming = namingOf([at(1, 1, { id: "x" }), at(1, 5, row)], "A{n}", new Set(["A2", "A7"]));
  assert.deepEqual(
    naming.map(({ first, count }) => [first, count]),
    points("3,3 6,1"),
  );
  assert.equal(namesIn(naming, "A{n}"), "A3–A5, A6");
  fc.assert(
    fc.property(
      fc.array(fc.tuple(fc.nat(9), fc.nat(9), fc.integer({ min: 1, max: 4 })), { maxLength: 12 }),
      fc.array(fc.integer({ min: 1, max: 20 })),
      (places, taken) => {
        const others = new Set(taken.map((number) => `A${number}`));
        const elements = places.map(([x, y, count], k) =>
          at(x, y, { id: "r{n}", repeat: { count } }, `/fixtures/${k}`),
        );
        const ids = namingOf(elements, "A{n}", others).flatMap(({ first, count }) =>
          Array.from({ length: count }, (_, k) => `A${first + k}`),
        );
        assert.equal(new Set([...ids, ...others]).size, ids.length + others.size);
      },
    ),
  );
});

test("what names a fixture follows it", () => {
  const json = {
    fixtures: [
      { id: "G{n}", repeat: { count: 2, step: [0, 2] } },
      { id: "E", against: { fixture: "G2", side: "left" } },
    ],
    transceivers: { on: [{ fixture: "E", type: "t" }] },
  };
  const builder = new EditBuilder(json);
  const elements = json.fixtures.map((value, k) => at(k, -k, value, `/fixtures/${k}`));
  giveIds(builder, namingOf(elements, "Aisle {n}", new Set(["Aisle 1"])), "Aisle {n}");
  const { fixtures, transceivers } = builder.json;
  assert.deepEqual([fixtures[0].id, fixtures[0].repeat.first, fixtures[1].id], ["Aisle {n}", 2, "Aisle 4"]);
  assert.equal(fixtures[1].against.fixture, "Aisle 3");
  assert.equal(transceivers.on[0].fixture, "Aisle 4");
});
