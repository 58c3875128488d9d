// Tests what comes from other files, the choice of kinds, and undo after the page is loaded again.

import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { check, equal, says } from "../viewer/check.mjs";
import { testPlanner } from "./opened.mjs";

/** Labels and candidates from CSV files. */
function withFiles(folder) {
  const file = join(folder, "store.json");
  const text = readFileSync(file, "utf8")
    .replace("{", '{ "labels": { "csv": "labels.csv" },')
    .replace(/"transceivers":\s*\{/, '$& "list": { "csv": "units.csv" },');
  writeFileSync(file, text);
  writeFileSync(
    join(folder, "labels.csv"),
    "id,x,y,z,nx,ny,nz,type\nposter,2,17.99,1.5,0,-1,0,standard\nstand,2.5,10,0.8,0,-1,0.5,standard\n",
  );
  writeFileSync(join(folder, "units.csv"), "id,x,y,z,ax,ay,az,roll_deg,type\nover-door,3.2,8.2,3.5,0,0,-1,0,ceiling\n");
}

async function find(tab, name) {
  await tab.press("Control+f");
  await tab.page.keyboard.type(name);
  await tab.until((of) => document.querySelector(".results li span")?.textContent === of, name);
  await tab.press("Enter");
  await tab.until((of) => document.querySelector(".properties h2").textContent === of, name);
}

async function staysLocked(tab, ...sources) {
  says(await tab.text(".properties"), "Comes from another file of the project, and is changed there.", ...sources);
  says(await tab.text(".status .hint"), "Locked");
  equal(await tab.page.$('.properties [data-key^="field/"]'), null, "no field");
  for (const key of ["ArrowRight", "r", "Delete", "Control+d", "Shift+H"]) {
    await tab.page.evaluate(() => window.shelfbeamPlanner.planner.say(""));
    await tab.press(key);
    await tab.until(
      () => document.querySelector(".notice").textContent === "This comes from another file. Change it there.",
    );
  }
  check(await tab.isUntouched(), "the store is untouched");
}

testPlanner(
  "labels and candidates of CSV files are locked, and name file and line",
  { prepare: withFiles },
  async (tab) => {
    await find(tab, "stand");
    await staysLocked(tab, "labels.csv", "3");
    await tab.press("Escape");
    await tab.click(2.5, 10);
    await tab.until(() => document.querySelector(".properties h2").textContent === "stand");
    await tab.drag([2.5, 10], [2.7, 10.2]);
    check(await tab.isUntouched(), "a drag");
    await find(tab, "over-door");
    await staysLocked(tab, "units.csv", "2");
    equal(readFileSync(join(tab.server.folder, "labels.csv"), "utf8").split("\n").length, 4);
  },
);

testPlanner("labels of a planogram are locked, and name file and line", { store: "market-hall" }, async (tab) => {
  await find(tab, "4001686301272");
  says(await tab.text(".properties"), "planogram.csv", "3", "Wholemeal bread", "D1, front, board 1, at ");
  await tab.press("ArrowRight");
  await tab.until(() => document.querySelector(".notice").classList.contains("problem"));
  check(await tab.isUntouched(), "the store is untouched");
});

testPlanner("the list shows one kind; chips keep one kind of the selection", {}, async (tab) => {
  const kinds = [
    ["keep_out", 1],
    ["grid", 1],
    ["fixture", 13],
    ["room", 1],
  ];
  for (const [kind, count] of kinds) {
    await tab.page.selectOption(".objects select", kind);
    await tab.settle();
    equal(await tab.page.evaluate(() => document.querySelector(".object").ariaSetSize), String(count), kind);
    says(await tab.text(".objects .note"), `${count} of 16 elements`);
  }
  await tab.page.selectOption(".objects select", "");
  await tab.page.focus(".surface");
  await tab.press("Control+a");
  const chips = () =>
    tab.page.evaluate(() => [...document.querySelectorAll(".chip")].map(({ textContent }) => textContent));
  equal(await chips(), ["13 fixtures", "1 grid", "1 keep-out area"]);
  await tab.push('[data-key="chip-fixture"]');
  equal((await tab.selected()).length, 13);
  equal(await chips(), [], "one kind needs no chips");
  await tab.page.focus(".surface");
  await tab.press("Control+a");
  await tab.push('[data-key="chip-grid"]');
  equal(await tab.selected(), ["/transceivers/grids/0"]);
});

testPlanner("undo and redo work after the page is loaded again", {}, async (tab) => {
  const reload = async (count) => {
    await tab.page.reload();
    await tab.until(() => window.shelfbeamPlanner?.planner.document.isReady);
    await tab.steps(count);
  };
  await tab.click(10, 9.85);
  await tab.press("Shift+ArrowUp");
  await tab.steps(1);
  await tab.press("Delete");
  await tab.steps(2);
  const { text } = tab.server;
  await reload(2);
  equal(await tab.labels(), ["Move A3", "Delete A3"]);
  await tab.press("Control+z");
  await tab.steps(1);
  await reload(1);
  await tab.press("Control+z");
  await tab.steps(0);
  check(tab.server.text === tab.server.first, "undo brings the first store back");
  await reload(0);
  await tab.press("Control+y");
  await tab.steps(1);
  await tab.press("Control+y");
  await tab.steps(2);
  check(tab.server.text === text, "redo brings the last store back");
});
