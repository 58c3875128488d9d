// From an empty folder and a scan of the grocery's floor plan to a certified plan.

import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { pixelOf, scannedPlan } from "../../data/scanned_plan.mjs";
import { check, equal, test } from "../viewer/check.mjs";
import { drop, shown } from "./floor_plan.mjs";
import { points } from "./shapes.mjs";
import { Tracer } from "./tracer.mjs";

const actions = 68; // the number in docs/planner.md, without the plan
/** Of the example grocery: as many as its own plan needs, proven. */
const [labels, units] = [686, 4];

/** The outlines that a server resolves, in m. */
const partsOf = (tab) =>
  tab.state(({ planner }) => planner.document.parts.all.map(({ kind, id, outline }) => ({ kind, id, outline })));

/** Shelving: the preset, if it is another one; the ends of its line; fields; and the number and place of its copies. */
const shelving = [
  {
    preset: "gondola 1.00 m, double, 1.6 m high",
    line: "5,5.05 17,5.05",
    fields: { depth: "0.9", height: "2", shelves: "0.35, 0.8, 1.25, 1.7", "labels/spacing": "80cm" },
    copies: ["4", [11, 7.45]],
  },
  {
    preset: "end cap 0.94 m, 1.6 m high",
    line: "5,5.5 5,4.6",
    fields: { length: "0.9", depth: "0.45", shelves: "0.5, 1.0", "labels/spacing": "0.9" },
    copies: ["4", [4.775, 7.45]],
  },
  { line: "17,4.6 17,5.5", copies: ["4", [17.225, 7.45]] },
  {
    preset: "wall shelving 1.00 m, 2.2 m high",
    line: "21.5,17.95 1.5,17.95",
    fields: { depth: "0.55", shelves: "0.4, 0.85, 1.3, 1.75", "labels/spacing": "1" },
  },
  { line: "0.05,15.5 0.05,5.5" },
  {
    preset: "freezer island 2.10 m, glass lid",
    line: "6,15 16,15",
    fields: { length: "10", depth: "1.6", height: "0.9", "labels/spacing": "0.8" },
    doors: "none",
  },
  {
    preset: "produce table 1.25 m, double, 1.1 m high",
    line: "19.6,6 19.6,11",
    fields: { height: "1.3", shelves: "0.45, 0.9", "labels/spacing": "1" },
    copies: [null, [22.7, 8.5]],
  },
  { preset: "check-out 3.60 m, with belt", line: "4.5,2.3 7.9,2.3", copies: ["3", [10.7, 2.3]] },
];

async function drawShelving(person, { preset, line, fields = {}, doors, copies }) {
  await person.take("g");
  if (preset) await person.choose("tool/Preset", preset);
  await person.line(...points(line));
  for (const [key, words] of Object.entries(fields)) await person.fill(`field/${key}`, words);
  if (doors) await person.choose("field/doors", doors);
  if (!copies) return;
  const [number, place] = copies;
  await person.take("n");
  if (number) await person.type(number, "Enter");
  await person.click(place);
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
  await tab.computes(({ planner }) => planner.plans.runs[0]?.state === "done");
  await tab.until(() => document.querySelector(".plan-result .files") !== null);
  const [report, sheet] = await tab.page.$$eval(".plan-result .files a", (links) => links.map(({ href }) => href));
  const read = async (address) => (await tab.page.request.get(address)).text();
  const placement = JSON.parse(readFileSync(join(folder, "plan", "placement.json"), "utf8"));
  equal(await read(report), readFileSync(join(folder, "plan", "report.html"), "utf8"), "report");
  const rows = (await read(sheet)).trim().split("\n");
  equal(rows.length, placement.count + 1, "rows of the mounting sheet");
  await tab.reaches(({ planner }) => planner.plans.runs[0].entered);
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
  for (const [end, length] of [
    [[25, 0], "25"],
    [[0, 18], "18"],
  ]) {
    await person.line([0, 0], end);
    await person.type(length, "Enter");
  }
  await pictures("scale");
  check(tab.json.drawing.check, "the scale is checked");
  await person.take("r");
  for (const corner of points("0,0 25,0 25,18 0,18")) await person.click(corner);
  await tab.press("Enter");
  await person.fill("field/size/2", "3.6");
  for (const [k, one] of shelving.entries()) {
    await drawShelving(person, one);
    if (k === 0) await pictures("rows");
  }
  await person.take("b");
  await person.choose("tool/Kind", "Column up to the ceiling");
  for (const [x, y] of points("2.5,3.5 18.4,3.5 2.5,13.4 18.4,13.4"))
    await person.drag([x, y], [x + 0.4, y + 0.4], { pixels: 200 });
  await person.take("k");
  await person.drag([20, 12.5], [23, 15]);
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
