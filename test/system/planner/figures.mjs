// Measures the page of the planner: the time from the first request to the first drawn frame, and the script of a pointer
// event in a shop of 500 fixtures. Prints a table, and fails if a limit is exceeded.
//
// node figures.mjs SHELFBEAM PACKAGES EXAMPLES

import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";

import { parse } from "./jsonc.mjs";
import { serve } from "./server.mjs";

const [program, packages, examples] = process.argv.slice(2);
const { chromium } = createRequire(`${packages}/`)("playwright-core");

const firstFrame = 1000; // ms, of the grocery
const pointerEvent = 16; // ms of script, for 95 % of all events

async function serveExample(name, prepare = () => {}) {
  const folder = mkdtempSync(join(tmpdir(), "shelfbeam-figures-"));
  cpSync(join(examples, name), folder, { recursive: true });
  prepare(join(folder, "store.json"));
  const { address, pid, end } = await serve(program, folder, "--no-light");
  return { address, pid, end: () => end().then(() => rmSync(folder, { recursive: true })) };
}

async function timeOfFirstFrame(name) {
  const server = await serveExample(name);
  const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });
  const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
  await page.goto(server.address);
  let time;
  while (time === undefined) {
    await new Promise((resolve) => setTimeout(resolve, 50));
    time = await page.evaluate(() => performance.getEntriesByName("drawn")[0]?.startTime);
  }
  await browser.close();
  await server.end();
  return time;
}

/** 500 gondolas in a hall, each an element of its own. */
function fill(file) {
  const store = parse(readFileSync(file, "utf8"));
  const fixtures = Array.from({ length: 500 }, (_, k) => ({
    preset: "row",
    id: `A${k + 1}`,
    at: [2 + 4 * (k % 20), 2 + 2.4 * Math.floor(k / 20)],
    length: 3,
    labels: { count: 1 },
  }));
  writeFileSync(file, JSON.stringify({ ...store, room: { ...store.room, size: [84, 64, 4] }, fixtures }));
}

/** The script of pointer events in ms, of 95 % of them at most: with a tool that draws, and while a fixture is dragged. */
async function timesOfPointer() {
  const server = await serveExample("grocery", fill);
  const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });
  const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
  await page.goto(server.address);
  await page.waitForTimeout(2000);
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable");
  const script = async () => {
    const { metrics } = await session.send("Performance.getMetrics");
    return 1000 * metrics.find(({ name }) => name === "ScriptDuration").value;
  };
  const settled = () =>
    page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done()))));
  const found = [];
  const measure = async (moves = 60) => {
    const times = [];
    for (let k = 0; k < moves; ++k) {
      const before = await script();
      await page.mouse.move(420 + 6 * k, 250 + 3 * k);
      await settled();
      times.push((await script()) - before);
    }
    return times.sort((a, b) => a - b)[Math.floor(0.95 * moves)];
  };
  await page.mouse.click(640, 400);
  await page.keyboard.press("Escape");
  await page.keyboard.press("w");
  await page.mouse.click(420, 250);
  found.push(["while a wall is drawn", await measure()]);
  await page.keyboard.press("Escape");
  await page.keyboard.press("Escape");
  await page.keyboard.press("m");
  found.push(["while the measuring tool aims", await measure()]);
  await page.keyboard.press("Escape");
  await page.keyboard.press("Escape");
  const box = await page.evaluate(() => {
    const { planner } = window.shelfbeamPlanner;
    const [left, top] = planner.viewport.toScreen([43.5, 31.3]);
    const place = document.querySelector(".surface").getBoundingClientRect();
    return [place.left + left, place.top + top];
  });
  await page.mouse.move(...box);
  await page.mouse.down();
  found.push(["while a fixture is dragged", await measure()]);
  await page.keyboard.press("Escape");
  await page.mouse.up();
  await browser.close();
  await server.end();
  return found;
}

let failed = false;
const report = (what, value, limit) => {
  failed ||= value > limit;
  console.log(`${what.padEnd(76)} ${value.toFixed(1).padStart(8)} ms  at most ${limit} ms`);
};
report("grocery: from the first request to the first drawn frame", await timeOfFirstFrame("grocery"), firstFrame);
for (const [what, time] of await timesOfPointer())
  report(`500 fixtures: script of a pointer event, ${what}`, time, pointerEvent);
process.exit(failed ? 1 : 0);
