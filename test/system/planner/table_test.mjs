// Tests the import of planograms and of lists of labels and candidates.

import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";

import { articles, names, planogramFile, types } from "../../data/planogram_file.mjs";
import { check, equal, says } from "../viewer/check.mjs";
import { drop } from "./floor_plan.mjs";
import { testAxe, testPlanner } from "./opened.mjs";

const mostActions = 12;
const [ownLabels, otherLabels] = [686, 6]; // of the grocery, and those of its check-outs

/** A person who imports a table: drops, choices and clicks count as actions. */
class Importer {
  actions = 0;

  constructor(tab) {
    this.tab = tab;
  }

  async open(name, body) {
    ++this.actions;
    await drop(this.tab, name, Buffer.from(Array.isArray(body) ? body.join("\n") : body));
    await this.tab.until(() => document.querySelector("dialog.planogram [data-key^='add-']") !== null);
    await this.tab.settle();
  }

  /** Fields fill their lists when they get the focus. */
  async choose(key, label) {
    ++this.actions;
    await this.tab.page.focus(`[data-key="${key}"]`);
    await this.tab.choose(key, label);
  }

  async push(key) {
    ++this.actions;
    await this.tab.use(key);
  }
}

const button = (tab) => tab.text("dialog.planogram .primary");
const hasLabels = (tab, count) => tab.reaches(({ planner }, wanted) => planner.document.labels.count === wanted, count);
const unknown = (tab) => tab.texts(".word.unknown .name");

/** The bad lines, each with a part of its reason. */
async function hasBad(tab, expected) {
  const found = await tab.texts(".bad-lines tbody tr > :nth-child(1)");
  equal(
    found.map(Number),
    expected.map(({ line }) => line),
    "bad lines",
  );
  const reasons = await tab.texts(".bad-lines tbody tr > :nth-child(2)");
  expected.forEach(({ words }, k) => says(reasons[k], words));
}

/** The number of labels that the program counts in the store, which must have no warning. */
async function labelsIn(tab, given) {
  const told = await given.run("inspect", join(tab.server.folder, "store.json"), "--json", "--strict");
  return JSON.parse(told).labels;
}

testPlanner(
  "table: a planogram of 1,200 articles with 3 % of bad lines",
  { smoke: true, keeps: true },
  async (tab, given) => {
    const person = new Importer(tab);
    const { file, bad } = planogramFile();
    const good = articles - bad.length;
    await person.open("Planogramm Markt 12.csv", file);
    says(await tab.text(".dialog h2"), "Labels from Planogramm Markt 12.csv");
    equal((await unknown(tab)).sort(), ["Lager", "unten", ...Object.keys(names), ...Object.keys(types)].sort());
    await tab.picture("table-unknown");
    // The names and types that the page cannot know.
    for (const [word, id] of Object.entries(names)) await person.choose(`word/fixture/${word}`, id);
    for (const [word, type] of Object.entries(types)) await person.choose(`word/type/${word}`, type);
    await hasBad(tab, bad);
    equal(await button(tab), `Add ${good.toLocaleString("en")} labels`);
    equal(await tab.text(".dialog .says"), "36 lines are left out");
    await tab.picture("table-mapped");
    await person.push("add-labels");
    await tab.steps(1);
    check(person.actions <= mostActions, `${person.actions} actions`);
    console.log(`        ${person.actions} actions`);
    equal(await tab.labels(), ["Add the planogram"]);
    await tab.notice("1,164 labels added from Planogramm-Markt-12.csv; lines left out: 36.");
    equal(tab.json.planogram, { file: "Planogramm-Markt-12.csv", type: "standard" });
    const kept = readFileSync(join(tab.server.folder, "Planogramm-Markt-12.csv"), "utf8");
    says(kept, "Müsli – 7", "Müsli – 20; mit Nüssen");
    await hasLabels(tab, otherLabels + good);
    equal(await tab.problems(), []);
    equal([tab.json.fixtures[0].labels, tab.json.fixtures[8].labels], [null, undefined], "labels of the fixtures");
    await tab.picture("table-added");
    equal(await labelsIn(tab, given), otherLabels + good, "labels for the program");

    // Next month's file opens mapped.
    const next = planogramFile(1);
    await person.open("Planogramm Markt 12.csv", next.file);
    person.actions = 0;
    await hasBad(tab, next.bad);
    says(await tab.text(".planogram footer"), "The planogram Planogramm-Markt-12.csv of the store is replaced");
    equal(await button(tab), `Replace with ${(articles - next.bad.length).toLocaleString("en")} labels`);
    says(await tab.focused(), "word/"); // the unknown word
    await tab.picture("table-again");
    await person.push("add-labels");
    await tab.steps(2);
    equal(person.actions, 1);
    equal(tab.json.planogram, { file: "Planogramm-Markt-12-2.csv", type: "standard" });
    check(existsSync(join(tab.server.folder, "Planogramm-Markt-12.csv")), "the first file stays");
    equal(await tab.labels(), ["Add the planogram", "Replace the planogram"]);
    await tab.press("Control+z", "Control+z");
    await tab.steps(0);
    equal(tab.json.planogram, undefined);
    await hasLabels(tab, ownLabels);
  },
);

const segments = `UPC;Name;Planogram;Segment;Shelf;Sequence;Width;HFacings
4001686301265;Rye bread;Bakery;1;1;1;0,2;2
4001686301272;Wholemeal bread;Bakery;1;1;2;0,2;1
4001686301289;Rolls;Bakery;2;3;1;0,3;1
4001686301296;Pretzels;Bakery;2;9;1;0,1;4
4001686301265;Rye bread;Bakery;1;1;1;0,2;2
4001686301302;Coffee;Drinks;1;2;1;0,1;1
`;

testPlanner("table: segments of a planogram program", { keeps: true }, async (tab, given) => {
  const person = new Importer(tab);
  await person.open("planogram.csv", segments);
  equal(await unknown(tab), ["Bakery", "Drinks"]);
  await person.choose("word/fixture/Bakery", "A2, back");
  await person.choose("word/fixture/Drinks", "A2, back");
  await hasBad(tab, [
    { line: 5, words: "No board “9”: the fixture has 4" },
    { line: 6, words: "“4001686301265” is twice at the same place" },
  ]);
  await tab.picture("table-segments");
  await person.push("add-labels");
  await tab.steps(1);
  equal(tab.json.planogram.segments, [
    { planogram: "Bakery", segments: [1, 2], fixture: "A2", face: "back", to: 8 },
    { planogram: "Drinks", segments: [1], fixture: "A2", face: "back", from: 8 },
  ]);
  check((await labelsIn(tab, given)) > 0, "labels for the program");
});

testPlanner("table: distances, and lists, into a store that has both", { store: "market-hall" }, async (tab) => {
  const person = new Importer(tab);
  const lines = ["EAN\tRegal\tBoden\tAbstand (cm)", "4001686301265\tD 1\t1\t66,5", "4001686301272\tD-02\t0\t140"];
  await person.open("planogram.csv", lines);
  says(await tab.text(".planogram footer"), "The planogram planogram.csv of the store is replaced");
  await hasBad(tab, [{ line: 3, words: "“140” is beyond the edge of 133.00" }]);
  await person.push("add-labels");
  await tab.steps(1);
  equal(tab.json.planogram, { file: "planogram-2.csv", type: "standard" });
  await tab.reaches(({ planner }) => planner.document.problems.length === 0);
  // A list of the store is not lost silently.
  const list = ["id,x,y,z,nx,ny,nz,type", "poster,5,0.01,1.5,0,1,0,standard"];
  await person.open("labels.csv", list);
  says(await tab.text(".dialog .lead"), "The store has a list already: 1 label. The new list replaces it.");
  await tab.press("Escape");
  await tab.steps(1);
  await person.open("labels.csv", list);
  await tab.press("Enter");
  await tab.steps(2);
  equal(tab.json.labels, { csv: "labels.csv" });
});

testPlanner("table: a list of labels and one of candidates", {}, async (tab) => {
  const person = new Importer(tab);
  const label = (id, type = "standard") => `${id};5;0,01;1,5;0;1;0;${type}`;
  const list = ["id;x;y;z;nx;ny;nz;type", label("poster"), label("stand"), label("poster"), label("odd", "paper")];
  await person.open("my labels.csv", list);
  says(await tab.text(".dialog"), "Labels from my labels.csv", "2 lines are left out", "Unknown label type “paper”");
  equal(await button(tab), "Add 2 labels");
  await tab.picture("table-list");
  await person.push("add-list");
  await tab.steps(1);
  equal([tab.json.labels, await tab.labels()], [{ csv: "my-labels.csv" }, ["Add a list of labels"]]);
  await tab.notice("2 labels added from my-labels.csv");
  await hasLabels(tab, ownLabels + 2);

  const head = "id,x,y,z,ax,ay,az,roll_deg,type";
  const unit = (id) => `${id},6.5,5.5,2.95,0,0,-1,0,ceiling`;
  await person.open("units.csv", [head, unit("till"), unit("door"), "x,1"]);
  says(await tab.text(".dialog"), "Candidates from units.csv", "Too few fields");
  await person.push("add-list");
  await tab.steps(2);
  equal(tab.json.transceivers.list, { csv: "units.csv" });
  await person.open("units.csv", [head, unit("lamp")]);
  says(await tab.text(".dialog"), "The store has a list already: units.csv");
  equal(await button(tab), "Replace units.csv with 1 candidate");
  await person.push("add-list");
  await tab.steps(3);
  equal(tab.json.transceivers.list, { csv: "units-2.csv" });
  equal(await tab.problems(), []);
});

testPlanner("table: wrong files are refused by name", {}, async (tab) => {
  for (const [name, body, words] of [
    ["noise.csv", Buffer.from([1, 0, 2, 0, 255, 254]), "noise.csv is not a text file."],
    ["blank.csv", Buffer.from("\n \n"), "blank.csv has no lines below"],
    ["column.txt", Buffer.from("article\n1\n2\n"), "column.txt has a single column."],
    ["long.csv", Buffer.alloc(4 * 200_010, "1,2\n"), "long.csv has more than 200,000 lines."],
  ]) {
    await drop(tab, name, body);
    await tab.notice(words);
    check(!(await tab.has("dialog[open]")), name);
  }
  // Made in the page, because so many bytes are slow to send there.
  await tab.evaluate(() => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File(["1,2\n".repeat(7_500_000)], "large.csv"));
    document.body.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
  });
  await tab.notice("large.csv has more than 20 MB.");
  check(await tab.isUntouched(), "nothing has changed");
});

testPlanner("table: the list of bad lines is copied", { alone: true, permissions: ["clipboard-read"] }, async (tab) => {
  const person = new Importer(tab);
  await person.open("planogram.csv", ["EAN;Regal;Boden", ...Array.from({ length: 250 }, (_, k) => `${k};Lager;1`)]);
  equal(await tab.count(".bad-lines tbody tr"), 200);
  says(await tab.text(".bad-lines"), "250 lines are left out", "The first 200 are shown");
  check(await tab.has("dialog .primary:disabled"), "nothing to add");
  await person.push("copy-bad-lines");
  equal(await tab.text('[data-key="copy-bad-lines"]'), "Copied");
  const copied = (await tab.evaluate("navigator.clipboard.readText()")).split("\n");
  equal([copied.length, copied[249]], [250, "251\tUnknown fixture “Lager”\t249\tLager\t1"]);
  await tab.press("Escape");
});

testPlanner("table: cells of a spreadsheet are pasted, and chosen by keys", {}, async (tab) => {
  const cells = "EAN\tRegal\tBoden\tPlatz\n4001686301265\tA1\t1\t1\n4001686301272\tHalle\t1\t2\n";
  await tab.evaluate((text) => {
    const clipboardData = new DataTransfer();
    clipboardData.setData("text/plain", text);
    document.body.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true, cancelable: true }));
  }, cells);
  await tab.until(() => document.activeElement?.dataset.key === "word/fixture/Halle");
  await tab.page.keyboard.type("A2");
  await tab.until(() => document.querySelector("dialog .primary").textContent === "Add 2 labels");
  await tab.page.focus('[data-key="table-from-top"]');
  await tab.page.keyboard.type("from above");
  equal(await tab.focused(), "table-from-top", "the focus stays");
  await tab.page.focus('[data-key="add-labels"]');
  await tab.press("Enter");
  await tab.steps(1);
  equal(tab.json.planogram.file, "table.csv");
  await hasLabels(tab, ownLabels - 2 * 120 + 2);
});

testAxe("table", {}, async (tab, clean, colours) => {
  await new Importer(tab).open("planogram.csv", planogramFile().file);
  await clean("the dialog");
  await tab.picture(`table-${colours}`);
  await tab.press("Escape");
});
