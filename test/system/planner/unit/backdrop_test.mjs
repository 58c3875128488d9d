import assert from "node:assert/strict";
import { test } from "node:test";

import fc from "fast-check";

import { drawingOf } from "../../../../src/page/planner/backdrop/drawing";
import { isTraced } from "../../../../src/page/planner/backdrop/edits";
import { contentOf, kindOf, nameFor, NotAccepted, uploadPicture } from "../../../../src/page/planner/backdrop/files";
import { Picture } from "../../../../src/page/planner/backdrop/picture";
import {
  angleBetween,
  boundsOfPicture,
  comparisonOf,
  cropBetween,
  isAskew,
  matrixOf,
  placementOf,
  replacedBy,
  shifted,
  straighteningOf,
  toPixel,
  toWorld,
  turnedTo,
  withScale,
} from "../../../../src/page/planner/backdrop/transform";
import { unitNamed } from "../../../../src/page/planner/geometry/units";
import { Viewport } from "../../../../src/page/planner/view/viewport";
import { double, near, points } from "./support.mjs";

const changes = { note: () => {} };
const metre = unitNamed("m");
const foot = unitNamed("ft");

const pixels = fc.tuple(double(0, 2480), double(0, 1754));
const lines = fc
  .record({ from: pixels, to: pixels, length: double(0.5, 100) })
  .filter(({ from, to }) => Math.hypot(to[0] - from[0], to[1] - from[1]) > 20);
const drawings = fc.record(
  {
    file: fc.constant("plan.png"),
    size: fc.constant([2480, 1754]),
    at: fc.tuple(double(-50, 50), double(-50, 50)),
    scale: lines,
    check: lines,
    rotation_deg: double(-180, 180),
    crop: fc.constant([100, 200, 2000, 1500]),
  },
  { requiredKeys: ["file", "size", "at"] },
);
const units = fc.constantFrom(...["m", "cm", "mm", "ft", "in"].map(unitNamed));

const plan = (more = {}) => ({ file: "plan.png", size: [2000, 1000], at: [0, 0], ...more });
const lineOf = (x, y, u, v, length) => ({ from: [x, y], to: [u, v], length });
const worldOf = (drawing, pixel, unit = metre) => toWorld(placementOf(drawing, unit), pixel);

/** What rounding to a tenth of a millimetre moves, m. */
const rounding = 2e-4;

test("pixels and places are mapped both ways, and to the screen", () => {
  fc.assert(
    fc.property(drawings, pixels, units, (drawing, pixel, unit) => {
      const placement = placementOf(drawing, unit);
      const world = toWorld(placement, pixel);
      near(toPixel(placement, world), pixel, 1e-5);
      near(toWorld(placement, [0, 1754]), [drawing.at[0] * unit.factor, drawing.at[1] * unit.factor]);
      const viewport = new Viewport(changes);
      viewport.resize(700, 500);
      const [a, b, c, d, e, f] = matrixOf(placement, viewport);
      const [x, y] = pixel;
      near([a * x + c * y + e, b * x + d * y + f], viewport.toScreen(world), 1e-5);
    }),
  );
});

test("without a scale, the picture is 20 m wide", () => {
  near(worldOf(plan(), [2000, 0]), [20, 10]);
  near(worldOf(plan({ at: [10, 0] }), [2000, 0], foot), [23.048, 10]);
  near(worldOf(plan({ rotation_deg: 90 }), [2000, 1000]), [0, 20]);
});

test("the scale line has its length, and what must stay stays", () => {
  fc.assert(
    fc.property(drawings, lines, units, fc.boolean(), (drawing, line, unit, isStraight) => {
      for (const keeps of ["line", "corner"]) {
        const scaled = withScale(drawing, unit, { line, isStraight, keeps });
        const [from, to] = [line.from, line.to].map((pixel) => worldOf(scaled, pixel, unit));
        const way = [to[0] - from[0], to[1] - from[1]];
        near([Math.hypot(...way)], [line.length * unit.factor], 1e-6 * line.length);
        if (keeps === "line") near(from, worldOf(drawing, line.from, unit), rounding);
        else near(scaled.at, drawing.at, 0);
        if (isStraight) assert.ok(Math.min(...way.map(Math.abs)) <= 2e-6 * line.length);
      }
    }),
  );
});

test("a line becomes horizontal or vertical, whichever is nearer", () => {
  assert.equal(straighteningOf(plan(), lineOf(0, 0, 100, 0)), 0);
  assert.ok(Math.abs(straighteningOf(plan(), lineOf(0, 100, 100, 99)) + 0.5729) < 1e-4);
  assert.ok(Math.abs(straighteningOf(plan(), lineOf(50, 0, 51, 100)) - 0.5729) > 1, "not to the horizontal");
  assert.equal(straighteningOf(plan({ rotation_deg: 3 }), lineOf(100, 0, 0, 0)), -3);
  const line = (degrees) => lineOf(0, 0, Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180));
  assert.deepEqual(
    [0, 0.004, 1, -4.9, 5.1, 45, 86, 90, 179].map((degrees) => isAskew(plan(), line(degrees))),
    [false, false, true, true, false, false, true, false, true],
  );
});

test("a turn keeps the middle of what is shown, a shift everything else", () => {
  fc.assert(
    fc.property(drawings, units, double(-720, 720), double(-9, 9), (drawing, unit, degrees, way) => {
      const turned = turnedTo(drawing, unit, degrees);
      const [left, upper, right, lower] = drawing.crop ?? [0, 0, 2480, 1754];
      const middle = [0.5 * (left + right), 0.5 * (upper + lower)];
      near(worldOf(turned, middle, unit), worldOf(drawing, middle, unit), rounding);
      assert.ok(Math.abs(turned.rotation_deg ?? 0) <= 180);
      const moved = shifted(drawing, unit, [way, -way]);
      const [x, y] = worldOf(drawing, middle, unit);
      near(worldOf(moved, middle, unit), [x + way, y - way], rounding);
    }),
  );
});

test("the same picture in other pixels takes the place of the old one", () => {
  fc.assert(
    fc.property(drawings, fc.integer({ min: 500, max: 9000 }), (drawing, width) => {
      const size = [width, Math.round((width * 1754) / 2480)];
      const replaced = replacedBy(drawing, { file: "new.png", size }, metre);
      const [before, after] = [drawing, replaced].map((one) => ({ ...one, crop: undefined }));
      // Heights are whole pixels, and so are crops.
      const slack = (placementOf(replaced, metre).step * 2480) / 500 + 0.02;
      const [old, now] = [before, after].map((one) => boundsOfPicture(one, metre));
      near([...now.lower, ...now.upper], [...old.lower, ...old.upper], slack);
      assert.equal(replaced.check, width === 2480 ? drawing.check : undefined);
    }),
  );
  const taller = replacedBy(
    plan({ scale: lineOf(0, 1000, 500, 1000, 5), crop: [0, 500, 1000, 1000] }),
    { file: "tall.png", size: [1000, 800] },
    metre,
  );
  assert.deepEqual(taller.scale, lineOf(0, 800, 500, 800, 5), "m per pixel and the lower left corner stay");
  assert.deepEqual(taller.crop, [0, 300, 1000, 800]);
});

test("m per pixel or point stay, and what nobody has checked counts as unchecked", () => {
  const checked = { scale: lineOf(100, 600, 900, 600, 16), check: lineOf(100, 600, 100, 100, 10) };
  const before = (file, size, more = {}) => ({ file, size, at: [3, 4], ...checked, ...more });
  const replace = (drawing, file, size, more = {}) => {
    assert.equal(comparisonOf(drawing).agrees, true);
    const after = replacedBy(drawing, { file, size, ...more }, metre);
    return [Number(placementOf(after, metre).step.toFixed(7)), comparisonOf(after)?.agrees ?? false];
  };
  const picture = before("plan.png", [1000, 700]);
  const page = before("plan.pdf", [1000, 700]);
  const rows = [
    [picture, "new.png", [1000, 700], 0.02, true],
    [picture, "new.jpg", [1300, 700], 0.02, false], // a title block
    [picture, "new.png", [1000, 990], 0.02, false],
    [picture, "new.png", [2000, 1400], 0.01, false], // another resolution
    [picture, "new.png", [1999, 1400], 0.02 / 1.999, false],
    [picture, "new.pdf", [500, 350], 0.04, false], // pixels are no points
    [picture, "new.pdf", [1000, 700], 0.02, false],
    [page, "new.pdf", [1000, 700], 0.02, true],
    [page, "new.pdf", [1400, 900], 0.02, false], // a larger sheet
    [page, "new.pdf", [1414, 989.8], 0.02, false], // A2 instead of A3
    [page, "new.png", [4000, 2800], 0.005, false],
    [before("a.dxf", [1000, 700], { origin: [0, 0] }), "new.pdf", [500, 350], 0.04, false],
  ];
  for (const [drawing, file, size, step, agrees] of rows)
    assert.deepEqual(
      replace(drawing, file, size),
      [Number(step.toFixed(7)), agrees],
      `${drawing.file} ${file} ${size}`,
    );
  assert.deepEqual(replace(page, "plan.pdf", [1000, 700], { page: 2 }), [0.02, false], "another page");
  assert.deepEqual(replace({ ...page, page: 2 }, "plan.pdf", [1000, 700]), [0.02, false], "the first page");
  assert.deepEqual(replace({ ...page, page: 2 }, "b.pdf", [1000, 700], { page: 2 }), [0.02, true]);
  const unit = { unit: "mm", origin: [0, 0] };
  assert.deepEqual(replace(before("a.dxf", [1000, 700], unit), "b.dxf", [1400, 700], unit), [0.02, false], "by hand");
  const undone = replacedBy(replacedBy(picture, { file: "b.png", size: [1300, 700] }, metre), picture, metre);
  assert.deepEqual(placementOf(undone, metre), placementOf(picture, metre), "back to the old file");
});

test("a drawing with a unit has its size, and a new version keeps its coordinates", () => {
  const sheet = { file: "a.dxf", size: [1000, 500], at: [2, 3], unit: "in", origin: [100, 200] };
  near(toWorld(placementOf(sheet, foot), [1000, 500]), [2 * 0.3048 + 25.4, 3 * 0.3048]);
  const next = { file: "b.dxf", size: [1200, 800], unit: "in", origin: [90, 150] };
  const replaced = replacedBy({ ...sheet, rotation_deg: 90 }, next, metre);
  // The place of a point of the file, in coordinates of the file.
  const placeOf = (of, [x, y]) => toWorld(placementOf(of, metre), [x - of.origin[0], of.size[1] - (y - of.origin[1])]);
  near(placeOf(replaced, [321, 432]), placeOf({ ...sheet, rotation_deg: 90 }, [321, 432]), 1e-4);
  assert.equal(replaced.scale, undefined);
  const picture = replacedBy(sheet, { file: "c.png", size: [2000, 1000] }, metre);
  assert.deepEqual([picture.unit, picture.origin], [undefined, undefined]);
  near(toWorld(placementOf(picture, metre), [2000, 1000]), [2 + 25.4, 3]);
  const page = { file: "a.pdf", page: 3, size: [600, 400], at: [1, 1] };
  const scan = { ...page, scale: lineOf(0, 0, 600, 0, 6), rotation_deg: 0.37 };
  const exact = replacedBy(scan, next, metre);
  assert.deepEqual([exact.page, exact.rotation_deg, exact.scale, exact.at], [undefined, undefined, undefined, [1, 1]]);
  const feet = replacedBy(sheet, { ...next, unit: "ft" }, metre);
  assert.deepEqual([feet.unit, feet.at], ["ft", [2, 3]]);
});

test("a second length checks the scale", () => {
  const scale = lineOf(0, 0, 1000, 0, 10);
  const checked = (check) => comparisonOf(plan({ scale, check }));
  assert.equal(checked(undefined), null);
  assert.equal(checked(lineOf(0, 0, 1000, 300, 10)), null, "in the same direction");
  assert.equal(checked(lineOf(0, 0, 0, 500, 5)).agrees, true);
  const stretched = checked(lineOf(0, 500, 0, 0, 4.9));
  assert.ok(!stretched.agrees && Math.abs(stretched.difference - 0.020408) < 1e-5 && stretched.byScale === 5);
  assert.equal(checked(lineOf(0, 0, 0, 500, 5.04)).agrees, true);
  fc.assert(
    fc.property(lines, lines, (a, b) => {
      const angle = angleBetween(a, b);
      assert.ok(angle >= 0 && angle <= 90);
      assert.ok(Math.abs(angle - angleBetween({ from: b.to, to: b.from }, a)) < 1e-9);
    }),
  );
});

test("crops are whole pixels inside the picture", () => {
  assert.deepEqual(cropBetween(plan(), [1500.4, 900], [-20, 100.6]), [0, 101, 1500, 900]);
  assert.equal(cropBetween(plan(), [0, 0], [2000, 1000]), undefined);
  assert.equal(cropBetween(plan(), [-9, 0], [-3, 500]), undefined);
});

test("values that the store reader refuses count as missing", () => {
  assert.equal(drawingOf({}), null);
  assert.equal(drawingOf({ drawing: { file: "a.png", size: [0, 10] } }), null);
  const wrong = { at: "here", scale: lineOf(1, 1, 1, 1, 5), check: lineOf(1, 1, 2, 1, -5), crop: [5, 0, 2, 9] };
  const { at, scale, check, crop } = drawingOf({ drawing: { file: "a.png", size: [10, 10], ...wrong } });
  assert.deepEqual([at, scale, check, crop], [[0, 0], undefined, undefined, undefined]);
});

test("a rectangle with candidates is not yet a drawn shop", () => {
  const room = { size: [20, 15, 3] };
  const transceivers = { areas: [{}] };
  assert.ok(!isTraced({ room, transceivers }));
  assert.ok(isTraced({ room: { outline: [] }, transceivers }));
  assert.ok(isTraced({ room, fixtures: [{}] }));
});

const bytesOf = (words) => Uint8Array.from(words, (letter) => letter.charCodeAt(0));
const png = bytesOf("\x89PNG\r\n\x1a\n....");

test("files are recognised by their first bytes", () => {
  const kinds = {
    png: ["\x89PNG\r\n\x1a\n"],
    jpg: ["\xff\xd8\xff\xe0"],
    webp: ["RIFF\x10\0\0\0WEBPVP8 "],
    pdf: ["%PDF-1.7", "\xef\xbb\xbf%PDF-1.7", "Type: a/pdf\r\n\r\n%PDF-1.7", `${"<br />".repeat(170)}%PDF-`],
    dxf: [
      "\xef\xbb\xbf0\nSECTION",
      "0\rSECTION",
      "  0\r\nSECTION\r\n",
      "999\nby hand\n",
      "AutoCAD Binary DXF\r\n",
      "AC1032",
    ],
    other: ["", "GIF89a", "RIFF\x10\0\0\0WAVE", "<svg>", "0123", `${" ".repeat(1025)}%PDF-`],
  };
  for (const [kind, samples] of Object.entries(kinds))
    for (const sample of samples) assert.equal(kindOf(bytesOf(sample)), kind, sample);
});

test("formats of other programs are named, with what to export", async () => {
  const model = "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n";
  const schema = (name) => `${model}FILE_SCHEMA(('${name}'));\nENDSEC;\n`;
  const spreadsheet = "PK\x03\x04\x14\0\0\0\x08\0[Content_Types].xml";
  const refused = [
    ["plan.ifc", model, /^plan\.ifc is a model \(IFC\).* Export the floor plan from it as DXF or PDF/],
    ["plan.step", model, /a model \(STEP\).*DXF/],
    ["plan.stp", schema("AUTOMOTIVE_DESIGN"), /a model \(STP\)/],
    ["plan.csv", schema("IFC4"), /a model \(IFC\)/],
    ["plan", schema("CONFIG_CONTROL"), /a model \(STEP\)/],
    ["export", `\xef\xbb\xbf${model}`, /a model \(STEP\)/],
    ["plan.dxf", model, /a model \(STEP\)/],
    ["shop.RVT", "\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", /a model \(RVT\)/],
    ["shop.skp", "\xff\xfe\xff\x0eS\0k\0e\0t\0c\0h\0U\0p\0 \0M\0o\0d\0e\0l\0", /a model \(SKP\)/],
    ["shop", "\xff\xfe\xff\x0eS\0k\0e\0t\0c\0h\0U\0p\0;\0\n\0;\0", /a model \(SketchUp\)/],
    ["plan.ifczip", "PK\x03\x04", /a model \(IFCZIP\)/],
    ["plan.dgn", "\x08\x09\xfe\x02", /a model \(DGN\)/],
    ["book.xlsx", spreadsheet, /is a spreadsheet\. Save it as CSV/],
    ["book.ods", "PK\x03\x04", /is a spreadsheet/],
    ["renamed.csv", spreadsheet, /is a spreadsheet/],
    ["model.bcfzip", "PK\x03\x04", /is an archive \(BCFZIP\)\. Unpack it/],
    ["project.zip", "PK\x03\x04", /is an archive \(ZIP\)/],
    ["plan.docx", spreadsheet, /is a document \(DOCX\).*as PDF/],
    ["plan.gif", "GIF89a", /is a picture of another format \(GIF\)\. Save it as PNG/],
    ["photo.heic", "\0\0\0\x18ftypheic", /\(HEIC\)/],
    ["photo", "\0\0\0\x18ftypheic", /\(HEIC\)/],
    ["shelf.gltf", '{"asset": {}}', /is a mesh of another format \(GLTF\)\. Export it as GLB/],
    ["plan.pdf", "<html>404</html>", /^plan\.pdf is not a PDF file in spite of its name/],
    ["notes", "hello", /is of no format that the planner reads/],
  ];
  for (const [name, content, words] of refused) {
    const file = Object.assign(new Blob([bytesOf(content)]), { name });
    await assert.rejects(contentOf(file), (error) => error instanceof NotAccepted && words.test(error.message), name);
  }
  const taken = {
    "plan.ifc": ["%PDF-1.7", "pdf"], // the content says more than the name
    "labels.csv": ["AC1032,10\nAC1033,20\n", "csv"],
    "ifc.csv": ["ifc,step\n1,2\n", "csv"],
    "table.csv": ["a,b\n%PDF-,1\n", "csv"],
    export: ["a;b\n1;2\n", "csv"],
    "plan.dwg": ["AC1032\0\0", "dxf"],
    "plan.dxf": ["nonsense", "dxf"],
    "mesh.obj": ["v 0 0 0\n", "obj"],
  };
  for (const [name, [content, kind]] of Object.entries(taken)) assert.equal(kindOf(bytesOf(content), name), kind, name);
});

test("names are safe, and end as the content says", () => {
  assert.equal(nameFor("Grundriß Müller & Söhne.PNG", "png"), "Grundri-Muller-Sohne.png");
  assert.equal(nameFor("..\\..\\.hidden.jpeg", "jpg"), "hidden.jpg");
  assert.equal(nameFor("平面図.webp", "webp"), "plan.webp");
  fc.assert(fc.property(fc.string(), (name) => assert.match(nameFor(name, "png"), /^[A-Za-z0-9_][\w.-]*\.png$/)));
});

/** Runs with a program that answers requests, and a browser that decodes pictures of a size, and rounds upwards. */
async function withFakes({ answer, size }, run) {
  const before = { fetch: globalThis.fetch, createImageBitmap: globalThis.createImageBitmap };
  const asked = [];
  globalThis.fetch = async (url, options = {}) => {
    asked.push([options.method ?? "GET", url]);
    return answer();
  };
  globalThis.createImageBitmap = async (_, { resizeWidth } = {}) => {
    if (!size) throw new Error("no picture");
    const factor = resizeWidth === undefined ? 1 : resizeWidth / size[0];
    return { width: Math.ceil(size[0] * factor), height: Math.ceil(size[1] * factor), close: () => {} };
  };
  try {
    await run(asked);
  } finally {
    Object.assign(globalThis, before);
  }
}

test("a picture is sent, and wrong files are refused with a reason", async () => {
  const stored = () => Response.json({ file: "plan-2.png", width: 400, height: 300 }, { status: 201 });
  const file = (content, name = "my plan.png") => Object.assign(new Blob([content]), { name });
  const upload = async (address, given) => uploadPicture(address, await contentOf(given));
  await withFakes({ answer: stored, size: [400, 300] }, async (asked) => {
    assert.deepEqual(await upload("http://here/", file(png)), { file: "plan-2.png", size: [400, 300] });
    assert.deepEqual(asked, [["PUT", "http://here/files/my-plan.png"]]);
    const refused = (wrong, words) =>
      assert.rejects(
        upload("http://here/", wrong),
        (error) => error instanceof NotAccepted && words.test(error.message),
      );
    await refused(file(""), /^my plan.png is empty/);
    await refused(file("hello"), /^my plan.png is of no format/);
    assert.equal(asked.length, 1, "wrong files are not sent");
  });
  await withFakes({ answer: stored, size: [300, 400] }, async () => {
    const { size } = await upload("http://here/", file(png));
    assert.deepEqual(size, [300, 400], "turned as the camera has noted");
  });
  for (const sizes of [
    "1000,998 1000,998",
    "998,1000 998,1000",
    "998,1000 1000,998", // noted by the camera
    "9999,10000 10000,9999",
    "500,500 500,500",
    "1000,980 1000,980",
    "1000,981 981,1000",
    "3000,10 10,3000",
  ]) {
    const [[width, height], shown] = points(sizes);
    const answer = () => Response.json({ file: "plan.png", width, height }, { status: 201 });
    await withFakes({ answer, size: shown }, async () =>
      assert.deepEqual((await upload("http://here/", file(png))).size, shown, sizes),
    );
  }
  const sentence = "plan.png has more than 100 megapixels.";
  await withFakes({ answer: () => new Response(`${sentence}\n`, { status: 413 }), size: [400, 300] }, () =>
    assert.rejects(upload("http://here/", file(png)), { message: sentence }),
  );
  await withFakes({ answer: stored }, () => assert.rejects(upload("http://here/", file(png)), /is damaged/));
});

test("the picture is fetched once, kept in several sizes, and says why it is missing", async () => {
  const settled = (picture) =>
    new Promise((done) => {
      const look = () => (picture.state.kind === "loading" ? setTimeout(look) : done(picture.state));
      look();
    });
  const drawing = { file: "plans/a b.png", size: [8000, 5000], at: [0, 0] };
  await withFakes({ answer: () => new Response("bytes"), size: [20000, 10000] }, async (asked) => {
    const picture = new Picture("http://here/", changes);
    assert.ok(picture.follow({ ...drawing, size: [20000, 10000] }));
    const { levels } = await settled(picture);
    assert.deepEqual(asked, [["GET", "http://here/files/plans/a%20b.png"]]);
    assert.ok(levels[0].width * levels[0].height <= 40e6);
    assert.ok(levels.at(-1).width * levels.at(-1).height <= 1e6);
    assert.equal(picture.level(1e6), levels[0]);
    assert.equal(picture.level(10), levels.at(-1));
    assert.ok(picture.level(3000).width >= 3000 && picture.level(3000).width < 6000);
    assert.ok(!picture.follow({ ...drawing, size: [20000, 10000] }));
    assert.ok(picture.follow(null));
    assert.equal(picture.state.kind, "none");
  });
  const failed = async (fakes, words) =>
    withFakes(fakes, async (asked) => {
      const picture = new Picture("http://here/", changes);
      picture.follow(drawing);
      assert.match((await settled(picture)).why, words);
      picture.follow(drawing);
      await settled(picture);
      return asked.length;
    });
  await failed({ answer: () => new Response("bytes"), size: [8000, 6000] }, /has changed: its size is now 8000 × 6000/);
  await withFakes({ answer: () => new Response("bytes"), size: [800, 600] }, async () => {
    const picture = new Picture("http://here/", changes);
    picture.follow({ ...drawing, size: [1100, 600] });
    assert.match((await settled(picture)).why, /its size is now 800 × 600 instead of 1100 × 600/);
    assert.ok(picture.follow({ ...drawing, size: [800, 600] }), "the same file with its new size");
    assert.equal((await settled(picture)).kind, "shown");
  });
  await failed({ answer: () => new Response("", { status: 404 }), size: [1, 1] }, /is missing from the folder/);
  await failed({ answer: () => new Response("bytes") }, /is damaged/);
  await failed({ answer: () => Promise.reject(new TypeError()), size: [1, 1] }, /no connection/);
});
