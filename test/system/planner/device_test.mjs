// Tests emission profiles and meshes that are dropped on the page.

import { spawnSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

import { check, equal, says } from "../viewer/check.mjs";
import { drop } from "./floor_plan.mjs";
import { testPlanner } from "./opened.mjs";

const example = (name) => readFileSync(fileURLToPath(new URL(`../../../examples/chiller/${name}`, import.meta.url)));
const opened = (tab, kind) => tab.until((of) => document.querySelector(`.dialog.${of}`) !== null, kind);
const notice = (tab, words) =>
  tab.until((part) => document.querySelector(".notice").textContent.replaceAll("\u00a0", " ").includes(part), words);

testPlanner("device: profiles become transceiver types with their polar pictures", { smoke: true }, async (tab) => {
  await drop(tab, "Wide beam.ies", example("batwing.ies"));
  await opened(tab, "profile");
  says(await tab.text(".dialog h2"), "Transceiver type from Wide-beam.ies");
  equal(await tab.page.evaluate(() => document.querySelectorAll(".dialog .polar .curve").length), 2);
  await tab.page.keyboard.type("ceiling"); // which exists
  await tab.press("Enter");
  says(await tab.text(".dialog .problem"), "Give a name that no other transceiver type has.");
  await tab.fill("profile-name", "wide");
  equal(await tab.page.$(".dialog.profile"), null);
  await tab.steps(1);
  const { wide, ceiling } = tab.json.transceiver_types;
  equal(wide.emission, { type: "ies", file: "Wide-beam.ies", flux: 1 });
  equal(wide.cost, ceiling.cost, "the price is that of the model");
  await tab.until(() => document.querySelector(".properties .polar") !== null);
  equal(await tab.page.evaluate(() => window.shelfbeamPlanner.planner.document.problems), []);
  await tab.page.evaluate(() => document.querySelector(".properties").focus());
  // The same file again has the same name; another one never replaces it.
  await drop(tab, "Wide beam.ies", Buffer.concat([example("batwing.ies"), Buffer.from("\n")]));
  await opened(tab, "profile");
  says(await tab.text(".dialog h2"), "Transceiver type from Wide-beam-2.ies");
  await tab.press("Escape");
  await drop(tab, "narrow.ldt", example("narrow-aisle.ldt"));
  await opened(tab, "profile");
  await tab.press("Enter");
  await tab.steps(2);
  equal(tab.json.transceiver_types.narrow.emission.type, "eulumdat");
});

testPlanner("device: meshes become fixtures with materials and a unit", {}, async (tab) => {
  await drop(tab, "till.glb", example("till.glb"));
  await opened(tab, "mesh");
  says(await tab.text('[data-key="mesh-unit"] option:checked'), "m: 2.66 × 1.77 × 1.42 m");
  check(
    await tab.page.evaluate(() => document.querySelector('[data-key="mesh-add"]').disabled),
    "materials are missing",
  );
  for (const name of ["CounterBody", "CounterTop", "BrushedSteel", "BlackPlastic", "ScreenGlass", "JarGlass"])
    await tab.choose(`mesh-material/${name}`, "steel");
  await tab.push('[data-key="mesh-add"]');
  await tab.steps(1);
  const fixture = tab.json.fixtures.at(-1);
  equal([fixture.type, fixture.id, fixture.file, fixture.at[2]], ["mesh", "M1", "till.glb", 0]);
  equal(fixture.materials.CounterBody, "steel");
  equal(Object.keys(fixture.materials).length, 6);
  equal(await tab.selected(), [`/fixtures/${tab.json.fixtures.length - 1}`]);
  equal(await tab.page.evaluate(() => window.shelfbeamPlanner.planner.document.problems), []);
  // 2 m x 1 m x 0.8 m in millimetres, with y up.
  const table = "v 0 0 0\nv 2000 0 0\nv 2000 800 1000\nv 0 800 1000\nf 1 2 3\nf 1 3 4\n";
  await drop(tab, "table.obj", Buffer.from(table));
  await opened(tab, "mesh");
  await tab.choose("mesh-up", "y");
  await tab.choose("mesh-material/", "steel");
  says(await tab.text('[data-key="mesh-unit"] option:checked'), "mm: 2 × 1 × 0.8 m");
  await tab.push('[data-key="mesh-add"]');
  await tab.steps(2);
  const placed = tab.json.fixtures.at(-1);
  equal([placed.scale, placed.up, placed.materials], [0.001, "y", { "*": "steel" }]);
  const [part] = await tab.page.evaluate(() =>
    window.shelfbeamPlanner.planner.document.parts.all.filter(({ id }) => id === "M2").map(({ outline }) => outline),
  );
  const [x, y] = [0, 1].map(
    (k) => Math.max(...part.map((point) => point[k])) - Math.min(...part.map((point) => point[k])),
  );
  check(Math.abs(x - 2) < 1e-6 && Math.abs(y - 1) < 1e-6, `${x} x ${y}`);
});

testPlanner("device: broken files are refused with the place, and are not kept", {}, async (tab) => {
  for (const [name, body, words] of [
    ["cut.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 2 3\n", "cut.ies: line 3: the file ends"],
    ["cut.ldt", "only one line", "cut.ldt: "],
    ["cut.obj", "v 1 2\nf 1 2 3\n", "a coordinate is missing"],
    ["cut.glb", "glTF....", "cut.glb"],
    ["empty.stl", "solid\nendsolid\n", "empty.stl"],
  ]) {
    await drop(tab, name, Buffer.from(body));
    await notice(tab, words);
    equal(await tab.page.$(".dialog"), null, name);
  }
  tab.errors.length = 0; // of refused files
  check(await tab.isUntouched(), "the store is untouched");
  const { status } = await tab.page.evaluate(async () => {
    const { status: found } = await fetch(`${location.href}files/cut.ies`);
    return { status: found };
  });
  equal(status, 404);
  tab.errors.length = 0;
});

/** A coarse plan, so that measurements have something to be compared with. */
function planned(folder) {
  const plan = join(folder, "plan");
  mkdirSync(plan);
  const [signals, placement] = [join(plan, "signal.h5"), join(plan, "placement.json")];
  for (const words of [
    ["simulate", join(folder, "store.json"), "-o", signals, "--samples", "64"],
    ["place", signals, "-o", placement, "--time-limit", "5"],
  ]) {
    const { status, stderr } = spawnSync(process.argv[2], [...words, "--quiet"], { encoding: "utf8" });
    equal(status, 0, stderr);
  }
}

testPlanner("device: measured signals are compared with the newest plan", { prepare: planned }, async (tab) => {
  const ids = Array.from({ length: 14 }, (_, k) => `A1-front-1-${k + 1}`);
  const table = ["label;signal", ...ids.map((id, k) => `${id};${k + 20},5`)];
  await drop(tab, "measured.csv", Buffer.from(table.join("\n")));
  await tab.until(() => document.querySelector(".dialog.comparison table") !== null);
  says(await tab.text(".dialog .content"), "14 signals compared with the plan “plan”.");
  check(existsSync(join(tab.server.folder, "comparison/comparison.html")), "the page of the comparison");
  await tab.press("Escape");
  await drop(tab, "measured.csv", Buffer.from("label,signal\nnobody,1\n"));
  await tab.until(() => document.querySelector(".dialog.comparison .problem") !== null);
  says(await tab.text(".dialog .content"), "measured-2.csv", "has no label 'nobody'");
  await tab.press("Escape");
  check(await tab.isUntouched(), "the store is untouched");
});

testPlanner("device: measured signals need a plan", {}, async (tab) => {
  await drop(tab, "measured.csv", Buffer.from("label,transceiver,signal\nA1-front-1-1,G1-1-1,1\n"));
  await tab.until(() => document.querySelector(".dialog.comparison .problem") !== null);
  says(await tab.text(".dialog .content"), "the folder of the project has no plan");
  await tab.press("Escape");
});
