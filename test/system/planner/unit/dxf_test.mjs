import assert from "node:assert/strict";
import { test } from "node:test";

import fc from "fast-check";

import { colourOfIndex, luminance, onWhite } from "../../../../src/page/planner/dxf/palette";
import { readDxf } from "../../../../src/page/planner/dxf/reader";
import { plainParagraphs, plainText } from "../../../../src/page/planner/dxf/text";
import { proposedUnit } from "../../../../src/page/planner/dxf/unit";
import { rejects } from "./snap_shop.mjs";

const bytesOf = (text) => new TextEncoder().encode(text);
const tags = (...values) => values.map((value) => `${value}\n`).join("");
const section = (name, ...content) => tags(0, "SECTION", 2, name) + content.join("") + tags(0, "ENDSEC");
const fileOf = (...sections) => sections.join("") + tags(0, "EOF");
const entity = (type, ...more) => tags(0, type, 8, "0", ...more);
const line = (x0, y0, x1, y1, layer = "0") => tags(0, "LINE", 8, layer, 10, x0, 20, y0, 11, x1, 21, y1);
const block = (name, ...content) =>
  tags(0, "BLOCK", 8, "0", 2, name, 70, 0, 10, 0, 20, 0) + content.join("") + tags(0, "ENDBLK");
const drawn = (...content) => readDxf(bytesOf(fileOf(section("ENTITIES", ...content))));
const inserted = (blocks, ...content) =>
  readDxf(bytesOf(fileOf(section("BLOCKS", ...blocks), section("ENTITIES", ...content))));

/** In the coordinates of the drawing. */
const linesOf = ({ segments, origin }) =>
  Array.from({ length: segments.length / 4 }, (_, k) =>
    [0, 1, 2, 3].map((axis) => Number((segments[4 * k + axis] + origin[axis % 2]).toFixed(4)) + 0),
  );
const lengthOf = (drawing) => linesOf(drawing).reduce((sum, [x0, y0, x1, y1]) => sum + Math.hypot(x1 - x0, y1 - y0), 0);
const isNear = (found, expected, share = 2e-4) =>
  assert.ok(Math.abs(found - expected) <= share * expected, `${found} instead of ${expected}`);
const fails = (text, code, values = {}) =>
  assert.throws(
    () => readDxf(bytesOf(text)),
    (error) => {
      assert.deepEqual([error.name, error.code, { ...error.values, ...values }], ["DxfError", code, error.values]);
      return true;
    },
  );

test("curves have the lengths of their formulas", () => {
  const half = tags(10, -3, 20, 0, 42, 1, 10, 3, 20, 0);
  isNear(lengthOf(drawn(entity("LWPOLYLINE", 90, 2, 70, 0), half)), 3 * Math.PI);
  isNear(lengthOf(drawn(entity("LWPOLYLINE", 90, 2, 70, 1), half)), 3 * Math.PI + 6);
  isNear(lengthOf(drawn(entity("CIRCLE", 10, 1, 20, 1, 40, 5))), 10 * Math.PI);
  isNear(lengthOf(drawn(entity("ARC", 10, 1, 20, 1, 40, 5, 50, 350, 51, 20))), (5 * Math.PI) / 6);
  // A quarter of a circle as a rational curve.
  const weights = tags(41, 1, 41, Math.SQRT1_2, 41, 1);
  const knots = tags(...[0, 0, 0, 1, 1, 1].flatMap((knot) => [40, knot]));
  const corners = tags(10, 2, 20, 0, 10, 2, 20, 2, 10, 0, 20, 2);
  const quarter = drawn(entity("SPLINE", 70, 4, 71, 2) + knots + weights + corners);
  isNear(lengthOf(quarter), Math.PI);
  for (const [x, y] of linesOf(quarter)) isNear(Math.hypot(x, y), 2);
  assert.throws(() => isNear(lengthOf(quarter), 1.001 * Math.PI));
});

test("a bulge below 0 is on the right of its edge", () => {
  const above = drawn(entity("LWPOLYLINE", 70, 0), tags(10, 0, 20, 0, 42, -1, 10, 2, 20, 0));
  assert.deepEqual(above.origin, [0, 0]);
  isNear(above.size[1], 1);
  const below = drawn(entity("LWPOLYLINE", 70, 0), tags(10, 0, 20, 0, 42, 1, 10, 2, 20, 0));
  isNear(-below.origin[1], 1);
});

test("blocks are mirrored, turned, repeated and nested", () => {
  const part = block("PART", line(0, 0, 2, 1));
  const insert = (...more) => entity("INSERT", 2, "part", ...more);
  assert.deepEqual(linesOf(inserted([part], insert(10, 10, 20, 5, 41, -1))), [[10, 5, 8, 6]]);
  assert.deepEqual(linesOf(inserted([part], insert(10, 10, 20, 5, 50, 90))), [[10, 5, 9, 7]]);
  assert.deepEqual(linesOf(inserted([part], insert(10, 10, 20, 5, 230, -1))), [[-10, 5, -12, 6]]);
  const grid = insert(10, 1, 20, 1, 70, 2, 71, 2, 44, 10, 45, 20, 50, 90);
  assert.deepEqual(
    linesOf(inserted([part], grid)).map(([x, y]) => [x, y]),
    [
      [1, 1],
      [1, 11],
      [-19, 1],
      [-19, 11],
    ],
  );
  const outer = block("OUTER", insert(10, 1, 20, 0, 41, 2), insert(10, 0, 20, 3));
  const nested = inserted([part, outer], entity("INSERT", 2, "OUTER", 10, 100, 20, 0, 42, -1));
  assert.deepEqual(linesOf(nested), [
    [101, 0, 105, -1],
    [100, -3, 102, -4],
  ]);
});

test("layer 0 of a block is that of its insert, and a frozen insert hides all", () => {
  const table = section(
    "TABLES",
    tags(0, "TABLE", 2, "LAYER"),
    tags(0, "LAYER", 2, "ICE", 70, 1, 62, 3),
    tags(0, "LAYER", 2, "Dark", 70, 0, 62, -7),
    tags(0, "LAYER", 2, "True", 70, 0, 62, 1, 420, 0x102030),
    tags(0, "ENDTAB"),
  );
  const part = block("PART", line(0, 0, 1, 0), line(0, 0, 0, 3, "TRUE"));
  const insert = (layer) => tags(0, "INSERT", 8, layer, 2, "PART", 10, 0, 20, 0);
  const content = section("ENTITIES", insert("dark"), insert("ice"), insert("0"));
  const { layers } = readDxf(bytesOf(fileOf(table, section("BLOCKS", part), content)));
  assert.deepEqual(
    layers.map(({ name, isOn, lines, colour }) => [name, isOn, lines, colour]),
    [
      ["0", true, 1, "#000000"],
      ["Dark", false, 1, "#000000"],
      ["ICE", false, 2, "#00ad00"],
      ["True", true, 2, "#102030"],
    ],
  );
});

test("outlines are closed polylines, circles, and polylines that end where they begin", () => {
  const corners = tags(10, 5, 20, 5, 10, 9, 20, 5, 10, 9, 20, 8);
  const { outlines, layers, origin } = drawn(
    entity("LWPOLYLINE", 70, 1) + corners,
    entity("LWPOLYLINE", 70, 0) + corners,
    entity("LWPOLYLINE", 70, 0) + corners + tags(10, 5, 20, 5),
    entity("CIRCLE", 10, 0, 20, 0, 40, 1),
  );
  assert.deepEqual(
    outlines.map(({ points }) => points.length),
    [3, 3, 158],
  );
  assert.deepEqual(
    outlines[1].points.map(([x, y]) => [x + origin[0], y + origin[1]].map((value) => Number(value.toFixed(4)))),
    [
      [5, 5],
      [9, 5],
      [9, 8],
    ],
  );
  assert.equal(layers[0].outlines, 3);
});

test("polylines of vertices leave out frames of curves, and meshes are only named", () => {
  const vertex = (x, y, flags = 0) => entity("VERTEX", 10, x, 20, y, 70, flags);
  const end = entity("SEQEND");
  const polyline = (flags) => entity("POLYLINE", 66, 1, 10, 0, 20, 0, 70, flags);
  const drawing = drawn(
    polyline(4) + vertex(0, 0) + vertex(1, 9, 16) + vertex(2, 0) + end,
    polyline(64) + vertex(0, 0, 192) + vertex(5, 5, 192) + end,
  );
  assert.deepEqual(linesOf(drawing), [[0, 0, 2, 0]]);
  assert.deepEqual(drawing.notes, [{ code: "unsupported", name: "POLYFACE", count: 1 }]);
});

test("texts stand where their anchor says, and turn and grow with their block", () => {
  const text = (...more) => entity("TEXT", 1, "A%%d", 10, 1, 20, 2, 40, 3, ...more);
  const box = line(0, 0, 1, 1);
  const { texts } = drawn(box, text(), text(72, 1, 73, 2, 11, 5, 21, 6), text(72, 4, 11, 7, 21, 8, 50, 30));
  assert.deepEqual(
    texts.map(({ at, anchor, turn, height, text }) => [at, anchor, Math.round(turn), height, text]),
    [
      [[1, 2], [0, 0], 0, 3, "A°"],
      [[5, 6], [0.5, 0.5], 0, 3, "A°"],
      [[7, 8], [0.5, 0.5], 30, 3, "A°"],
    ],
  );
  const part = block("PART", text(50, 10));
  const [one] = inserted([part], box, entity("INSERT", 2, "PART", 10, 10, 20, 0, 41, 2, 42, 2, 50, 90)).texts;
  assert.deepEqual([one.at.map(Math.round), Math.round(one.turn), Math.round(1e6 * one.height)], [[6, 2], 100, 6e6]);
  const [long] = drawn(box, entity("MTEXT", 10, 3, 20, 4, 40, 2, 71, 3, 3, "a\\P", 1, "b", 11, 0, 21, 1)).texts;
  assert.deepEqual([long.text, long.anchor, Math.round(long.turn)], ["a\nb", [1, 1], 90]);
});

test("texts lose their formatting", () => {
  assert.equal(plainText("%%uPlan%%u %%C5 %%065 \\U+00e9 50%%% ^ "), "Plan Ø5 A é 50% ^");
  assert.equal(plainText("\\M+18341"), "ア");
  assert.equal(
    plainParagraphs("{\\fArial|b1;\\C3;Wide}\\P\\H2.5x;\\Lline\\l \\\\ \\{x\\}\\~y \\S1#2;"),
    "Wide\nline \\ {x}\u00a0y 1/2",
  );
});

test("layer colours can be told from white", () => {
  assert.deepEqual([1, 3, 5, 12, 21, 250].map(colourOfIndex), [
    [255, 0, 0],
    [0, 255, 0],
    [0, 0, 255],
    [165, 0, 0],
    [255, 159, 127],
    [51, 51, 51],
  ]);
  for (let index = 0; index <= 256; ++index) {
    const colour = onWhite(colourOfIndex(index));
    assert.match(colour, /^#[0-9a-f]{6}$/);
    assert.ok(luminance([1, 3, 5].map((at) => Number.parseInt(colour.slice(at, at + 2), 16))) <= 0.3, colour);
  }
  assert.equal(onWhite([255, 255, 255]), "#000000");
});

test("files that cannot be read are refused by name and line", () => {
  fails("AutoCAD Binary DXF\r\n\x1a\0", "binary");
  fails("AC1027\0\0", "dwg", { version: "AC1027" });
  fails("", "not_dxf");
  fails("Dear all,\n", "not_dxf");
  fails(fileOf(section("ENTITIES")), "empty");
  const file = fileOf(section("ENTITIES", line(0, 0, 1, 1)));
  fails(file.replace("10\n0", "10\nnan"), "bad_number", { line: 10, code: 10 });
  fails(file.replace("10\n0", "1o\n0"), "bad_code", { line: 9 });
  for (let length = 20; length < file.length - 4; ++length) fails(file.slice(0, length), "truncated");
  fails(file.replace("0\nENDSEC\n", ""), "truncated", { line: 17 });
  assert.equal(readDxf(bytesOf(file.slice(0, -1))).segments.length, 4);
  assert.throws(() => readDxf(bytesOf(file), { bytes: 10 }), {
    code: "too_large",
    values: { bytes: file.length, limit: 10 },
  });
});

test("numbers are those of their digits", () => {
  const value = fc.oneof(
    fc.double({ noNaN: true, noDefaultInfinity: true, min: -1e9, max: 1e9 }),
    fc.integer(),
    fc.tuple(fc.integer({ min: -1e15, max: 1e15 }), fc.integer({ min: -25, max: 5 })).map(([m, e]) => `${m}e${e}`),
  );
  fc.assert(
    fc.property(value, (x) => {
      const { origin } = drawn(line(x, 0, 1e25, 0));
      const expected = Number(x);
      assert.ok(Math.abs(origin[0] - expected) <= 2e-15 * Math.abs(expected) + 1e-290, `${origin[0]} instead of ${x}`);
    }),
  );
});

test("blocks that explode or contain themselves stop", () => {
  const ten = (name) => Array.from({ length: 10 }, () => entity("INSERT", 2, name)).join("");
  const bomb = [
    block("B0", line(0, 0, 1, 1)),
    ...Array.from({ length: 10 }, (_, k) => block(`B${k + 1}`, ten(`B${k}`))),
  ];
  assert.throws(() => inserted(bomb, ten("B10")), { code: "too_many", values: { block: "B6", limit: 2e6 } });
  assert.equal(inserted(bomb, ten("B4")).segments.length / 4, 1e5);
  const { notes, segments } = inserted(
    [block("A", line(0, 0, 1, 1), entity("INSERT", 2, "a"))],
    entity("INSERT", 2, "A"),
  );
  assert.deepEqual([notes, segments.length], [[{ code: "recursive_block", name: "A", count: 1 }], 4]);
  assert.throws(
    () => readDxf(bytesOf(fileOf(section("ENTITIES", ten("X"), line(0, 0, 1, 1), line(0, 0, 1, 2)))), { lines: 1 }),
    {
      code: "too_many",
    },
  );
});

test("the size of a drawing that names no unit tells it", () => {
  const shop = (size) => drawn(line(0, 0, size, 0), line(size, 0, size, size / 2), line(size, size / 2, 0, 0));
  assert.deepEqual(
    [60, 40000, 12000, 1500].map((size) => proposedUnit({ ...shop(size), measurement: "metric" }).unit),
    ["m", "mm", "mm", "cm"],
  );
  assert.equal(proposedUnit({ ...shop(60), unit: "m" }).why, "header");
  assert.deepEqual(proposedUnit({ ...shop(700), unit: "mm", measurement: "imperial" }), { unit: "in", why: "size" });
  assert.equal(proposedUnit({ ...shop(200), measurement: "imperial" }).unit, "ft");
});

const sample = fileOf(
  section("HEADER", tags(9, "$ACADVER", 1, "AC1015", 9, "$DWGCODEPAGE", 3, "ANSI_1252", 9, "$INSUNITS", 70, 4)),
  section("TABLES", tags(0, "TABLE", 2, "LAYER", 0, "LAYER", 2, "WALL", 70, 0, 62, 3, 0, "ENDTAB")),
  section(
    "BLOCKS",
    block("A", line(0, 0, 1, 1), entity("CIRCLE", 10, 0, 20, 0, 40, 2)),
    block("B", entity("INSERT", 2, "A")),
  ),
  section(
    "ENTITIES",
    line(0, 0, 5, 5, "WALL"),
    entity("INSERT", 2, "B", 10, 3, 20, 4, 41, 2, 70, 3, 71, 2, 44, 5, 45, 6),
    entity("LWPOLYLINE", 90, 3, 70, 1, 10, 0, 20, 0, 42, 0.5, 10, 4, 20, 0, 10, 4, 20, 4),
    entity("POLYLINE", 66, 1, 70, 1) +
      entity("VERTEX", 10, 0, 20, 0) +
      entity("VERTEX", 10, 1, 20, 0) +
      entity("SEQEND"),
    entity("SPLINE", 71, 2, 40, 0, 40, 0, 40, 0, 40, 1, 40, 1, 40, 1, 10, 0, 20, 0, 10, 1, 20, 3, 10, 2, 20, 0),
    entity("ELLIPSE", 10, 0, 20, 0, 11, 3, 21, 1, 40, 0.5, 41, 0, 42, 3),
    entity("HATCH", 91, 2, 92, 2, 72, 1, 73, 1, 93, 2, 10, 0, 20, 0, 42, 1, 10, 2, 20, 0, 42, 0, 97, 0, 92, 1, 93, 1),
    tags(72, 2, 10, 0, 20, 0, 40, 1, 50, 0, 51, 90, 73, 0, 97, 0, 75, 0, 76, 1),
    entity("MTEXT", 10, 0, 20, 0, 40, 1, 1, "{\\H2x;a}\\Pb"),
    entity("TEXT", 10, 0, 20, 0, 40, 1, 1, "%%d"),
    entity(
      "MLINE",
      71,
      1,
      11,
      0,
      21,
      0,
      13,
      0,
      23,
      1,
      74,
      2,
      41,
      1,
      41,
      0,
      74,
      1,
      41,
      -1,
      11,
      5,
      21,
      0,
      13,
      0,
      23,
      1,
      74,
      1,
      41,
      1,
    ),
  ),
);

/** Anything but a drawing or a DxfError is a failure, and so are coordinates that are no numbers. */
function readsOrRefuses(bytes) {
  try {
    const { segments, layerOf, layers, texts, outlines } = readDxf(bytes, { lines: 20_000 });
    assert.equal(segments.length, 4 * layerOf.length);
    assert.ok(segments.every(Number.isFinite));
    for (const layer of [...layerOf, ...texts.map(({ layer }) => layer), ...outlines.map(({ layer }) => layer)])
      assert.ok(layer < layers.length);
  } catch (error) {
    if (error.name !== "DxfError") throw error;
  }
}

test("whatever a file is, it is read or refused", () => {
  assert.equal(readDxf(bytesOf(sample)).notes.length, 0);
  const random = fc.uint8Array({ maxLength: 200 });
  fc.assert(fc.property(random, readsOrRefuses), { numRuns: 500 });
  const lines = sample.split("\n");
  const value = fc.oneof(
    fc.constantFrom(
      "0",
      "-1",
      "1e308",
      "-1e308",
      "1e-308",
      "1e20",
      "32767",
      "A",
      "B",
      "EOF",
      "ENDSEC",
      "ENDBLK",
      "INSERT",
      "",
    ),
    fc.integer({ min: -5, max: 1075 }).map(String),
    fc.constantFrom(...lines),
  );
  const edit = fc.tuple(fc.nat(lines.length - 1), fc.constantFrom("replace", "insert", "delete", "pair"), value, value);
  const edited = fc.array(edit, { minLength: 1, maxLength: 6 }).map((edits) => {
    const changed = [...lines];
    for (const [at, how, one, other] of edits)
      if (how === "replace") changed[at] = one;
      else if (how === "pair") changed.splice(at - (at % 2), 0, one, other);
      else changed.splice(at, how === "delete" ? 1 : 0, ...(how === "delete" ? [] : [one]));
    return bytesOf(changed.join("\n"));
  });
  fc.assert(fc.property(edited, readsOrRefuses), { numRuns: 5000 });
  const spoilt = fc
    .array(fc.tuple(fc.nat(sample.length - 1), fc.nat(255)), { minLength: 1, maxLength: 10 })
    .map((changes) => {
      const bytes = bytesOf(sample);
      for (const [at, byte] of changes) bytes[at] = byte;
      return bytes;
    });
  fc.assert(fc.property(spoilt, readsOrRefuses), { numRuns: 5000 });
  rejects(() => fc.assert(fc.property(random, (bytes) => readsOrRefuses(bytes.buffer.x.y))));
});
