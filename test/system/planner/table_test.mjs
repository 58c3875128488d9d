// Tests the import of planograms and of lists of labels and candidates.

import { spawnSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";

import { articles, names, planogramFile, types } from "../../data/planogram_file.mjs";
import { check, equal, says } from "../viewer/check.mjs";
import { drop } from "./floor_plan.mjs";
import { testPlanner } from "./opened.mjs";

const mostActions = 12;
const [ownLabels, otherLabels] = [686, 6]; // of the grocery, and those of its check-outs

/** A person who imports a table: drops, choices and clicks count as actions. */
class Importer {
  actions = 0;

  constructor(tab) {
    this.tab = tab;
  }

  async drop(name, body) {
    ++this.actions;
    await drop(this.tab, name, Buffer.from(body));
  }

  async open(name, body) {
    await this.drop(name, body);
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
    await this.tab.push(`[data-key="${key}"]`);
  }
}

const button = (tab) => tab.text("dialog.planogram .primary");
const notice = async (tab, ...parts) => {
  await tab.until((words) => document.querySelector(".notice").textContent.includes(words), parts[0]);
  says(await tab.text(".notice"), ...parts);
};
const hasLabels = (tab, count) =>
  tab.until((wanted) => window.shelfbeamPlanner.planner.document.labels.count === wanted, count);
const problems = (tab) =>
  tab.page.evaluate(() => window.shelfbeamPlanner.planner.document.problems.map(({ sentence }) => sentence));
const badLines = (tab) =>
  tab.page.evaluate(() =>
    [...document.querySelectorAll(".bad-lines tbody tr")].map((row) => ({
      line: Number(row.children[0].textContent),
      words: row.children[1].textContent,
    })),
  );
const unknown = (tab) =>
  tab.page.evaluate(() => [...document.querySelectorAll(".word.unknown .name")].map(({ textContent }) => textContent));

function expectBad(found, expected) {
  equal(
    found.map(({ line }) => line),
    expected.map(({ line }) => line),
    "bad lines",
  );
  expected.forEach(({ words }, k) => says(found[k].words, words));
}

/** The names and types that the page cannot know. */
async function chooseWords(person) {
  for (const [word, id] of Object.entries(names)) await person.choose(`word/fixture/${word}`, id);
  for (const [word, type] of Object.entries(types)) await person.choose(`word/type/${word}`, type);
}

testPlanner(
  "table: the planogram of a shop of 1,200 articles with 3 % of bad lines",
  { smoke: true, keeps: true },
  async (tab, { tools }) => {
    const person = new Importer(tab);
    const { file, bad } = planogramFile();
    const good = articles - bad.length;
    await person.open("Planogramm Markt 12.csv", file);
    says(await tab.text(".dialog h2"), "Labels from Planogramm Markt 12.csv");
    equal((await unknown(tab)).sort(), ["Lager", "unten", ...Object.keys(names), ...Object.keys(types)].sort());
    await tab.picture("table-unknown");
    await chooseWords(person);
    expectBad(await badLines(tab), bad);
    equal(
      [await button(tab), await tab.text(".dialog .says")],
      [`Add ${good.toLocaleString("en")} labels`, "36 lines are left out"],
    );
    await tab.picture("table-mapped");
    await person.push("add-labels");
    await tab.steps(1);
    check(person.actions <= mostActions, `${person.actions} actions`);
    console.log(`        ${person.actions} actions`);
    equal(await tab.labels(), ["Add the planogram"]);
    await notice(tab, "1,164 labels added from Planogramm-Markt-12.csv; lines left out: 36.");
    equal(tab.json.planogram, { file: "Planogramm-Markt-12.csv", type: "standard" });
    says(
      readFileSync(join(tab.server.folder, "Planogramm-Markt-12.csv"), "utf8"),
      "Müsli – 7",
      "Müsli – 20; mit Nüssen",
    );
    await hasLabels(tab, otherLabels + good);
    equal(await problems(tab), []);
    equal([tab.json.fixtures[0].labels, tab.json.fixtures[8].labels], [null, undefined], "labels of the fixtures");
    await tab.picture("table-added");

    const { status, stdout, stderr } = spawnSync(
      tools.shelfbeam,
      ["inspect", join(tab.server.folder, "store.json"), "--json", "--strict"],
      { encoding: "utf8" },
    );
    equal(status, 0, `inspect: ${stderr}`);
    equal(JSON.parse(stdout).labels, otherLabels + good, "labels for the program");

    // Next month's file opens mapped.
    const next = planogramFile(1);
    const again = new Importer(tab);
    await again.open("Planogramm Markt 12.csv", next.file);
    again.actions = 0;
    expectBad(await badLines(tab), next.bad);
    says(await tab.text(".planogram footer"), "The planogram Planogramm-Markt-12.csv of the store is replaced");
    equal(await button(tab), `Replace with ${(articles - next.bad.length).toLocaleString("en")} labels`);
    equal(
      await tab.page.evaluate(() => document.activeElement.dataset.key.startsWith("word/")),
      true,
      "the unknown word",
    );
    await tab.picture("table-again");
    await again.push("add-labels");
    await tab.steps(2);
    equal(again.actions, 1);
    equal(tab.json.planogram, { file: "Planogramm-Markt-12-2.csv", type: "standard" });
    check(existsSync(join(tab.server.folder, "Planogramm-Markt-12.csv")), "the first file stays");
    equal(await tab.labels(), ["Add the planogram", "Replace the planogram"]);
    await tab.press("Control+z");
    await tab.steps(1);
    equal(tab.json.planogram.file, "Planogramm-Markt-12.csv");
    await tab.press("Control+z");
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

testPlanner("table: segments of a planogram program", { keeps: true }, async (tab, { tools }) => {
  const person = new Importer(tab);
  await person.open("planogram.csv", segments);
  equal(await unknown(tab), ["Bakery", "Drinks"]);
  await person.choose("word/fixture/Bakery", "A2, back");
  await person.choose("word/fixture/Drinks", "A2, back");
  expectBad(await badLines(tab), [
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
  equal(await problems(tab), []);
  const { status, stderr } = spawnSync(
    tools.shelfbeam,
    ["inspect", join(tab.server.folder, "store.json"), "--strict"],
    {
      encoding: "utf8",
    },
  );
  equal(status, 0, stderr);
});

testPlanner(
  "table: distances, with faces in place of a column, into a store with a planogram",
  { store: "market-hall" },
  async (tab) => {
    const person = new Importer(tab);
    await person.open(
      "planogram.csv",
      "EAN\tRegal\tBoden\tAbstand (cm)\n4001686301265\tD 1\t1\t66,5\n4001686301272\tD-02\t0\t140\n",
    );
    says(await tab.text(".planogram footer"), "The planogram planogram.csv of the store is replaced");
    expectBad(await badLines(tab), [{ line: 3, words: "“140” is beyond the edge of 133.00" }]);
    await person.push("add-labels");
    await tab.steps(1);
    equal(tab.json.planogram, { file: "planogram-2.csv", type: "standard" });
    await tab.until(() => window.shelfbeamPlanner.planner.document.problems.length === 0);
  },
);

testPlanner("table: a list of labels and one of candidates", {}, async (tab) => {
  const person = new Importer(tab);
  const label = (id, type = "standard") => `${id};5;0,01;1,5;0;1;0;${type}`;
  const list = ["id;x;y;z;nx;ny;nz;type", label("poster"), label("stand"), label("poster"), label("odd", "paper")];
  await person.open("my labels.csv", list.join("\n"));
  says(await tab.text(".dialog"), "Labels from my labels.csv", "2 lines are left out", "Unknown label type “paper”");
  equal(await button(tab), "Add 2 labels");
  await tab.picture("table-list");
  await person.push("add-list");
  await tab.steps(1);
  equal([tab.json.labels, await tab.labels()], [{ csv: "my-labels.csv" }, ["Add a list of labels"]]);
  await notice(tab, "2 labels added from my-labels.csv");
  await hasLabels(tab, ownLabels + 2);

  const unit = (id) => `${id},6.5,5.5,2.95,0,0,-1,0,ceiling`;
  await person.open("units.csv", ["id,x,y,z,ax,ay,az,roll_deg,type", unit("till"), unit("door"), "x,1"].join("\n"));
  says(await tab.text(".dialog"), "Candidates from units.csv", "Too few fields");
  await person.push("add-list");
  await tab.steps(2);
  equal(tab.json.transceivers.list, { csv: "units.csv" });
  await person.open("units.csv", ["id,x,y,z,ax,ay,az,roll_deg,type", unit("lamp")].join("\n"));
  says(await tab.text(".dialog"), "The store has a list already: units.csv");
  equal(await button(tab), "Replace units.csv with 1 candidate");
  await person.push("add-list");
  await tab.steps(3);
  equal(tab.json.transceivers.list, { csv: "units-2.csv" });
  equal(await problems(tab), []);
});

testPlanner("table: labels in a list of the store are not lost silently", { store: "market-hall" }, async (tab) => {
  const person = new Importer(tab);
  await person.open("labels.csv", "id,x,y,z,nx,ny,nz,type\nposter,5,0.01,1.5,0,1,0,standard\n");
  says(await tab.text(".dialog .lead"), "The store has a list already: 1 label. The new list replaces it.");
  await tab.press("Escape");
  check(await tab.isUntouched(), "Esc changes nothing");
  await person.open("labels.csv", "id,x,y,z,nx,ny,nz,type\nposter,5,0.01,1.5,0,1,0,standard\n");
  await tab.press("Enter");
  await tab.steps(1);
  equal(tab.json.labels, { csv: "labels.csv" });
});

testPlanner("table: wrong files are refused by name", {}, async (tab) => {
  const refused = [
    ["noise.csv", Buffer.from([1, 0, 2, 0, 255, 254]), "noise.csv is not a text file."],
    ["empty.csv", Buffer.alloc(0), "empty.csv is empty or a folder."],
    ["blank.csv", Buffer.from("\n \n"), "blank.csv has no lines below"],
    ["header.csv", Buffer.from("article;fixture\n"), "header.csv has no lines below"],
    ["column.txt", Buffer.from("article\n1\n2\n"), "column.txt has a single column."],
    ["long.csv", Buffer.alloc(4 * 200_010, "1,2\n"), "long.csv has more than 200,000 lines."],
    ["book.xlsx", Buffer.from("PK\x03\x04"), "book.xlsx is a spreadsheet. Save it as CSV"],
    ["shop.json", Buffer.from('{"a": 1,\n"b": 2}'), "shop.json is of no format that the planner reads."],
  ];
  for (const [name, body, words] of refused) {
    await drop(tab, name, body);
    await notice(tab, words);
    equal(await tab.page.$("dialog[open]"), null, name);
  }
  // Made in the page, because so many bytes are slow to send there.
  await tab.page.evaluate(() => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File(["1,2\n".repeat(7_500_000)], "large.csv"));
    document.body.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
  });
  await notice(tab, "large.csv has more than 20 MB.");
  check(await tab.isUntouched(), "nothing has changed");
});

testPlanner("table: the list of bad lines is copied", { alone: true, permissions: ["clipboard-read"] }, async (tab) => {
  const person = new Importer(tab);
  const rows = Array.from({ length: 250 }, (_, k) => `${k};Lager;1`);
  await person.open("planogram.csv", ["EAN;Regal;Boden", ...rows].join("\n"));
  equal((await badLines(tab)).length, 200);
  says(await tab.text(".bad-lines"), "250 lines are left out", "The first 200 are shown");
  equal(await tab.page.evaluate(() => document.querySelector("dialog .primary").disabled), true, "nothing to add");
  await person.push("copy-bad-lines");
  equal(await tab.text('[data-key="copy-bad-lines"]'), "Copied");
  const copied = (await tab.page.evaluate(() => navigator.clipboard.readText())).split("\n");
  equal([copied.length, copied[249]], [250, "251\tUnknown fixture “Lager”\t249\tLager\t1"]);
  await tab.press("Escape");
});

testPlanner("table: cells of a spreadsheet are pasted, and chosen by keys", {}, async (tab) => {
  await tab.page.evaluate(() => {
    const clipboardData = new DataTransfer();
    clipboardData.setData(
      "text/plain",
      "EAN\tRegal\tBoden\tPlatz\n4001686301265\tA1\t1\t1\n4001686301272\tHalle\t1\t2\n",
    );
    document.body.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true, cancelable: true }));
  });
  await tab.until(() => document.activeElement?.dataset.key === "word/fixture/Halle");
  await tab.page.keyboard.type("A2");
  await tab.until(() => document.querySelector("dialog .primary").textContent === "Add 2 labels");
  await tab.page.focus('[data-key="table-from-top"]');
  await tab.page.keyboard.type("from above");
  equal(await tab.page.evaluate(() => document.activeElement.dataset.key), "table-from-top", "the focus stays");
  await tab.page.focus('[data-key="add-labels"]');
  await tab.press("Enter");
  await tab.steps(1);
  equal(tab.json.planogram.file, "table.csv");
  await hasLabels(tab, ownLabels - 2 * 120 + 2);
});

for (const dark of [false, true])
  testPlanner(`table: axe has no findings, ${dark ? "dark" : "light"}`, { dark }, async (tab, { axe }) => {
    const person = new Importer(tab);
    await person.open("planogram.csv", planogramFile().file);
    await tab.page.evaluate(axe);
    const findings = await tab.page.evaluate(async () => {
      const { violations } = await window.axe.run(document, { resultTypes: ["violations"] });
      return violations.map(
        ({ id, nodes }) => `${id}: ${nodes.map(({ target, failureSummary }) => `${target} ${failureSummary}`)}`,
      );
    });
    equal(findings, []);
    await tab.picture(`table-${dark ? "dark" : "light"}`);
    await tab.press("Escape");
  });
