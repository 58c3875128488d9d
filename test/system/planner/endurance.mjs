// A long day with the planner: rounds of gestures, placements and a reload of the page, with light. Prints the memory of
// the server and of the page after each tenth of the rounds, and fails if the second half of the rounds needs over 10 %
// more than the first, or if a file is left over.
//
// node endurance.mjs SHELFBEAM PACKAGES [ROUNDS]

import { mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

import { startBrowser } from "../viewer/browser.mjs";
import { randomFrom } from "./random.mjs";
import { serve } from "./server.mjs";
import { smallShop } from "./shops.mjs";
import { Tab } from "./tab.mjs";

const [program, packages, givenRounds = "50"] = process.argv.slice(2);

const rounds = Number(givenRounds);
const inRound = { gestures: 40, placements: 2 };
const growth = 1.1;

const random = randomFrom(1);
const oneOf = (list) => list[Math.floor(list.length * random())];

/** The memory of a process that is its own, in MB. */
function memoryOf(pid) {
  const found = /^RssAnon:\s+(\d+) kB/m.exec(readFileSync(`/proc/${pid}/status`, "utf8"));
  return Number(found[1]) / 1000;
}

const keys = [
  ...["ArrowRight", "ArrowLeft", "Shift+ArrowUp", "Shift+ArrowDown", "r", "Shift+R", "Control+z", "Control+y"],
  ...["f", "+", "-", "Escape", "Control+a", "p", "0", "1", "l", "d", "d", "F6"],
];
const lists = ["objects", "layers", "light", "plans", "types", "problems", "history"];

/** A drag, a click, the wheel, a key, or another list at the left. */
async function gesture({ mouse, keyboard }) {
  const place = () => [360 + 580 * random(), 120 + 500 * random()];
  const kind = Math.floor(5 * random());
  if (kind === 0) {
    await mouse.move(...place());
    await mouse.down();
    await mouse.move(...place(), { steps: 4 });
    await mouse.up();
  } else if (kind === 1) {
    await mouse.click(...place());
  } else if (kind === 2) {
    await mouse.move(...place());
    await mouse.wheel(0, random() < 0.5 ? -120 : 120);
  } else if (kind === 3) {
    await keyboard.press(oneOf(keys));
  } else {
    await tab.evaluate((id) => document.querySelector(id).click(), `#tab-${oneOf(lists)}`);
  }
}

/** Plans the shop as it was in the beginning: gestures may have left it without a room. */
async function placement() {
  const seed = Math.floor(1e6 * random());
  const count = await tab.state(async ({ planner: { plans, document: shop } }, number) => {
    const before = plans.runs.length;
    await shop.request("go", { position: 0 });
    await shop.request("plan", { plan: { seed: number, simulation: { samples: 256 }, certify: false } });
    return before + 1;
  }, seed);
  await tab.computes(({ planner }, of) => planner.plans.runs.filter(({ result }) => result).length === of, count);
  return tab.state(({ planner: { plans } }) => {
    const { state: ended, result } = plans.runs[0];
    return ended === "failed" ? `failed: ${result.message}` : ended;
  });
}

const work = mkdtempSync(join(tmpdir(), "shelfbeam-endurance-"));
const [folder, temporary] = ["shop", "tmp"].map((name) => join(work, name));
for (const made of [folder, temporary]) mkdirSync(made);
smallShop()(folder);
process.env.TMPDIR = temporary;
const server = await serve(program, folder);
const browser = await startBrowser(packages);
const tab = new Tab(await browser.newPage({ viewport: { width: 1280, height: 720 } }), { url: server.address });
await tab.open();
const session = await tab.page.context().newCDPSession(tab.page);
await session.send("Performance.enable");

async function heap() {
  await session.send("HeapProfiler.collectGarbage");
  const { metrics } = await session.send("Performance.getMetrics");
  return metrics.find(({ name }) => name === "JSHeapUsedSize").value / 1e6;
}

const memory = { server: [], page: [] };
const states = {};
for (let round = 1; round <= rounds; ++round) {
  for (let k = 0; k < inRound.gestures; ++k) await gesture(tab.page);
  await tab.page.keyboard.press("Escape");
  for (let k = 0; k < inRound.placements; ++k) {
    const ended = await placement();
    states[ended] = (states[ended] ?? 0) + 1;
  }
  memory.server.push(memoryOf(server.pid));
  memory.page.push(await heap());
  await tab.open();
  if (round % Math.max(1, rounds / 10) === 0)
    console.log(
      `round ${round}: server ${memory.server.at(-1).toFixed(1)} MB, page ${memory.page.at(-1).toFixed(1)} MB`,
    );
}
await browser.close();
await server.end();

const failures = tab.errors.map((message) => `error in the page: ${message}`);
for (const [name, values] of Object.entries(memory)) {
  const half = values.length / 2;
  const ratio = Math.max(...values.slice(half)) / Math.max(...values.slice(0, half));
  console.log(`${name}: the second half needs ${ratio.toFixed(2)} times the memory of the first`);
  if (ratio > growth) failures.push(`the ${name} grows`);
}
console.log(`${inRound.gestures * rounds} gestures, ${rounds} reloads, placements:`, JSON.stringify(states));
const kept = new Set(["history.jsonl", "plans.json", "lock", "coarse.operator", "light.operator"]);
const left = [
  ...readdirSync(temporary),
  ...readdirSync(join(folder, ".shelfbeam")).filter((name) => !kept.has(name)),
  ...readdirSync(folder).filter((name) => !/^(plan(-\d+)?|store\.json|\.shelfbeam)$/.test(name)),
];
if (left.length > 0) failures.push(`files left over: ${left.join(", ")}`);
rmSync(work, { recursive: true });
for (const failure of failures) console.log(`FAILED: ${failure}`);
process.exit(failures.length > 0 ? 1 : 0);
