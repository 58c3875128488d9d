// Tests emission profiles, meshes and measured signals that are dropped on the page.

import { existsSync, mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";

import { check, equal, says } from "../viewer/check.mjs";
import { drop } from "./floor_plan.mjs";
import { testPlanner } from "./opened.mjs";
import { smallShop } from "./shops.mjs";

const example = (name) => readFileSync(new URL(`../../../examples/chiller/${name}`, import.meta.url));

/** Drops a file; its dialog, or the part with a selector in it, is there. */
async function open(tab, name, body, selector) {
  await drop(tab, name, body);
  await tab.until((of) => document.querySelector(`.dialog.${of}`) !== null, selector);
}

testPlanner("device: profiles become transceiver types with their polar pictures", { smoke: true }, async (tab) => {
  await open(tab, "Wide beam.ies", example("batwing.ies"), "profile");
  says(await tab.text(".dialog h2"), "Transceiver type from Wide-beam.ies");
  equal(await tab.count(".dialog .polar .curve"), 2);
  await tab.page.keyboard.type("ceiling"); // which exists
  await tab.press("Enter");
  says(await tab.text(".dialog .problem"), "Give a name that no other transceiver type has.");
  await tab.fill("profile-name", "wide");
  check(!(await tab.has(".dialog.profile")), "the dialog is gone");
  await tab.steps(1);
  const { wide, ceiling } = tab.json.transceiver_types;
  equal(wide.emission, { type: "ies", file: "Wide-beam.ies", flux: 1 });
  equal(wide.cost, ceiling.cost, "the price is that of the model");
  await tab.until(() => document.querySelector(".properties .polar") !== null);
  equal(await tab.problems(), []);
  await tab.page.focus(".properties");
  // The same file again has the same name; another one never replaces it.
  await open(tab, "Wide beam.ies", Buffer.concat([example("batwing.ies"), Buffer.from("\n")]), "profile");
  says(await tab.text(".dialog h2"), "Transceiver type from Wide-beam-2.ies");
  await tab.press("Escape");
  await open(tab, "narrow.ldt", example("narrow-aisle.ldt"), "profile");
  await tab.press("Enter");
  await tab.steps(2);
  equal(tab.json.transceiver_types.narrow.emission.type, "eulumdat");
});

testPlanner("device: meshes become fixtures, and broken ones are not kept", {}, async (tab) => {
  const unit = () => tab.text('[data-key="mesh-unit"] option:checked');
  await open(tab, "till.glb", example("till.glb"), "mesh");
  says(await unit(), "m: 2.66 × 1.77 × 1.42 m");
  check(await tab.has('[data-key="mesh-add"]:disabled'), "materials are missing");
  for (const name of ["CounterBody", "CounterTop", "BrushedSteel", "BlackPlastic", "ScreenGlass", "JarGlass"])
    await tab.choose(`mesh-material/${name}`, "steel");
  await tab.use("mesh-add");
  await tab.steps(1);
  const fixture = tab.json.fixtures.at(-1);
  equal([fixture.type, fixture.id, fixture.file, fixture.at[2]], ["mesh", "M1", "till.glb", 0]);
  equal(fixture.materials.CounterBody, "steel");
  equal(Object.keys(fixture.materials).length, 6);
  equal(await tab.selected(), [`/fixtures/${tab.json.fixtures.length - 1}`]);
  equal(await tab.problems(), []);
  // 2 m x 1 m x 0.8 m in millimetres, with y up.
  const table = "v 0 0 0\nv 2000 0 0\nv 2000 800 1000\nv 0 800 1000\nf 1 2 3\nf 1 3 4\n";
  await open(tab, "table.obj", Buffer.from(table), "mesh");
  await tab.choose("mesh-up", "y");
  await tab.choose("mesh-material/", "steel");
  says(await unit(), "mm: 2 × 1 × 0.8 m");
  await tab.use("mesh-add");
  await tab.steps(2);
  const placed = tab.json.fixtures.at(-1);
  equal([placed.scale, placed.up, placed.materials], [0.001, "y", { "*": "steel" }]);
  const outline = await tab.state(({ planner }) => planner.document.parts.all.find(({ id }) => id === "M2").outline);
  const sides = [0, 1].map((k) => {
    const values = outline.map((point) => point[k]);
    return Number((Math.max(...values) - Math.min(...values)).toFixed(6));
  });
  equal(sides, [2, 1]);
  await drop(tab, "cut.obj", Buffer.from("v 1 2\nf 1 2 3\n"));
  await tab.notice("a coordinate is missing");
  check(!existsSync(join(tab.server.folder, "cut.obj")), "it is not kept");
  tab.errors.length = 0; // of the refused file
});

const quick = { store: "thesis", prepare: smallShop() };

/** A coarse plan, so that measurements have something to be compared with. */
async function plan(given, { folder }) {
  mkdirSync(join(folder, "plan"));
  const [signals, placement] = ["signal.h5", "placement.json"].map((name) => join(folder, "plan", name));
  await given.run("simulate", join(folder, "store.json"), "-o", signals, "--samples", "64", "--quiet");
  await given.run("place", signals, "-o", placement, "--time-limit", "5", "--quiet");
}

testPlanner("device: measured signals are compared with the newest plan", quick, async (tab, given) => {
  const measured = (text, selector) => open(tab, "measured.csv", Buffer.from(text), `comparison ${selector}`);
  await measured("label,transceiver,signal\nA1-front-1-1,T0-0,1\n", ".problem");
  says(await tab.text(".dialog .content"), "the folder of the project has no plan");
  await tab.press("Escape");
  await plan(given, tab.server);
  const rows = Array.from({ length: 8 }, (_, k) => `A1-front-${1 + (k % 2)}-${1 + (k >> 1)};${k + 20},5`);
  await measured(["label;signal", ...rows].join("\n"), "table");
  says(await tab.text(".dialog .content"), "8 signals compared with the plan “plan”.");
  check(existsSync(join(tab.server.folder, "comparison/comparison.html")), "the page of the comparison");
  await tab.press("Escape");
  await measured("label,signal\nnobody,1\n", ".problem");
  says(await tab.text(".dialog .content"), "measured-3.csv", "has no label 'nobody'");
  await tab.press("Escape");
  check(await tab.isUntouched(), "the store is untouched");
});
