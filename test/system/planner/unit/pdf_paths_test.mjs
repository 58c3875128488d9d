import assert from "node:assert/strict";
import { test } from "node:test";

import { linesOf } from "../../../../src/page/planner/pdf/paths";
import { LineIndex } from "../../../../src/page/planner/sheet/line_index";

const ops = Object.fromEntries(
  [
    "save",
    "restore",
    "transform",
    "constructPath",
    "endPath",
    "clip",
    "eoClip",
    "paintFormXObjectBegin",
    "paintFormXObjectEnd",
    "beginMarkedContent",
    "beginMarkedContentProps",
    "endMarkedContent",
    "stroke",
    "closeStroke",
    "fill",
  ].map((name, k) => [name, k + 1]),
);
const identity = [1, 0, 0, 1, 0, 0];
const [move, line, curve, quadratic, close] = [0, 1, 2, 3, 4];

/** `operations`: [name, ...arguments]. */
const read = (operations, { page = identity, isVisible = () => true } = {}) =>
  linesOf(
    { fnArray: operations.map(([name]) => ops[name]), argsArray: operations.map(([, ...args]) => args) },
    ops,
    page,
    isVisible,
  );
const path = (numbers, paint = "stroke") => ["constructPath", ops[paint], [Float32Array.from(numbers)], [0, 0, 1, 1]];
const square = [move, 0, 0, line, 2, 0, line, 2, 2, line, 0, 2, close];
const linesIn = ({ ends }) => Array.from({ length: ends.length / 4 }, (_, k) => [...ends.slice(4 * k, 4 * k + 4)]);
const lengthOf = (lines) => linesIn(lines).reduce((sum, [x, y, u, v]) => sum + Math.hypot(u - x, v - y), 0);

test("a path has its lines, in the coordinates of the picture", () => {
  const lines = read([path(square)], { page: [1, 0, 0, -1, 10, 100] });
  assert.deepEqual(linesIn(lines), [
    [10, 100, 12, 100],
    [12, 100, 12, 98],
    [12, 98, 10, 98],
    [10, 98, 10, 100],
  ]);
  assert.deepEqual([...lines.firsts], [0, 4]);
  assert.deepEqual([...lines.corners], [10, 100, 12, 100, 12, 98, 10, 98]);
});

test("transformations are nested, and end with their states and forms", () => {
  const lines = read([
    ["save"],
    ["transform", 2, 0, 0, 2, 10, 0],
    ["paintFormXObjectBegin", [0, 1, -1, 0, 5, 5], null],
    path([move, 0, 0, line, 1, 0]),
    ["paintFormXObjectEnd"],
    path([move, 0, 0, line, 1, 0]),
    ["restore"],
    path([move, 0, 0, line, 1, 0]),
    ["restore"], // more than there are
    path([move, 0, 0, line, 1, 0]),
  ]);
  assert.deepEqual(linesIn(lines), [
    [20, 10, 20, 12],
    [10, 0, 12, 0],
    [0, 0, 1, 0],
    [0, 0, 1, 0],
  ]);
});

test("curves are as long as theirs, and clips and hidden layers have no lines", () => {
  const k = 0.5522847498; // of a quarter of a circle
  const quarter = read([path([move, 1, 0, curve, 1, k, k, 1, 0, 1])]);
  assert.ok(Math.abs(lengthOf(quarter) - Math.PI / 2) < 0.005);
  assert.ok(lengthOf(read([path([move, 0, 0, quadratic, 1, 1, 2, 0])])) > 2);
  assert.equal(lengthOf(read([path(square, "endPath"), path(square, "clip")])), 0);
  const layered = [
    ["beginMarkedContentProps", "OC", "furniture"],
    ["beginMarkedContent", "Span"],
    path(square),
    ["endMarkedContent"],
    ["endMarkedContent"],
    path([move, 0, 0, line, 1, 0]),
  ];
  assert.equal(lengthOf(read(layered, { isVisible: (layer) => layer !== "furniture" })), 1);
  assert.equal(lengthOf(read(layered)), 9);
});

test("fills close their outlines, and strokes before them stay open", () => {
  const open = [move, 0, 0, line, 2, 0, line, 2, 2];
  const lines = read([path(open), path([...open, ...open.map((value, k) => value + (k % 3 === 0 ? 0 : 5))], "fill")]);
  assert.equal(linesIn(lines).length, 2 + 3 + 3);
  assert.deepEqual([...lines.firsts], [0, 3, 6]);
});

test("lines are found by place, and outlines by what they contain", () => {
  const inner = [move, 0.5, 0.5, line, 1, 0.5, line, 1, 1, line, 0.5, 0.5];
  const index = new LineIndex(read([path(square), path(inner)]));
  assert.equal(index.count, 7);
  assert.deepEqual(index.near([1, 0.1], 0.2, 9), [
    [
      [0, 0],
      [2, 0],
    ],
  ]);
  assert.equal(index.near([1, 0.75], 0.01, 9).length, 1);
  assert.equal(index.within({ lower: [1.5, 1.5], upper: [3, 3] }, 9).length, 2);
  assert.equal(index.outlineAt([0.9, 0.6]).length, 3);
  assert.equal(index.outlineAt([0.6, 0.9]).length, 4);
  assert.equal(index.outlineAt([3, 3]), null);
  assert.deepEqual(new LineIndex(read([])).near([0, 0], 1, 9), []);
  index.least = 1.5;
  assert.equal(index.near([1, 0.75], 0.3, 9).length, 0, "short lines");
  assert.equal(index.near([1, 0.1], 0.2, 9).length, 1);
  index.least = 0;
  index.shown = { lower: [-1, -1], upper: [1.5, 3] };
  assert.equal(index.near([2, 1], 0.1, 9).length, 0, "beyond the crop");
  assert.equal(index.near([1.4, 0], 0.05, 9).length, 1, "a line that reaches into the crop");
  assert.equal(index.outlineAt([1.2, 0.4]), null, "an outline that leaves the crop");
  assert.equal(index.outlineAt([0.9, 0.6]).length, 3);
});
