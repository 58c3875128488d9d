import assert from "node:assert/strict";
import { test } from "node:test";

import { mutantOf } from "../../../data/dxf_mutants.mjs";
import { articles, names, planogramFile, types } from "../../../data/planogram_file.mjs";
import { checkPlanogram } from "../../../../src/page/planner/planogram/check";
import { faceNamed } from "../../../../src/page/planner/planogram/face_words";
import { guessedMapping, inForm, isColumnName } from "../../../../src/page/planner/planogram/guess";
import { checkList, listKindOf } from "../../../../src/page/planner/planogram/list";
import { faceOfFixture, hasMergedCells, missingRoles } from "../../../../src/page/planner/planogram/mapping";
import { recalled, remember } from "../../../../src/page/planner/planogram/memory";
import { fileOf, ownLabels, sectionOf } from "../../../../src/page/planner/planogram/output";
import { holderOf } from "../../../../src/page/planner/planogram/shop";
import { NotATable } from "../../../../src/page/planner/table/fault";
import { ordinalIn } from "../../../../src/page/planner/table/numbers";
import { readTable } from "../../../../src/page/planner/table/table";
import { bytesOf, dataFile, leastOfThree, times } from "./support.mjs";

const read = (text) => readTable(bytesOf(text));
const holder = (id, more = {}) => ({
  ...{ id, path: `/fixtures/${id}`, labels: null, faces: ["front", "back"], boards: 4, length: 12, depth: 0.9 },
  ...more,
});
const rows = ["A1", "A2", "A3", "A4"];
const all = [
  ...rows.map((id) => holder(id, { labels: "preset" })),
  ...rows.flatMap((id) =>
    ["west", "east"].map((end) => holder(`${id}-${end}`, { boards: 2, faces: ["front"], length: 0.9 })),
  ),
  ...["W1", "W2"].map((id) => holder(id, { faces: ["front"], length: 20 })),
  ...["F1", "F2"].map((id) => holder(id, { boards: 1, faces: ["front", "back", "left", "right"], labels: "own" })),
  ...["P1", "P2"].map((id) => holder(id, { boards: 2, length: 5 })),
];
const shop = {
  holders: new Map(all.map((one) => [one.id, one])),
  types: ["standard", "freezer", "large"],
  unit: { name: "m", factor: 1 },
};
const setting = { unit: "m", longest: 20, type: "standard" };
const mapped = (table, changed = {}) => ({ ...guessedMapping(table, setting), ...changed });
const checked = (text, changed) => {
  const table = read(text);
  return checkPlanogram(table, mapped(table, changed), shop);
};
const reasons = ({ bad }) => bad.map(({ row, reason }) => `${row.line} ${reason.code}`);

test("columns are guessed by their names in six languages", () => {
  const headers = {
    "EAN;Bezeichnung;Regal;Seite;Fachboden;Position;Etikett": "article description fixture face level place type",
    "Artikel-Nr.;Artikeltext;Möbel;Ebene;Platz;Neigung (Grad)": "article description fixture level place tilt",
    "Code EAN;Libellé;Meuble;Face;Niveau;Emplacement;Étiquette": "article description fixture face level place type",
    "Código artículo;Descripción;Mueble;Lado;Nivel;Posición": "article description fixture face level place",
    "Codice articolo;Descrizione;Scaffale;Lato;Ripiano;Posizione": "article description fixture face level place",
    "Artikelcode;Omschrijving;Stelling;Zijde;Plank;Positie": "article description fixture face level place",
    "Item Number;Product Name;Fixture ID;Side;Shelf Level;X (cm)": "article description fixture face level place",
    "article;fixture;face;level;position;hook;tilt_deg": "article fixture face level place hook tilt",
  };
  for (const [header, expected] of Object.entries(headers)) {
    const { columns, form } = mapped(read(`${header}\n${header.replace(/[^;]+/g, "1")}\n`));
    const found = Object.entries(columns).sort((a, b) => a[1] - b[1]);
    assert.equal(form, "fixtures", header);
    assert.equal(found.map(([role]) => role).join(" "), expected, header);
  }
});

test("files of planogram programs are recognised by segment and shelf", () => {
  const { form, columns } = mapped(read("UPC,Name,Planogram,Segment,Shelf,Sequence,Width,HFacings\n1,2,3,4,5,6,7,8\n"));
  assert.equal(form, "segments");
  const names = "article description planogram segment level place width facings";
  assert.deepEqual(columns, Object.fromEntries(names.split(" ").map((name, k) => [name, k])));
});

test("an article number shows its column, and what is missing is asked for", () => {
  const table = read("id;wo\n4006381333931;A1\n4006381333948;A1\n");
  const mapping = mapped(table);
  assert.equal(mapping.columns.article, 0);
  assert.deepEqual(missingRoles(mapping), ["fixture", "level"]);
  assert.deepEqual(missingRoles(inForm(table, mapping, "segments")), ["segment", "level", "place"]);
});

test("distances have the unit of their column, or one in which they fit", () => {
  const measure = (name, ...values) =>
    mapped(read([`EAN;Regal;Boden;${name}`, ...values.map((x) => `1;A1;1;${x}`)].join("\n"))).measure;
  assert.equal(measure("Platz", 1, 2, 30), "position");
  assert.equal(measure("Platz", "0,5", "1,5"), "m");
  assert.equal(measure("x", 12, 1100), "cm");
  assert.equal(measure("x", 12, 11000), "mm");
  assert.equal(measure("Abstand [mm]", 1, 2), "mm");
});

test("words for faces", () => {
  const words = {
    front: "vorne Front A 1 avant",
    back: "Rückseite hinten B 2 arrière retro",
    left: "links gauche",
    top: "oben dessus",
  };
  for (const [face, list] of Object.entries(words))
    for (const word of list.split(" ")) assert.equal(faceNamed(word), face, word);
  assert.equal(faceNamed("unten"), undefined);
});

test("the planogram of 1,200 articles: bad lines by number, the others complete", () => {
  const { file, bad } = planogramFile();
  const table = readTable(new Uint8Array(file));
  const mapping = mapped(table, { words: { fixture: names, face: {}, type: types } });
  const found = checkPlanogram(table, mapping, shop);
  assert.deepEqual(
    found.bad.map(({ row }) => row.line),
    bad.map(({ line }) => line),
  );
  assert.equal(found.good.length, articles - bad.length);
  const known = checkPlanogram(table, mapped(table), shop).words;
  const unknown = [...known.fixture.values(), ...known.type.values()].filter(({ meaning }) => meaning === undefined);
  assert.deepEqual(
    unknown.map(({ word }) => word).sort(),
    ["Lager", ...Object.keys(names), ...Object.keys(types)].sort(),
  );
});

test("lines are checked in a time proportional to their number", () => {
  const secondsFor = (count) => {
    const lines = Array.from({ length: count }, (_, k) => `${k};A${1 + (k % 4)};vorne;${1 + (k % 4)};${1 + (k % 900)}`);
    const before = process.cpuUsage();
    const { good } = checked(["Artikel;Regal;Seite;Boden;Platz", ...lines].join("\n"));
    const { user, system } = process.cpuUsage(before);
    assert.equal(good.length, count);
    return (user + system) / 1e6;
  };
  const ratio = leastOfThree(secondsFor, 40e3) / leastOfThree(secondsFor, 10e3); // 16, if the time grew with the square
  assert.ok(ratio < 10, `${ratio}`);
});

test("every mistake of a line has its reason", () => {
  const mistakes = {
    ";A1;vorne;1;1;;;": "no_article",
    "a\u200bb;A1;vorne;1;1;;;": "article",
    "4,006E+12;A1;vorne;1;1;;;": "changed",
    "2;;vorne;1;1;;;": "no_fixture",
    "2;Z9;vorne;1;1;;;": "fixture",
    "2;A1;;1;1;;;": "no_face",
    "2;A1;unten;1;1;;;": "face",
    "2;A1;links;1;1;;;": "not_face",
    "2;A1;vorne;;1;;;": "no_level",
    "2;A1;vorne;x;1;;;": "number",
    "2;A1;vorne;5;1;;;": "level",
    "2;A1;vorne;1;;;;": "no_place",
    "2;A1;vorne;1;x;;;": "number",
    "2;A1;vorne;1;1001;;;": "position",
    "2;A1;vorne;1;1;paper;;": "type",
    "2;A1;vorne;1;1;;x;": "hook",
    "2;A1;vorne;1;1;;;90": "tilt",
    "1/2;A1;vorne;1;3;;;": "same_id",
  };
  const lines = ["1;A1;vorne;1;1;;;", ...Object.keys(mistakes), "1;A1;vorne;1;2;;;"];
  const found = checked(["Artikel;Regal;Seite;Boden;Platz;Etikett;Haken;Neigung", ...lines].join("\n"));
  assert.deepEqual(
    reasons(found),
    Object.values(mistakes).map((code, k) => `${k + 3} ${code}`),
  );
  assert.deepEqual(
    found.good.map(({ line }) => line),
    [2, 21],
  );
});

test("distances are within the face, in any unit", () => {
  const table = read("EAN;Regal;Seite;Boden;x (ft)\n1;A1;vorne;1;39,370079\n2;A1;vorne;1;39,38\n3;A1;vorne;1;-1\n");
  const feet = { ...shop, unit: { name: "ft", factor: 0.3048 } };
  const found = checkPlanogram(table, mapped(table), feet);
  assert.deepEqual(reasons(found), ["3 distance", "4 distance"]);
  const [, line] = fileOf(found.good, mapped(table), feet).split("\n");
  assert.ok(Number(line.split(",")[4]) * 0.3048 <= 12, line);
});

test("boards count from below or above, from any number", () => {
  const text = "EAN;Regal;Seite;Boden;Platz\n1;A1;vorne;0;1\n2;A1;vorne;3;2\n3;A1;vorne;4;3\n";
  const level = (changed) => {
    const { good, bad } = checked(text, changed);
    return [good.map((place) => place.level), bad.length];
  };
  assert.equal(mapped(read(text)).first, 0);
  assert.deepEqual(level({}), [[1, 4], 1]);
  assert.deepEqual(level({ fromTop: true }), [[4, 1], 1]);
  assert.deepEqual(level({ first: 1 }), [[3, 4], 1]);
});

test("places from the left of a person are mirrored on the back", () => {
  const file = (header, changed) => {
    const table = read(`${header}\n1;A1;back;1;1\n2;A1;back;1;3\n3;A1;front;1;1\n`);
    const mapping = mapped(table, changed);
    const lines = fileOf(checkPlanogram(table, mapping, shop).good, mapping, shop)
      .trim()
      .split("\n");
    return [lines[0].split(",")[4], ...lines.slice(1).map((line) => Number(line.split(",")[4]))];
  };
  assert.deepEqual(file("EAN;Regal;Seite;Boden;Platz"), ["position", 3, 1, 1]);
  assert.deepEqual(file("EAN;Regal;Seite;Boden;Platz", { fromLeft: false }), ["position", 1, 3, 1]);
  assert.deepEqual(file("article;fixture;face;level;position"), ["position", 1, 3, 1]);
  assert.deepEqual(file("EAN;Regal;Seite;Boden;x (m)"), ["x", 11, 9, 1]);
});

test("without places, the order of the lines counts; without faces, a choice", () => {
  const words = { fixture: { "Gondel 2": faceOfFixture("A2", "back") }, face: {}, type: {} };
  const { good } = checked("EAN;Regal;Boden\n1;A1;1\n2;A1;1\n3;Gondel 2;1\n", { words });
  assert.deepEqual(
    good.map(({ holder: { id }, face, place }) => `${id} ${face} ${place}`),
    ["A1 front 1", "A1 front 2", "A2 back 1"],
  );
});

test("left out words, and those that the shop has no longer", () => {
  const words = { fixture: { Lager: null, Halle: "gone" }, face: {}, type: {} };
  const found = checked("EAN;Regal;Boden\n1;Lager;1\n2;Halle;1\n", { words });
  assert.deepEqual(reasons(found), ["2 left_out", "3 fixture"]);
});

test("the file of a planogram protects formulas and separators", () => {
  const table = read('EAN;Bezeichnung;Regal;Seite;Boden;Platz;Neigung\n=1;"Brot, ""hell""";A1;vorne;1;1;-5,5\n');
  const mapping = mapped(table);
  assert.equal(
    fileOf(checkPlanogram(table, mapping, shop).good, mapping, shop),
    `article,fixture,face,level,position,tilt_deg,description\n'=1,A1,front,1,1,-5.5,"Brot, ""hell"""\n`,
  );
});

const segments = `UPC,Planogram,Segment,Shelf,Sequence
1,Bakery,1,1,1
2,Bakery,2,4,1
2,Bakery,2,4,1
3,Drinks,1,1,1
4,,1,1,1
5,Bakery,1,5,1
`;

test("segments share the face of their fixture", () => {
  const table = read(segments);
  const back = faceOfFixture("A1", "back");
  const words = { fixture: { Bakery: back, Drinks: back }, face: {}, type: {} };
  const mapping = mapped(table, { words, fromTop: true });
  const found = checkPlanogram(table, mapping, shop);
  assert.deepEqual(reasons(found), ["4 duplicate", "6 fixture", "7 level"]);
  const before = { file: "old.csv", type: "large", hook: 0.2, segments: [] };
  assert.deepEqual(sectionOf("new.csv", found.good, mapping, shop, before), {
    file: "new.csv",
    type: "standard",
    hook: 0.2,
    segments: [
      { planogram: "Bakery", segments: [1, 2], fixture: "A1", face: "back", to: 8, from_top: true },
      { planogram: "Drinks", segments: [1], fixture: "A1", face: "back", from: 8, from_top: true },
    ],
  });
  assert.equal(
    fileOf(found.good, mapping, shop),
    "article,segment,shelf,sequence,planogram\n1,1,1,1,Bakery\n2,2,4,1,Bakery\n3,1,1,1,Drinks\n",
  );
});

test("each segment may stand on a fixture of its own", () => {
  const table = read("UPC,Segment,Shelf,Sequence\n1,1,1,1\n2,2,1,1\n");
  const mapping = mapped(table, { bySegment: true, words: { fixture: { 1: "A1", 2: "A2" }, face: {}, type: {} } });
  const { good } = checkPlanogram(table, mapping, shop);
  assert.deepEqual(sectionOf("new.csv", good, mapping, shop, undefined).segments, [
    { segments: [1], fixture: "A1", face: "front" },
    { segments: [2], fixture: "A2", face: "front" },
  ]);
});

test("labels of the fixtures make room for those of articles", () => {
  const place = (id) => ({ holder: shop.holders.get(id) });
  assert.deepEqual(
    [...ownLabels([place("A1"), place("A1"), place("F1"), place("W1")])],
    [
      ["/fixtures/A1", null],
      ["/fixtures/F1", undefined],
    ],
  );
});

test("fixtures have the sides that the program gives them", () => {
  const part = { id: "A", path: "/fixtures/0", footing: { length: 2, depth: 1 } };
  const of = (resolved, more = {}) => holderOf({ ...part, ...more }, { resolved, effective: {}, inherited: {} });
  assert.deepEqual(of({ type: "gondola", shelves: [1, 2], faces: ["back"] })?.faces, ["back"]);
  assert.equal(of({ type: "gondola", shelves: [] }), null);
  assert.deepEqual([of({ type: "freezer" })?.boards, of({ type: "box" })?.faces.includes("top")], [1, true]);
  for (const none of [
    of({ type: "mesh" }),
    of(null),
    of({ type: "freezer" }, { unfinished: true }),
    of({ type: "box" }, { footing: undefined }),
  ])
    assert.equal(none, null);
});

test("a browser remembers what files of the same columns mean", () => {
  const kept = new Map();
  globalThis.localStorage = { getItem: (key) => kept.get(key) ?? null, setItem: (key, value) => kept.set(key, value) };
  const table = read("EAN;Regal;Boden\n1;A1;1\n");
  const guessed = mapped(table);
  assert.equal(recalled("shop", table, guessed), null);
  const mapping = { ...guessed, fromTop: true, words: { fixture: { Lager: null }, face: {}, type: {} } };
  remember("shop", table, mapping);
  assert.deepEqual(recalled("shop", read("ean;REGAL;Boden\n2;B;1\n"), guessed), mapping);
  assert.equal(recalled("other", table, guessed), null);
  assert.equal(recalled("shop", read("EAN;Regal;Ebene\n2;B;1\n"), guessed), null);
  for (const spoiled of [
    "{",
    "5",
    '[["ean|regal|boden", 5]]',
    '[["ean|regal|boden", {"columns": {"article": 99}, "words": 3, "first": "x"}]]',
  ]) {
    kept.set("shelfbeam.tables.shop", spoiled);
    const found = recalled("shop", table, guessed);
    assert.ok(found === null || (found.first === 1 && found.columns.article === undefined), spoiled);
  }
  delete globalThis.localStorage;
});

test("lists of labels and candidates are recognised, and checked by line", () => {
  const mistakes = {
    "a,1,2,3,0,1,0,standard,": "same_id",
    "b,1,2,3,0,0,0,standard,": "direction",
    "c,x,2,3,0,1,0,standard,": "number",
    "d,1,2,3,0,1,0,paper,": "type",
    "e,1e5,2,3,0,1,0,standard,": "far",
    "f,99999,2,3,0,1,0,standard,": "far",
    ",1,2,3,0,1,0,standard,": "no_id",
  };
  const lines = ["ID,x,y,z,nx,ny,nz,type,name", "a,1,2,3,0,1,0,standard,Rye", ...Object.keys(mistakes)];
  const labels = read(lines.join("\n"));
  assert.equal(listKindOf(labels), "labels");
  const { file, count, bad } = checkList(labels, "labels", ["standard"], 1);
  assert.deepEqual(
    bad.map(({ reason }) => reason.code),
    Object.values(mistakes),
  );
  assert.deepEqual([file, count], ["id,x,y,z,nx,ny,nz,type,description\na,1,2,3,0,1,0,standard,Rye\n", 1]);
  const head = "id;x;y;z;ax;ay;az;roll_deg;type;cost;installed;reaches_alone";
  const units = read(`${head}\na;1,5;2;3;0;0;-1;0;ceiling;1;0;1\n`);
  assert.equal(listKindOf(units), "units");
  assert.equal(
    checkList(units, "units", ["ceiling"], 0.01).file,
    "id,x,y,z,ax,ay,az,roll_deg,type\na,150,200,300,0,0,-1,0,ceiling\n",
  );
  assert.equal(listKindOf(read("EAN;Regal\n1;2\n")), null);
});

test("damaged planograms are read or refused", () => {
  const { file } = planogramFile();
  const lines = Buffer.from(file).toString("latin1").split("\n").slice(0, 80).join("\n");
  const whole = Buffer.from(lines, "latin1");
  const mutants = times(5, 100);
  let refused = 0;
  for (let key = 0; key < mutants; ++key)
    try {
      const table = readTable(mutantOf(whole, key), isColumnName);
      const { good, bad } = checkPlanogram(table, mapped(table), shop);
      assert.equal(good.length + bad.length, table.rows.length);
      fileOf(good, mapped(table), shop);
    } catch (error) {
      if (!(error instanceof NotATable)) throw new Error(`mutant ${key}`, { cause: error });
      ++refused;
    }
  assert.ok(refused < mutants / 2, `${refused} are refused as a whole`);
});

const shopOfTables = { ...shop, holders: new Map(["A1", "A2", "A3"].map((id) => [id, holder(id)])) };
const tableFile = (name) => readTable(dataFile(`field4/${name}.csv`), isColumnName);
const checkedFile = (name, changed = {}) => {
  const table = tableFile(name);
  return checkPlanogram(table, mapped(table, changed), shopOfTables);
};
const placesOf = ({ good }) => good.slice(0, 4).map(({ place }) => place);

test("distances with marks of thousands are refused, until a person names the decimal mark", () => {
  for (const [name, mark] of [
    ["thousands_mm", ","],
    ["thousands_quoted", "."],
  ]) {
    const asked = checkedFile(name);
    assert.ok(asked.bad.length > 0 && asked.bad.every(({ reason }) => reason.code === "unclear"), name);
    const chosen = checkedFile(name, { mark });
    assert.deepEqual([placesOf(chosen), chosen.bad.length], [[0.25, 0.75, 1.25, 1.75], 0], name);
    assert.equal(checkedFile(name, { mark: mark === "." ? "," : "." }).good[2].place, 0.00125, "the other choice");
  }
});

test("cells with units are distances", () => {
  assert.deepEqual(placesOf(checkedFile("units_in_cells")), [0.25, 0.25, 0.25, 0.75]);
  assert.deepEqual(placesOf(checkedFile("units_m")), [0.25, 0.75, 1.25, 1.75]);
  const inches = checkedFile("units_inch");
  assert.ok(Math.abs(inches.good[0].place - 0.254) < 1e-9);
  const positions = checkedFile("units_in_cells", { measure: "position" });
  assert.deepEqual([positions.good.length, positions.bad[0].reason.code], [0, "number"]);
});

test("whole distances show that a separator does not tell the decimal mark", () => {
  for (const [separator, number] of [
    [";", "1,250"],
    [",", "1.250"],
  ]) {
    const lines = [
      ["EAN", "Regal", "Seite", "Boden", "Abstand (mm)"],
      ["1", "A1", "vorne", "1", number],
    ];
    const reasonsWith = (...line) => {
      const table = read([...lines, line].map((fields) => fields.join(separator)).join("\n"));
      return reasons(checkPlanogram(table, mapped(table), shopOfTables));
    };
    assert.deepEqual(reasonsWith("2", "A1", "vorne", "1", "250")[0], "2 unclear");
    assert.deepEqual(reasonsWith("2", "A1", "vorne", "1", number.replace("1", "2")), []);
  }
});

test("distances in unknown units are no numbers of places", () => {
  const cells = ["25 Zoll", "25 Zentimeter", "25 dm", "ca. 25 cm", "25cm links", "x=25 cm", "25 centimeters"];
  for (const cell of cells) {
    const table = read(`EAN;Regal;Seite;Boden;Abstand\n1;A1;vorne;1;${cell}\n`);
    assert.equal(checkPlanogram(table, mapped(table), shopOfTables).bad[0]?.reason.code, "number", cell);
  }
  const words = ["3. Boden", "Boden 3", "3", "3a", "2nd shelf", "25 cm", "1.250"];
  assert.deepEqual(words.map(ordinalIn), [3, 3, 3, 3, 2, null, null]);
});

test("merged cells are filled down if a person says so", () => {
  const table = tableFile("merged_cells");
  assert.ok(hasMergedCells(table, mapped(table)));
  assert.ok(!hasMergedCells(tableFile("meta_lines"), mapped(tableFile("meta_lines"))));
  const [empty, filled] = [checkedFile("merged_cells"), checkedFile("merged_cells", { fillsDown: true })];
  assert.equal(filled.bad.length, 0);
  assert.deepEqual([empty.good.length, filled.good.length], [empty.good.length, table.rows.length]);
  assert.ok(empty.good.length < filled.good.length / 2);
  assert.deepEqual(
    filled.good.slice(0, 6).map(({ holder: { id }, face, level, place }) => [id, face, level, place].join(" ")),
    ["A1 front 1 1", "A1 front 1 2", "A1 front 2 1", "A1 front 2 2", "A1 front 3 1", "A1 front 3 2"],
  );
});

test("places from 0 and boards from above are recognised", () => {
  const { good, bad } = checkedFile("places_from_zero");
  assert.deepEqual([bad.length, good.slice(0, 4).map(({ place }) => place)], [0, [1, 1, 1, 2]]);
  assert.equal(checkedFile("places_from_zero", { firstPlace: 1 }).bad[0].reason.code, "position");
  assert.ok(mapped(tableFile("boards_from_top")).fromTop);
  assert.ok(!mapped(tableFile("meta_lines")).fromTop);
});
