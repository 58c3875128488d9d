import assert from "node:assert/strict";
import { test } from "node:test";
import { gunzipSync } from "node:zlib";

import fc from "fast-check";

import { colourOfIndex, luminance, onWhite } from "../../../../src/page/planner/dxf/palette";
import { readDxf } from "../../../../src/page/planner/dxf/reader";
import { plainParagraphs, plainText } from "../../../../src/page/planner/dxf/text";
import { DxfFault, DxfSheet } from "../../../../src/page/planner/dxf/show/sheet";
import { proposedUnit } from "../../../../src/page/planner/dxf/unit";
import { worded } from "../../../../src/page/planner/sheet/open";
import { mutantOf } from "../../../data/dxf_mutants.mjs";
import { bytesOf, dataFile, leastOfThree, points, rectangle, rejects, times } from "./support.mjs";

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

const stored = (name) => readDxf(dataFile(`field4/${name}`));

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
  // A turned ellipse: the squares of the shares of both radii add up to one.
  for (const [x, y] of linesOf(drawn(entity("ELLIPSE", 10, 0, 20, 0, 11, 3, 21, 1, 40, 0.5, 41, 0, 42, 3))))
    isNear(((3 * x + y) / 10) ** 2 + ((3 * y - x) / 5) ** 2, 1);
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
  const begins = linesOf(inserted([part], grid)).map(([x, y]) => [x, y]);
  assert.deepEqual(begins, points("1,1 1,11 -19,1 -19,11"));
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
  const corner = ([x, y]) => [x + origin[0], y + origin[1]].map((value) => Number(value.toFixed(4)));
  assert.deepEqual(outlines[1].points.map(corner), points("5,5 9,5 9,8"));
  assert.equal(layers[0].outlines, 3);
});

/** The corners of each outline, rounded. */
const cornersOf = ({ outlines, origin }) =>
  outlines.map(({ points }) => points.map((point) => point.map((value, axis) => Math.round(value + origin[axis]))));
/** Whether outlines have the same corners, in any order. */
const sameCorners = (found, expected) => {
  const sorted = (outlines) => outlines.map((points) => points.map(String).sort().join(" ")).sort();
  assert.deepEqual(sorted(found), sorted(expected));
};

test("polylines with a width are areas with mitres", () => {
  const walls = stored("wide_walls.dxf");
  sameCorners(cornersOf(walls), [rectangle(150, 150, 19850, 13850), rectangle(-150, -150, 20150, 14150)]);
  assert.equal(lengthOf(walls), 2 * (20300 + 14300 + 19700 + 13700) + 22000);
  sameCorners(cornersOf(stored("wide_taper.dxf")), [
    points("0,150 0,-150 20151,-150 20050,14000 19950,14000 19851,150"),
  ]);
  // The width of a polyline is that of vertices that have none; a hairline follows.
  const vertex = (x, y, ...more) => entity("VERTEX", 10, x, 20, y, ...more);
  const old = drawn(
    entity("POLYLINE", 66, 1, 10, 0, 20, 0, 70, 0, 40, 2, 41, 2) +
      vertex(0, 0) +
      vertex(10, 0, 40, 0, 41, 0) +
      vertex(30, 0, 40, 0, 41, 6) +
      vertex(30, 10, 40, 0, 41, 0) +
      entity("SEQEND"),
  );
  sameCorners(cornersOf(old), [rectangle(0, -1, 10, 1), points("30,0 27,10 33,10")]);
  assert.ok(linesOf(old).some((one) => String(one) === "10,0,30,0"));
  // In a block, scaled and turned.
  const path = entity("LWPOLYLINE", 70, 0, 43, 2) + tags(10, 0, 20, 0, 10, 10, 20, 0);
  const scaled = inserted([block("W", path)], entity("INSERT", 2, "W", 10, 0, 20, 0, 41, 2, 42, 3, 50, 90));
  sameCorners(cornersOf(scaled), [rectangle(-3, 0, 3, 20)]);
  // Some programs write -1 for none.
  assert.equal(drawn(path.replace("43\n2", "43\n-1.0")).segments.length, 4);
  // Negative control: without a width, the same lines are as before.
  const thin = drawn(path.replace("43\n2", "43\n0"));
  assert.deepEqual([linesOf(thin), thin.outlines], [[[0, 0, 10, 0]], []]);
});

test("polylines with a width have round edges, and no mitres that are too long", () => {
  const circle = (r, width) => entity("LWPOLYLINE", 70, 1, 43, width) + tags(10, -r, 20, 0, 42, 1, 10, r, 20, 0, 42, 1);
  isNear(lengthOf(drawn(circle(5, 2))), 2 * Math.PI * (4 + 6));
  const disc = drawn(circle(5, 10));
  isNear(lengthOf(disc), 2 * Math.PI * 10, 1e-3);
  assert.equal(drawn(circle(5, 2)).outlines.length, 2);
  const bent = (...points) => drawn(entity("LWPOLYLINE", 70, 0, 43, 2) + tags(...points.flat()));
  // A wall with an arc that runs on, one with an arc that does not, and a sharp angle.
  const on = bent([10, 0, 20, 0, 10, 10, 20, 0, 42, 1], [10, 10, 20, 8], [10, 0, 20, 8]);
  assert.equal(on.outlines.length, 1);
  isNear(lengthOf(on), 4 * 10 + Math.PI * (3 + 5) + 2 * 2);
  assert.equal(bent([10, 0, 20, 0, 10, 10, 20, 0, 42, -1], [10, 10, 20, 8]).outlines.length, 2);
  sameCorners(cornersOf(bent([10, 0, 20, 0], [10, 30, 20, 0], [10, 0, 20, 0])), [
    rectangle(0, -1, 30, 1),
    rectangle(0, -1, 30, 1),
  ]);
  // Shorter than its width: the mitres on the inner side would cross.
  const step = bent([10, 0, 20, 0], [10, 9, 20, 0], [10, 9, 20, 1], [10, 0, 20, 1]);
  assert.equal(step.outlines.length, 3);
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
  assert.deepEqual(drawing.notes, [{ code: "solid", name: "POLYFACE", count: 1 }]);
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

const named = (page, version, ...words) =>
  Buffer.concat([
    bytesOf(
      tags(0, "SECTION", 2, "HEADER", 9, "$ACADVER", 1, version, 9, "$DWGCODEPAGE", 3, page, 0, "ENDSEC") +
        tags(0, "SECTION", 2, "ENTITIES"),
    ),
    ...words.flatMap((word) => [bytesOf("0\nLINE\n8\n"), word, bytesOf(tags("", 10, 0, 20, 0, 11, 1, 21, 1))]),
    bytesOf(tags(0, "ENDSEC", 0, "EOF")),
  ]);
/** The names of layers, and the notes, of a file in which they are these bytes. */
const layersIn = (...given) => {
  const { layers, notes } = readDxf(named(...given.map((one, k) => (k < 2 ? one : Buffer.from(one, "hex")))));
  return [layers.map(({ name }) => name), notes.map(({ code, name }) => [code, name])];
};

test("names are decoded as texts are", () => {
  const namesOf = ({ layers }) => layers.map(({ name }) => name);
  const escaped = stored("layer_escape.dxf");
  assert.deepEqual([namesOf(escaped), escaped.texts[0].text], [["Türen", "Wände"], "Küche"]);
  const { layers } = drawn(line(0, 0, 1, 1, "\\M+18341"), line(0, 0, 1, 1, "ア"), line(0, 0, 1, 1, "\\U+30A2"));
  assert.deepEqual(
    layers.map(({ name, lines }) => [name, lines]),
    [["ア", 3]],
  );
  const part = block("T\\U+00FCr", line(0, 0, 2, 1));
  assert.equal(inserted([part], entity("INSERT", 2, "TÜR")).segments.length, 4);
  const outside = tags(0, "BLOCK", 8, "0", 2, "X", 70, 4, 1, "W\\U+00E4nde.dwg", 0, "ENDBLK");
  assert.equal(inserted([outside], line(0, 0, 1, 1)).notes[0].name, "Wände.dwg");
});

test("a code page that the file contradicts is named", () => {
  const wrong = stored("utf8_called_1252.dxf");
  assert.deepEqual(
    [wrong.layers.map(({ name }) => name), wrong.texts[0].text, wrong.notes],
    [["Türen", "Wände"], "Kühlräume für Süßes", [{ code: "utf8", name: "ANSI_1252", count: 1 }]],
  );
  assert.deepEqual(layersIn("ANSI_936", "AC1015", "e5b9b3e99da2"), [["平面"], [["utf8", "ANSI_936"]]]);
  assert.deepEqual(layersIn("no_page", "AC1015", "57c3a46e6465"), [["Wände"], [["utf8", "no_page"]]]);
  assert.deepEqual(layersIn("no_page", "AC1015", "57e46e6465"), [["Wände"], [["code_page", "no_page"]]]);
  assert.deepEqual(layersIn("UTF8", "AC1015", "57c3a46e6465"), [["Wände"], []]);
  // Negative controls: texts of these pages, some of which are UTF-8 by chance.
  for (const [page, bytes, word] of [
    ["ANSI_1252", "57e46e6465", "Wände"],
    ["ANSI_1250", "da8e4c4142cd", "ÚŽLABÍ"],
    ["ANSI_1251", "c2f1b8", "Всё"],
    ["ANSI_936", "c4bfc2bc", "目录"],
    ["ANSI_932", "94848fea835c955c", "売場ソ表"],
    ["ANSI_874", "e1bcb9bcd1a7", "แผนผัง"],
  ])
    assert.deepEqual(layersIn(page, "AC1015", bytes), [[word], []], page);
  // One text that is not UTF-8 shows that the page is right.
  assert.deepEqual(layersIn("ANSI_1252", "AC1015", "c3a4", "57e46e6465")[0], ["Ã¤", "Wände"]);
});

test("dimensions without a block that draws them are named", () => {
  const note = [{ code: "dimension", name: null, count: 1 }];
  assert.deepEqual(stored("dims_model_space.dxf").notes, note);
  const box = line(0, 0, 1, 1);
  const dimension = (...more) => entity("DIMENSION", 70, 32, ...more);
  const notesOf = (...more) => inserted([block("*D1", box), block("*D2")], box, dimension(...more)).notes;
  for (const name of ["*D9", "*PAPER_SPACE0", "$MODEL_SPACE", "*D2", ""])
    assert.deepEqual(notesOf(2, name), note, name);
  assert.deepEqual(notesOf(), note);
  assert.deepEqual(notesOf(2, "*D1"), []);
});

test("a model space of objects that are not shown is refused with their names and a remedy", () => {
  const refused = (read) => {
    try {
      read();
    } catch (error) {
      assert.equal(error.name, "DxfError");
      const { code: fault, values, notes } = error;
      const { message } = rejectionOf(() => worded(new DxfFault({ fault, values, notes })));
      return [fault, notes.map(({ code, name, count }) => [code, name, count]), message];
    }
    throw new Error("is read");
  };
  const rejectionOf = (call) => {
    try {
      return call();
    } catch (error) {
      return error;
    }
  };
  const [fault, notes, message] = refused(() => stored("aec_only.dxf"));
  assert.deepEqual([fault, notes], ["unshown", [["aec", "AEC_WALL", 12]]]);
  assert.match(message, /AEC_WALL.*12.*EXPORTTOAUTOCAD/);
  const solids = refused(() => stored("solids_only.dxf"));
  assert.deepEqual(solids.slice(0, 2), ["unshown", [["solid", "3DSOLID", 8]]]);
  assert.match(solids[2], /3DSOLID.*8.*FLATSHOT/);
  assert.deepEqual(refused(() => stored("dims_alone.dxf")).slice(0, 2), ["unshown", [["dimension", null, 2]]]);
  const proxy = entity("ACAD_PROXY_ENTITY", 90, 498, 91, 501);
  const classes = section("CLASSES", tags(0, "CLASS", 1, "OTHER"), tags(0, "CLASS", 1, "AEC_DOOR"));
  const many = () => {
    const content = [entity("BODY"), entity("REGION"), entity("PLANESURFACE"), proxy, proxy, entity("WIPEOUT")];
    readDxf(bytesOf(fileOf(classes, section("ENTITIES", ...content))));
  };
  assert.deepEqual(refused(many)[1], [
    ["aec", "AEC_DOOR", 2],
    ["solid", "BODY", 1],
    ["solid", "REGION", 1],
    ["solid", "PLANESURFACE", 1],
    ["unsupported", "WIPEOUT", 1],
  ]);
  assert.equal(refused(() => drawn(entity("INSERT", 2, "GONE")))[1][0][0], "missing_block");
  // Negative controls: the objects of paper space and of blocks that stand nowhere are not those of model space.
  const paper = entity("AEC_WALL", 67, 1);
  assert.deepEqual(refused(() => drawn(paper)).slice(0, 2), ["empty", []]);
  assert.deepEqual(refused(() => inserted([block("B", entity("AEC_WALL"))], paper)).slice(0, 2), ["empty", []]);
  assert.deepEqual(drawn(line(0, 0, 1, 1), entity("AEC_WALL")).notes, [{ code: "aec", name: "AEC_WALL", count: 1 }]);
});

test("texts that repeat a command are read in a time proportional to their length", () => {
  const commands = ["\\pxq", "\\f", "\\S1", "\\M+18341", "\\U+00e4", "\\\\", "\\p\\\\", "{\\H", "%%", "^", "{"];
  const secondsFor = (length) => {
    const before = process.cpuUsage();
    for (const command of commands)
      for (const type of ["MTEXT", "TEXT"])
        drawn(line(0, 0, 1, 1), entity(type, 10, 0, 20, 0, 40, 1, 1, command.repeat(length / command.length)));
    const { user, system } = process.cpuUsage(before);
    return (user + system) / 1e6;
  };
  const ratio = leastOfThree(secondsFor, 80e3) / leastOfThree(secondsFor, 20e3); // 16, if the time grew with the square
  assert.ok(ratio < 10, `${ratio}`);
});

test("a drawing that takes a minute is given up", async () => {
  const workers = [];
  const { Worker, setTimeout, clearTimeout } = globalThis;
  let now = 0;
  const timers = new Map();
  globalThis.setTimeout = (call, delay) => timers.set(timers.size, { call, at: now + delay }).size - 1;
  globalThis.clearTimeout = (timer) => timers.set(timer, { call: () => {}, at: Infinity });
  const tick = (delay) => {
    now += delay;
    for (const [timer, { call, at }] of timers)
      if (at <= now) {
        globalThis.clearTimeout(timer);
        call();
      }
  };
  globalThis.Worker = class {
    constructor() {
      workers.push(this);
    }
    postMessage(request) {
      this.request = request;
    }
    terminate() {
      this.isEnded = true;
    }
  };
  const settled = () => new Promise((done) => setImmediate(done));
  try {
    const late = DxfSheet.open(new ArrayBuffer(1), "").catch((error) => error);
    await settled();
    tick(59_000);
    await settled();
    assert.equal(workers[0].isEnded, undefined);
    tick(1_000);
    assert.equal((await late).given.fault, "slow");
    assert.ok(workers[0].isEnded);
    // The time of each step counts; after one that takes too long, none waits.
    const opened = DxfSheet.open(new ArrayBuffer(1), "");
    await settled();
    tick(59_000);
    workers[1].onmessage({ data: { facts: { size: [1, 1], layers: [] } } });
    const sheet = await opened;
    const steps = [sheet.lines(), sheet.lines()].map((step) => step.catch((error) => error.given.fault));
    await settled();
    tick(59_000);
    await settled();
    assert.equal(workers[1].isEnded, undefined);
    tick(1_000);
    assert.deepEqual(await Promise.all(steps), ["slow", "slow"]);
    assert.ok(workers[1].isEnded);
  } finally {
    Object.assign(globalThis, { Worker, setTimeout, clearTimeout });
  }
});

test("layer colours can be told from white", () => {
  assert.deepEqual(
    [1, 3, 5, 12, 21, 250].map(colourOfIndex),
    points("255,0,0 0,255,0 0,0,255 165,0,0 255,159,127 51,51,51"),
  );
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
  assert.deepEqual(proposedUnit({ ...shop(700), unit: "mm", measurement: "imperial" }), {
    unit: "in",
    why: "size",
    contradiction: "imperial",
  });
  assert.equal(proposedUnit({ ...shop(200), measurement: "imperial" }).unit, "ft");
});

test("a unit that $MEASUREMENT contradicts is named, and the size of a shop decides", () => {
  const shop = (size) => drawn(line(0, 0, size, 0), line(size, 0, size, size / 2), line(size, size / 2, 0, 0));
  const proposal = (unit, measurement, size) => Object.values(proposedUnit({ ...shop(size), unit, measurement }));
  assert.deepEqual(Object.values(proposedUnit(stored("inches_in_name_only.dxf"))), ["cm", "size", "metric"]);
  // Texts in feet and inches tell more than $MEASUREMENT.
  const texts = ["12'-6\"", "7'", "3' 4\""].map((text) => ({ text }));
  const inches = proposedUnit({ ...shop(2_000), unit: "in", measurement: "metric", texts });
  assert.deepEqual(Object.values(inches), ["in", "texts", "metric"]);
  for (const [unit, measurement, size, ...expected] of [
    ["in", "metric", 20_000, "mm", "size", "metric"],
    ["ft", "metric", 30, "m", "size", "metric"],
    ["mm", "imperial", 20_000, "mm", "header", "imperial"],
    ["mm", "imperial", 6_000, "mm", "header", "imperial"],
    ["mm", "imperial", 3_000, "in", "size", "imperial"],
    // Negative controls.
    ["in", "imperial", 2_000, "in", "header", null],
    ["in", null, 2_000, "in", "header", null],
    ["mm", "metric", 20_000, "mm", "header", null],
    ["dm", "metric", 200, "dm", "header", null],
    [null, "metric", 2_000, "cm", "size", null],
    ["au", "imperial", 2_000, "in", "size", null],
  ])
    assert.deepEqual(proposal(unit, measurement, size), expected, `${unit} ${measurement} ${size}`);
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
    entity("MLINE", ..."71 1 11 0 21 0 13 0 23 1 74 2 41 1 41 0 74 1 41 -1 11 5 21 0 13 0 23 1 74 1 41 1".split(" ")),
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
  fc.assert(fc.property(random, readsOrRefuses), { numRuns: times(100, 500) });
  const lines = sample.split("\n");
  const value = fc.oneof(
    fc.constantFrom("", ..."0 -1 1e308 -1e308 1e-308 1e20 32767 A B EOF ENDSEC ENDBLK INSERT".split(" ")),
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
  fc.assert(fc.property(edited, readsOrRefuses), { numRuns: times(200, 5000) });
  const spoilt = fc
    .array(fc.tuple(fc.nat(sample.length - 1), fc.nat(255)), { minLength: 1, maxLength: 10 })
    .map((changes) => {
      const bytes = bytesOf(sample);
      for (const [at, byte] of changes) bytes[at] = byte;
      return bytes;
    });
  fc.assert(fc.property(spoilt, readsOrRefuses), { numRuns: times(200, 5000) });
  rejects(() => fc.assert(fc.property(random, (bytes) => readsOrRefuses(bytes.buffer.x.y))));
});

test("damaged versions of a foreign drawing are read or refused", () => {
  const house = gunzipSync(dataFile("field4/house.dxf.gz"));
  assert.equal(readDxf(house).layers.length, 17);
  for (let key = 0; key < times(5, 500); ++key) readsOrRefuses(mutantOf(house, key));
});
