// From an empty folder and a scan of the grocery's floor plan to a certified plan.

import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { pixelOf, scannedPlan } from "../../data/scanned_plan.mjs";
import { check, equal, test } from "../viewer/check.mjs";
import { drop, shown } from "./floor_plan.mjs";
import { wait } from "./light.mjs";
import { Tracer } from "./tracer.mjs";

const actions = 68; // the number in docs/planner.md, without the plan
/** Of the example grocery: as many as its own plan needs, proven. */
const [labels, units] = [686, 4];

/** The outlines that a server resolves, in m. */
const partsOf = (tab) =>
  tab.page.evaluate(() =>
    window.shelfbeamPlanner.planner.document.parts.all.map(({ kind, id, outline }) => ({ kind, id, outline })),
  );

async function drawRows(person) {
  await person.take("g");
  await person.choose("tool/Preset", "gondola 1.00 m, double, 1.6 m high");
  await person.click([5, 5.05]);
  await person.click([17, 5.05]);
  await person.fill("field/depth", "0.9");
  await person.fill("field/height", "2");
  await person.fill("field/shelves", "0.35, 0.8, 1.25, 1.7");
  await person.fill("field/labels/spacing", "80cm");
  await person.take("n");
  await person.type("4", "Enter");
  await person.click([11, 7.45]);
}

async function drawEnds(person) {
  await person.take("g");
  await person.choose("tool/Preset", "end cap 0.94 m, 1.6 m high");
  await person.click([5, 5.5]);
  await person.click([5, 4.6]);
  await person.fill("field/length", "0.9");
  await person.fill("field/depth", "0.45");
  await person.fill("field/shelves", "0.5, 1.0");
  await person.fill("field/labels/spacing", "0.9");
  await person.take("n");
  await person.type("4", "Enter");
  await person.click([4.775, 7.45]);
  await person.take("g");
  await person.click([17, 4.6]);
  await person.click([17, 5.5]);
  await person.take("n");
  await person.type("4", "Enter");
  await person.click([17.225, 7.45]);
}

async function drawWalls(person) {
  await person.take("g");
  await person.choose("tool/Preset", "wall shelving 1.00 m, 2.2 m high");
  await person.click([21.5, 17.95]);
  await person.click([1.5, 17.95]);
  await person.fill("field/depth", "0.55");
  await person.fill("field/shelves", "0.4, 0.85, 1.3, 1.75");
  await person.fill("field/labels/spacing", "1");
  await person.click([0.05, 15.5]);
  await person.click([0.05, 5.5]);
}

async function drawTheRest(person) {
  await person.choose("tool/Preset", "freezer island 2.10 m, glass lid");
  await person.click([6, 15]);
  await person.click([16, 15]);
  await person.fill("field/length", "10");
  await person.fill("field/depth", "1.6");
  await person.fill("field/height", "0.9");
  await person.fill("field/labels/spacing", "0.8");
  await person.choose("field/doors", "none");

  await person.choose("tool/Preset", "produce table 1.25 m, double, 1.1 m high");
  await person.click([19.6, 6]);
  await person.click([19.6, 11]);
  await person.fill("field/height", "1.3");
  await person.fill("field/shelves", "0.45, 0.9");
  await person.fill("field/labels/spacing", "1");
  await person.take("n");
  await person.click([22.7, 8.5]);

  await person.take("g");
  await person.choose("tool/Preset", "check-out 3.60 m, with belt");
  await person.click([4.5, 2.3]);
  await person.click([7.9, 2.3]);
  await person.take("n");
  await person.type("3", "Enter");
  await person.click([10.7, 2.3]);

  await person.take("b");
  await person.choose("tool/Kind", "Column up to the ceiling");
  for (const [x, y] of [
    [2.5, 3.5],
    [18.4, 3.5],
    [2.5, 13.4],
    [18.4, 13.4],
  ])
    await person.drag([x, y], [x + 0.4, y + 0.4], { pixels: 200 });
  await person.take("k");
  await person.drag([20, 12.5], [23, 15]);
}

/** Rows of the traced shop have other numbers, so the nearest outline is the same fixture. */
function compare(found, expected, isMeant) {
  const shelves = (parts) => parts.filter(({ kind, id }) => kind === "room" || (kind === "fixture" && isMeant(id)));
  const middle = ({ outline }) =>
    [0, 1].map((k) => outline.reduce((sum, corner) => sum + corner[k], 0) / outline.length);
  const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);
  const others = found.filter(({ kind }) => kind === "room" || kind === "fixture");
  let worst = { error: 0, id: "" };
  for (const part of shelves(expected)) {
    const same = others
      .filter(({ kind }) => kind === part.kind)
      .reduce((best, one) => (distance(middle(one), middle(part)) < distance(middle(best), middle(part)) ? one : best));
    for (const corner of part.outline) {
      const away = Math.min(...same.outline.map((other) => distance(other, corner)));
      // The scale line is the wall at y = 0.
      const error = away / (0.05 + 0.002 * corner[1]);
      if (error > worst.error) worst = { error, id: part.id || part.kind };
    }
  }
  return worst;
}

/** Plans the shop in the browser: two clicks. Returns the plan, whose files are complete. */
async function plan(tab, person, { folder }) {
  for (const place of ["#tab-plans", "#panel-plans .primary"]) {
    ++person.actions;
    await tab.page.click(place);
  }
  await wait(tab, () => window.shelfbeamPlanner.planner.plans.runs[0]?.state === "done");
  await tab.until(() => document.querySelector(".plan-result .files") !== null);
  const [report, sheet] = await tab.page.$$eval(".plan-result .files a", (links) => links.map(({ href }) => href));
  const read = async (address) => (await tab.page.request.get(address)).text();
  const placement = JSON.parse(readFileSync(join(folder, "plan", "placement.json"), "utf8"));
  equal(await read(report), readFileSync(join(folder, "plan", "report.html"), "utf8"), "report");
  const rows = (await read(sheet)).trim().split("\n");
  equal(rows.length, placement.count + 1, "rows of the mounting sheet");
  await tab.until(() => window.shelfbeamPlanner.planner.plans.runs[0].entered);
  equal(tab.json.transceivers.selected, placement.selected, "units in the shop");
  const { missed, undecided, not_verified_yet } = placement.certificate;
  equal([missed, undecided, not_verified_yet], [[], [], []], "certificate");
  return placement;
}

test("trace: from a scan to a certified plan", async (given) => {
  const example = await given.serve("grocery");
  const expected = await partsOf(await given.tab(example));
  const scan = await scannedPlan(given.tools.browser, "Corner grocery", expected);
  writeFileSync(join(given.tools.pictures, "scan.png"), scan);

  const shop = await given.serve(null);
  const tab = await given.tab(shop, { deviceScaleFactor: 1.25 });
  const person = new Tracer(tab, pixelOf);
  const pictures = async (name) => {
    await tab.press("f");
    await tab.picture(`trace-${name}`);
  };
  await drop(tab, "scan.png", scan);
  ++person.actions;
  await shown(tab);
  await person.click([0, 0]);
  await person.click([25, 0]);
  await person.type("25", "Enter");
  await person.click([0, 0]);
  await person.click([0, 18]);
  await person.type("18", "Enter");
  await pictures("scale");
  check(tab.json.drawing.check, "the scale is checked");
  await person.take("r");
  for (const corner of [
    [0, 0],
    [25, 0],
    [25, 18],
    [0, 18],
  ])
    await person.click(corner); // prettier-ignore
  await tab.press("Enter");
  await person.fill("field/size/2", "3.6");
  await drawRows(person);
  await pictures("rows");
  await drawEnds(person);
  await drawWalls(person);
  await drawTheRest(person);
  await tab.press("Escape", "Escape");
  await pictures("done");
  equal(tab.errors, [], "errors in the console");

  console.log(`        ${person.actions} actions`);
  equal(person.actions, actions, "actions");
  equal(tab.json.transceivers.keep_out?.length, 1, "areas without candidates");
  const found = await partsOf(tab);
  const worst = compare(found, expected, (id) => /^[AWP]/.test(id));
  console.log(`        largest error: ${(100 * worst.error).toFixed(0)} % of the tolerance, of ${worst.id}`);
  check(worst.error <= 1, "outlines are beside their tolerance");
  const moved = found.map((part) => ({ ...part, outline: part.outline.map(([x, y]) => [x + 0.1, y]) }));
  check(compare(moved, expected, (id) => /^A/.test(id)).error > 1, "negative control: a shop that is 10 cm off");

  const traced = await plan(tab, person, shop);
  await pictures("planned");
  console.log(`        ${person.actions} actions with the plan`);
  equal(traced.labels, labels, "labels");
  equal([traced.count, traced.certificate.count_lower_bound], [units, units], "units");
});

test("trace: from a scan of an L-shaped shop to a certified plan", async (given) => {
  const corners = [
    [0, 0],
    [12, 0],
    [12, 6],
    [7, 6],
    [7, 10],
    [0, 10],
  ];
  const row = (id, y, length) => ({
    kind: "fixture",
    id,
    outline: [
      [2, y - 0.5],
      [2 + length, y - 0.5],
      [2 + length, y + 0.5],
      [2, y + 0.5],
    ], // prettier-ignore
  });
  const parts = [{ kind: "room", id: "", outline: corners }, row("A", 3, 8), row("B", 8, 3)];
  const scan = await scannedPlan(given.tools.browser, "Corner shop", parts);
  const shop = await given.serve(null);
  const tab = await given.tab(shop);
  const person = new Tracer(tab, pixelOf);
  await drop(tab, "scan.png", scan);
  await shown(tab);
  for (const [from, to, length] of [
    [[0, 0], [12, 0], "12"],
    [[0, 0], [0, 10], "10"],
  ]) {
    await person.click(from);
    await person.click(to);
    await person.type(length, "Enter");
  }
  await person.take("r");
  for (const corner of corners) await person.click(corner);
  await tab.press("Enter");
  await person.fill("field/height", "3");
  await person.take("g");
  await person.choose("tool/Preset", "gondola 1.00 m, double, 1.6 m high");
  await person.click([2, 3]);
  await person.click([10, 3]);
  await person.fill("field/labels/spacing", "0.8");
  await person.take("g");
  await person.click([2, 8]);
  await person.click([5, 8]);
  await tab.press("Escape", "Escape");
  equal(tab.json.room.outline?.length, 6, "corners");
  const planned = await plan(tab, person, shop);
  check(planned.count >= 1 && planned.labels > 50, `${planned.count} units for ${planned.labels} labels`);
  await tab.press("f");
  await tab.picture("trace-corner-shop");
  equal(tab.errors, [], "errors in the console");
});
