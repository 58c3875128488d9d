import assert from "node:assert/strict";
import { test } from "node:test";

import fc from "fast-check";

import { lengthsOf, numbersOf } from "../../../../src/page/planner/geometry/lengths";
import { factorOf } from "../../../../src/page/planner/geometry/units";
import { isColumnName } from "../../../../src/page/planner/planogram/guess";
import { textOf } from "../../../../src/page/planner/table/decode";
import { NotATable } from "../../../../src/page/planner/table/fault";
import { countIn, markOf, numberIn } from "../../../../src/page/planner/table/numbers";
import { isTable, isTableText } from "../../../../src/page/planner/table/sniff";
import { splitLines } from "../../../../src/page/planner/table/split";
import { readTable } from "../../../../src/page/planner/table/table";
import { csvField, csvText, isPrintable, lineOf } from "../../../../src/page/planner/table/write";
import { bytesOf, dataFile, times } from "./support.mjs";

const read = (text) => readTable(bytesOf(text));
const linesOf = ({ rows }) =>
  rows.map(({ line, fields, fault }) => [line, fields.join("|"), ...(fault ? [fault] : [])]);

test("separators, quotes and line ends of all spreadsheets", () => {
  for (const separator of [",", ";", "\t", "|"])
    for (const end of ["\n", "\r\n", "\r"]) {
      const text = ["article,fixture,x", '1,"A,1","0,5"', '2,"say ""A""",1', ""].join(end).replaceAll(",", separator);
      const table = read(text);
      assert.equal(table.separator, separator);
      assert.deepEqual(table.header, ["article", "fixture", "x"]);
      assert.deepEqual(linesOf(table), [
        [2, `1|A${separator}1|0${separator}5`],
        [3, '2|say "A"|1'],
      ]);
    }
});

test("decimal commas are no separators", () => {
  assert.equal(read("a;b\n0,5;1,5\n0,7;1,7\n").separator, ";");
  assert.equal(read("a,b\n1;2,3\n4;5,6\n").separator, ",");
  const rows = Array.from({ length: 50 }, (_, k) => `${k};Brot, hell;0,5${k % 30 === 0 ? ";x" : ""}`);
  assert.equal(read(["Nr;Name;x", ...rows].join("\n")).separator, ";", "with wrong lines");
  assert.equal(
    read(["Markt 12, Hannover;;", "Nr;Name;x", ...rows].join("\n")).header.join(),
    "Nr,Name,x",
    "below a title",
  );
});

test("a line sep= decides, and counts as a line", () => {
  assert.deepEqual(linesOf(read("sep=;\na,b;c\n1,2;3\n")), [[3, "1,2|3"]]);
  assert.deepEqual(linesOf(read('"sep=#"\r\na#b\r\n1#2\r\n')), [[3, "1|2"]]);
});

test("titles and empty lines are skipped, and lines keep their numbers", () => {
  const table = read('Planogram 12;;\n\narticle;fixture;level\n1;"A\n1";2\n;;\n3;B;4\n');
  assert.deepEqual(table.header, ["article", "fixture", "level"]);
  assert.deepEqual(linesOf(table), [
    [4, "1|A\n1|2"],
    [7, "3|B|4"],
  ]);
});

test("columns without names and content are left out", () => {
  const table = read("article;fixture;;\n1;A;;\n2;B;;\n");
  assert.deepEqual(table.header, ["article", "fixture"]);
  assert.deepEqual(linesOf(table), [
    [2, "1|A"],
    [3, "2|B"],
  ]);
});

test("a file without a header has its articles in the first line", () => {
  const table = read("4006381333931;A1\n4006381333948;A1\n");
  assert.deepEqual([table.header, table.rows.length], [["", ""], 2]);
});

test("wrong lines are errors of their own", () => {
  const table = read('a,b,c\n1,2\n1,2,3,4\n1,"2,3\n1,"2"x,3\n1,2,3\n1,2,3,,\n');
  assert.deepEqual(linesOf(table), [
    [2, "1|2", "few"],
    [3, "1|2|3|4", "many"],
    [4, '1,"2,3', "quote"],
    [5, '1,"2"x,3', "quote"],
    [6, "1|2|3"],
    [7, "1|2|3"],
  ]);
});

test("a lost quote does not hide the lines behind it, however many", () => {
  const rows = Array.from({ length: 5000 }, (_, k) => `${k},"A"`);
  rows[10] = '10,"A';
  const begin = performance.now();
  const table = read(["a,b", ...rows].join("\n"));
  assert.ok(performance.now() - begin < 2000);
  assert.deepEqual(
    table.rows.filter(({ fault }) => fault).map(({ line }) => line),
    [12],
  );
  assert.equal(table.rows.length, 5000);
});

test("protected digits and formulas are read as people mean them", () => {
  assert.deepEqual(linesOf(read(`a,b\n="00123",'=1+1\n'5,''-x\n`)), [
    [2, "00123|=1+1"],
    [3, "'5|'-x"],
  ]);
});

// Node.js takes Windows-1252 for Latin-1; table_test.mjs of the browser has a dash.
const letters = "Müsli für Zürich";
const wide = (text, isBig) => {
  const out = new Uint8Array(2 * text.length);
  for (let k = 0; k < text.length; ++k) new DataView(out.buffer).setUint16(2 * k, text.charCodeAt(k), !isBig);
  return out;
};

test("encodings: UTF-8, UTF-16 by its mark, otherwise Windows-1252", () => {
  const text = `name;x\n${letters};1\n`;
  const old = Uint8Array.from(text, (letter) => letter.charCodeAt(0));
  const files = [
    bytesOf(text),
    bytesOf(`\ufeff${text}`),
    wide(`\ufeff${text}`, false),
    wide(`\ufeff${text}`, true),
    old,
  ];
  for (const file of files) {
    const table = readTable(file);
    assert.deepEqual(table.header, ["name", "x"]);
    assert.equal(table.rows[0].fields[0], letters);
  }
  assert.equal(readTable(bytesOf("a,b\n1,2\n\x1a")).rows.length, 1, "Ctrl-Z of DOS");
});

test("files that are no tables are named by their fault", () => {
  for (const [content, fault] of [
    ["", "empty"],
    ["a,b\n", "empty"],
    ["a\n1\n2\n", "column"],
    ["a,b\0\n1,2\n", "binary"],
    [`a,b\n${"1,2\n".repeat(200_001)}`, "long"],
  ])
    assert.throws(() => read(content), { constructor: NotATable, fault });
  assert.throws(() => readTable(new Uint8Array(20_000_001)), { constructor: NotATable, fault: "large" });
  const most = times(20_000, 200_000);
  assert.equal(read(`a,b\n${"1,2\n".repeat(most)}`).rows.length, most);
});

const noise = fc.string({ unit: fc.constantFrom(..."ab 1,;|\"'=+-@\t\n\r.ü“"), maxLength: 12 });

test("what is written is read back", () => {
  fc.assert(
    fc.property(fc.array(fc.tuple(noise, noise), { minLength: 1, maxLength: 8 }), (rows) => {
      // The program trims unquoted fields and this page all, because blanks at the ends mean nothing.
      const plain = rows.map((row) => row.map((field) => field.trim()));
      const text = csvText(["left", "right"], plain, 2);
      const kept = plain.filter((row) => row.some((field) => field !== ""));
      if (kept.length === 0) return;
      const lines = splitLines(text, ",").slice(1);
      assert.deepEqual(
        lines.map(({ fields }) => fields.map((field) => field.replace(/^'(?='*[=+\-@\t\r])/, ""))),
        kept,
      );
    }),
  );
});

test("formulas get an apostrophe, which the program removes", () => {
  const fields = { "=1+1": "'=1+1", "-x": "'-x", "'=1": "''=1", 5: "5", "a,b": '"a,b"', 'say "x"': '"say ""x"""' };
  for (const [field, written] of Object.entries(fields)) assert.equal(csvField(field), written);
  assert.equal(csvText(["a", "b", "c"], [["x", -5, null]], 2), "a,b\nx,-5\n");
});

test("reading never fails in another way, and accounts for every line", () => {
  fc.assert(
    fc.property(fc.array(noise, { maxLength: 12 }), (parts) => {
      const text = parts.join("\n");
      try {
        const { header, rows } = read(text);
        const count = text.split(/\r\n|\r|\n/).length;
        for (const { line, fields, fault } of rows) {
          assert.ok(line >= 1 && line <= count);
          assert.ok(fault || fields.length === header.length);
        }
      } catch (error) {
        if (!(error instanceof NotATable)) throw error;
      }
    }),
    { numRuns: times(200, 5000) },
  );
});

test("numbers of all countries", () => {
  const table = (...fields) => ({ separator: "\t", rows: fields.map((field) => ({ fields: [field] })) });
  const value = (field, ...others) => numberIn(field, markOf(table(field, ...others), [0]))?.value;
  const numbers = { 1.5: 1.5, "1,5": 1.5, "-0,25": -0.25, "+3": 3, "1.234.567": 1234567 };
  for (const field of ["1.234,5", "1,234.5", "1'234.5", "1 234,5"]) numbers[field] = 1234.5;
  for (const [field, number] of Object.entries(numbers)) assert.equal(value(field), number, field);
  assert.equal(value("1.500", "0.5"), 1.5);
  assert.equal(numberIn("1.500", markOf(table("1.500", "0,5"), [0])), "unclear");
  assert.equal(numberIn("1.500", ",").value, 1500, "a person has chosen the comma");
  for (const wrong of ["", "x", "1,2,3", "1e", "--1", "1 km"]) assert.equal(numberIn(wrong, "."), null, wrong);
  const counts = { 3: 3, "Boden 3": 3, F03: 3, "3,0": 3, "-1": -1, "3a": 3 };
  for (const field of ["drei", "1 und 2", "25 cm", '10"', "1.000"]) counts[field] = null;
  for (const [field, count] of Object.entries(counts)) assert.equal(countIn(field), count, field);
});

/** The cases of test/data/written_numbers.tsv, which the program reads in the same way (test/unit/base/csv_test.cpp). */
const written = dataFile("written_numbers.tsv")
  .toString()
  .split("\n")
  .filter((line) => line !== "")
  .map((line) => line.split("\t"))
  .map(([spelling, unit, shown, right, outcome]) => ({ spelling, unit, shown, right: Number(right), outcome }));
const isNear = (value, right) => Math.abs(value - right) <= 1e-9 * Math.max(1, Math.abs(right));

test("numbers in tables are read as the program reads them", () => {
  assert.ok(written.length >= 2000);
  for (const one of written) {
    const rows = [one.shown, one.spelling].filter((field) => field !== "-").map((field) => ({ fields: [field] }));
    const number = numberIn(one.spelling, markOf({ separator: "\t", rows }, [0]));
    const isRead = number !== null && number !== "unclear" && (one.unit !== "-" || number.unit === undefined);
    assert.equal(isRead, one.outcome === "read", JSON.stringify(one));
    if (!isRead) continue;
    const metres = one.unit === "-" ? number.value : number.value * factorOf(number.unit ?? one.unit);
    assert.ok(isNear(metres, one.right), JSON.stringify([one, metres]));
  }
});

test("typed numbers are right, or have two readings", () => {
  let refused = 0;
  for (const one of written) {
    const factor = one.unit === "-" ? 1 : factorOf(one.unit);
    const found = one.unit === "-" ? numbersOf(one.spelling) : lengthsOf(one.spelling, factor);
    const values = found.map((value) => value * factor);
    // Lengths of 1 km and more are not typed with marks of thousands; products and sums are not numbers of tables.
    if (Math.abs(one.right) >= 1000) continue;
    assert.ok(values.length === 0 || values.some((value) => isNear(value, one.right)), JSON.stringify([one, values]));
    if (values.length !== 1) ++refused;
  }
  assert.ok(refused > 0 && refused < written.length / 5, String(refused));
});

const fieldFile = (name) => dataFile(`field4/${name}.csv`);

test("older encodings are guessed", () => {
  const names = { shift_jis: ["shift_jis", "処理牛乳"], 1251: ["windows-1251", "Молоко"], 850: ["cp850", "Käse"] };
  for (const [file, [encoding, name]] of Object.entries(names)) {
    const table = readTable(fieldFile(`names_${file}`));
    assert.deepEqual([table.encoding, table.rows[0].fields[1]], [encoding, name]);
  }
  const letters = {
    "windows-1252": "Käse;Brötchen;Müsli;Crème brûlée;Jalapeño;Weißbrot",
    "windows-1250": "Żółty ser;Śmietana;Świeży chleb;Jabłka z Łącka",
    "windows-1253": "Γάλα;Ψωμί;Τυρί φέτα;Ελαιόλαδο",
  };
  const tableOf = (encoding) =>
    new Map([...Array(128).keys()].map((k) => [new TextDecoder(encoding).decode(Uint8Array.of(k + 128)), k + 128]));
  for (const [encoding, text] of Object.entries(letters)) {
    const codes = tableOf(encoding);
    const file = Uint8Array.from([...text], (letter) => codes.get(letter) ?? letter.charCodeAt(0));
    assert.deepEqual([textOf(file).encoding, textOf(file).text], [encoding, text]);
  }
  assert.equal(readTable(fieldFile("names_1251"), undefined, { encoding: "windows-1252" }).rows[0].fields[1], "Ìîëîêî");
  assert.equal(readTable(bytesOf("a;b\nä;1\n")).encoding, undefined);
});

test("the names of columns are found below other lines", () => {
  const header = (name) => readTable(fieldFile(name), isColumnName).header.slice(0, 3);
  assert.deepEqual(header("meta_lines"), ["EAN", "Artikel", "Regal"]);
  assert.deepEqual(header("two_headers"), ["EAN", "Name", "Regal"]);
  const chosen = readTable(fieldFile("two_headers"), isColumnName, { headerAt: 0 });
  assert.deepEqual(chosen.header.slice(0, 3), ["Artikel", "", "Ort"]);
  assert.deepEqual(read("EAN;Regal\n0;1;A1\n1;2;A2\n").header, ["", "EAN", "Regal"]);
  assert.deepEqual(read("EAN;Regal\n7;1;A1\n1;2;A2\n").rows[0].fault, "many");
});

test("texts for the program have no characters that it refuses", () => {
  assert.ok(isPrintable("Müsli №1 – ‍"));
  for (const bad of ["a\nb", "a\u200bb", "a\u202eb", "a\x85b"]) {
    assert.ok(!isPrintable(bad));
    assert.equal(lineOf(` ${bad} `), "a b");
  }
});

test("tables are recognised by their names or first lines", () => {
  for (const name of ["a.csv", "a.TSV", "a.txt"]) assert.ok(isTable(name, bytesOf("\0")));
  for (const text of ["a;b\n1;2", "a\tb\r\n1\t2", "a,b\n\n1,2\n"]) {
    assert.ok(isTable("export", bytesOf(text)), text);
    assert.ok(isTable("export", wide(`\ufeff${text}`, true)));
  }
  for (const text of ['{"a": 1,\n"b": 2}', "<a,\n<b,", "one, two", "a;b\n1,2", "\0,\n\0,", ""])
    assert.ok(!isTableText(text), text);
});
