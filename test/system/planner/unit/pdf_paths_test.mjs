import assert from "node:assert/strict";
import { test } from "node:test";

import { linesOf } from "../../../../src/page/planner/pdf/paths";
import { LineIndex } from "../../../../src/page/planner/sheet/line_index";
import { points } from "./support.mjs";

const names =
  "save restore transform setGState setFillRGBColor setStrokeRGBColor setFillColorN setStrokeColorN " +
  "setFillTransparent setStrokeTransparent shadingFill paintImageXObject paintInlineImageXObject constructPath endPath " +
  "stroke closeStroke fill eoFill fillStroke eoFillStroke closeFillStroke closeEOFillStroke clip eoClip " +
  "paintFormXObjectBegin paintFormXObjectEnd beginGroup endGroup beginMarkedContent beginMarkedContentProps " +
  "endMarkedContent";
const ops = Object.fromEntries(names.split(" ").map((name, k) => [name, k + 1]));
const identity = [1, 0, 0, 1, 0, 0];
const [move, line, curve, quadratic, close] = [0, 1, 2, 3, 4];

/** `operations`: [name, ...arguments]. */
const read = (operations, { page = identity, size = [1000, 700], isVisible = () => true } = {}) =>
  linesOf(
    { fnArray: operations.map(([name]) => ops[name]), argsArray: operations.map(([, ...args]) => args) },
    ops,
    { page, size },
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
  assert.equal(lengthOf(read([path(square, "endPath")])), 0);
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

/** A rectangle from a corner, with its sizes. */
const box = (x, y, width, height) =>
  [move, x, y, line, x + width, y, line, x + width, y + height].concat([line, x, y + height, close]);
const clip = (numbers, rule = "clip") => [[rule], path(numbers, "endPath")];
const fillColour = (colour) => ["setFillRGBColor", colour];
const strokeColour = (colour) => ["setStrokeRGBColor", colour];
const across = path([move, 0, 350, line, 1000, 350]);
const counts = ({ ends, firsts }) => [ends.length / 4, firsts.length - 1];
/** The parts of the line across the page, from left to right. */
const partsOf = (lines) =>
  linesIn(lines)
    .filter(([, y, , v]) => y === 350 && v === 350)
    .map(([x, , u]) => [x, u].map(Math.round));

test("lines end at clip paths, also nested ones and those of forms", () => {
  const viewport = read([
    ["save"],
    ...clip(box(90, 90, 820, 520)),
    path(box(100, 100, 800, 500)),
    path([move, 100, 350, line, 5000, 350]),
    path([move, 400, 650, line, 400, 2000]),
    path(box(300, 640, 300, 40)),
    path(box(800, 500, 300, 50)), // half of it is seen, and it is no outline
    ["restore"],
    path([move, 400, 650, line, 400, 690]),
  ]);
  assert.deepEqual(counts(viewport), [4 + 1 + 3 + 1, 1]);
  assert.deepEqual(partsOf(viewport), [[100, 910]]);
  assert.ok(
    linesIn(viewport).some((ends) => ends.join() === "400,650,400,690"),
    "after the clip",
  );
  const both = [...clip(box(100, 0, 500, 700)), ...clip(box(300, 0, 600, 700))];
  assert.deepEqual(partsOf(read([...both, across])), [[300, 600]]);
  assert.deepEqual(counts(read([...clip(box(0, 0, 9, 9)), ...clip(box(20, 0, 9, 9)), path(square)])), [0, 0]);
  const form = (...within) => [["paintFormXObjectBegin", [1, 0, 0, 1, 100, 0], [0, 0, 300, 700]], ...within];
  const forms = [
    ...form(["save"], ...clip(box(50, 0, 999, 700)), across, ["restore"]),
    ["paintFormXObjectEnd"],
    across,
  ];
  assert.deepEqual(partsOf(read(forms)), points("150,400 0,1000"));
  const group = [["beginGroup", { bbox: [200, 0, 300, 700] }], across, ["endGroup", {}], across];
  assert.deepEqual(partsOf(read(group)), points("200,300 0,1000"));
  assert.deepEqual(partsOf(read([path([move, -500, 350, line, 400, 350])])), [[0, 400]], "the page");
});

test("clip paths are polygons and curves, by both rules", () => {
  const diamond = [move, 500, 50, line, 800, 350, line, 500, 650, line, 200, 350, close];
  const frame = [...box(100, 100, 800, 500), ...box(300, 200, 400, 300)];
  assert.deepEqual(partsOf(read([...clip(diamond), across])), [[200, 800]]);
  assert.deepEqual(partsOf(read([...clip(frame), across])), [[100, 900]]);
  assert.deepEqual(partsOf(read([...clip(frame, "eoClip"), across])), points("100,300 700,900"));
  const k = 0.5522847498 * 300;
  const half = [move, 200, 350, curve, 200, 350 - k, 500 - k, 50, 500, 50, curve, 500 + k, 50, 800, 350 - k, 800, 350];
  assert.deepEqual(
    partsOf(read([...clip(half), path([move, 500, 0, line, 500, 700]), across])),
    [[200, 800]],
    "its chord",
  );
  // A line along the edge of a clip is seen, and so is the outline that is the clip.
  assert.deepEqual(counts(read([...clip(diamond), path(diamond)])), [4, 1]);
  assert.deepEqual(counts(read([["clip"], path(diamond), across])), [5, 1], "painted, and then a clip");
});

test("later opaque fills cover lines, and white ones are seen on colours only", () => {
  const room = path(box(200, 200, 100, 300));
  const cover = (...before) => [room, across, ...before, path(box(190, 190, 120, 320), "fill")];
  const white = fillColour("#ffffff");
  assert.deepEqual(counts(read(cover(white))), [2, 0]);
  assert.deepEqual(partsOf(read(cover(white))), points("0,190 310,1000"));
  assert.deepEqual(counts(read(cover(fillColour("#808080")))), [2 + 4, 1], "its own edges are seen");
  const seen = {
    "a pattern": ["setFillColorN", "pattern"],
    "half transparent": ["setGState", [["ca", 0.5]]],
    multiplied: ["setGState", [["BM", "multiply"]]],
    masked: ["setGState", [["SMask", { subtype: "Alpha" }]]],
  };
  for (const [what, before] of Object.entries(seen)) assert.equal(partsOf(read(cover(before))).length, 1, what);
  const half = [["setGState", [["ca", 0.5]]], ["beginGroup", {}], white];
  assert.equal(partsOf(read(cover(...half))).length, 1, "a group that others shine through");
  assert.equal(partsOf(read(cover(["beginGroup", {}], white))).length, 2);
  assert.equal(partsOf(read([path(box(190, 190, 120, 320), "fill"), across])).length, 1, "an earlier fill");
  const clippedFill = [across, ["save"], ...clip(box(400, 0, 100, 700)), white, path(box(0, 0, 1000, 700), "fill")];
  assert.deepEqual(partsOf(read(clippedFill)), points("0,400 500,1000"));
  const frame = [...box(100, 100, 800, 500), ...box(300, 200, 400, 300)];
  assert.equal(partsOf(read([across, white, path(frame, "eoFill")])).length, 3);
  assert.equal(partsOf(read([across, white, path(frame, "fill")])).length, 2);
  const hiddenFill = [
    ["beginMarkedContentProps", "OC", "x"],
    path(box(190, 190, 120, 320), "fill"),
    ["endMarkedContent"],
  ];
  const hidden = read([across, ...hiddenFill], { isVisible: () => false });
  assert.equal(partsOf(hidden).length, 1, "a fill of a hidden layer");
});

test("white lines and fills are seen where something darker is beneath", () => {
  const white = [fillColour("#ffffff"), strokeColour("#ffffff")];
  assert.deepEqual(counts(read([...white, path(square), path(square, "fill")])), [0, 0]);
  assert.deepEqual(counts(read([...white, strokeColour("#000000"), path(square, "fillStroke")])), [4, 1]);
  const walls = path(box(100, 100, 800, 500), "fill");
  const rooms = read([walls, ...white, path(box(110, 110, 380, 480), "fill"), path(box(510, 110, 380, 480), "fill")]);
  assert.deepEqual(counts(rooms), [12, 3], "rooms in walls that are one area");
  assert.deepEqual(counts(read([walls, ...white, across])), [5, 1], "a white line on a dark area");
  const image = [
    ["transform", 800, 0, 0, 500, 100, 100],
    ["paintImageXObject", "img"],
  ];
  const onImage = read([["save"], ...image, ["restore"], ...white, path(box(200, 200, 90, 90))]);
  assert.deepEqual(counts(onImage), [4, 1]);
  const mask = read([["beginGroup", { smask: {} }], path(square), ["endGroup", { smask: {} }]]);
  assert.deepEqual(counts(mask), [0, 0]);
});

test("an outline stays one beneath small fills", () => {
  const column = path(box(480, 90, 40, 40), "fill");
  assert.deepEqual(counts(read([path(box(100, 100, 800, 500)), column])), [4 + 1 + 4, 2]);
});

test("lines are found by place, and outlines by what they contain", () => {
  const inner = [move, 0.5, 0.5, line, 1, 0.5, line, 1, 1, line, 0.5, 0.5];
  const index = new LineIndex(read([path(square), path(inner)]));
  assert.equal(index.count, 7);
  assert.deepEqual(index.near([1, 0.1], 0.2, 9), [points("0,0 2,0")]);
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
