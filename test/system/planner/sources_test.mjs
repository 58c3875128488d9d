// Tests values that come from other files.

import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { check, equal, says } from "../viewer/check.mjs";
import { testPlanner } from "./opened.mjs";
import { unitAt } from "./units.mjs";

const locked = "This comes from another file. Change it there.";

/** Labels and candidates from CSV files. */
function withFiles(folder) {
  const file = join(folder, "store.json");
  const text = readFileSync(file, "utf8")
    .replace("{", '{ "labels": { "csv": "labels.csv" },')
    .replace(/"transceivers":\s*\{/, '$& "list": { "csv": "units.csv" },');
  writeFileSync(file, text);
  const labels = ["poster,2,17.99,1.5,0,-1,0,standard", "stand,2.5,10,0.8,0,-1,0.5,standard"];
  writeFileSync(join(folder, "labels.csv"), ["id,x,y,z,nx,ny,nz,type", ...labels, ""].join("\n"));
  const units = ["over-door,3.2,8.2,3.5,0,0,-1,0,ceiling"];
  writeFileSync(join(folder, "units.csv"), ["id,x,y,z,ax,ay,az,roll_deg,type", ...units, ""].join("\n"));
}

async function staysLocked(tab, ...sources) {
  says(await tab.text(".properties"), "Comes from another file of the project, and is changed there.", ...sources);
  says(await tab.text(".status .hint"), "Locked");
  check(!(await tab.has('.properties [data-key^="field/"]')), "no field");
  for (const key of ["ArrowRight", "r", "Delete", "Control+d", "Shift+H"]) {
    await tab.hush();
    await tab.press(key);
    await tab.notice(locked);
  }
  check(await tab.isUntouched(), "the store is untouched");
}

testPlanner("labels and units of CSV files are locked, and name file and line", { prepare: withFiles }, async (tab) => {
  await tab.find("stand");
  await staysLocked(tab, "labels.csv", "3");
  await tab.press("Escape");
  await tab.click(2.5, 10);
  await tab.until(() => document.querySelector(".properties h2").textContent === "stand");
  await tab.drag([2.5, 10], [2.7, 10.2]);
  check(await tab.isUntouched(), "a drag");
  await tab.find("over-door");
  await staysLocked(tab, "units.csv", "2");
  equal(readFileSync(join(tab.server.folder, "labels.csv"), "utf8").split("\n").length, 4);
  // The list of units stays as it is.
  const isRefused = async () => {
    await tab.notice("The list of units is a file");
    await tab.hush();
  };
  await tab.press("Escape", "0", "u");
  await tab.click(12, 8.4);
  await isRefused();
  await tab.press("Escape");
  const { at } = await unitAt(tab, 12, 8);
  await tab.click(at[0], at[1]);
  await tab.drag([at[0], at[1]], [at[0] + 1, at[1]]);
  await isRefused();
  check(await tab.isUntouched(), "nothing is written");
  await tab.press("p");
  await tab.steps(1);
  equal(tab.json.transceivers.pinned.length, 1, "ids can be listed");
});

testPlanner("labels of a planogram are locked, and name file and line", { store: "market-hall" }, async (tab) => {
  await tab.find("4001686301272");
  says(await tab.text(".properties"), "planogram.csv", "3", "Wholemeal bread", "D1, front, board 1, at ");
  await tab.press("ArrowRight");
  await tab.until(() => document.querySelector(".notice").classList.contains("problem"));
  check(await tab.isUntouched(), "the store is untouched");
});
