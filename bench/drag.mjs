// Measures the drag of a unit in the planner: the time from an event of the pointer to recoloured labels, and its parts.
// Prints the distribution, and fails if 5 % of the events wait longer than the limit.
//
// node bench/drag.mjs SHELFBEAM PACKAGES EXAMPLE [LIMIT] [--without-drawing]
//
// Without a graphics card, the browser draws marks on the processor, which then lacks the time for columns.
// --without-drawing omits the drawing of marks, as if a graphics card did it.
//
// PACKAGES: the node_modules of the pages in the build folder. EXAMPLE: "supermarket" has 5,000 labels, "hypermarket"
// 40,000. LIMIT: ms; 100 by default. Nothing else should run on the machine.

import { spawnSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";

import { serve } from "../test/system/planner/server.mjs";

const options = process.argv.slice(2);
const isDrawn = !options.includes("--without-drawing");
const [program, packages, example = "supermarket", limit = "100"] = options.filter((one) => !one.startsWith("--"));
const { chromium } = createRequire(`${packages}/`)("playwright-core");

const moves = 300;
const interval = 16; // ms between events of the pointer
const patience = 15 * 60_000; // ms, for the light of the shop

/** Runs in the page: notes when requests are sent, answers come, and labels are recoloured. */
function instrument() {
  const seen = new Map(); // by the id of the request
  window.dragTimes = seen;
  window.dragEvents = [];
  let moved = 0;
  window.addEventListener(
    "pointermove",
    ({ timeStamp }) => {
      moved = timeStamp;
      window.dragEvents.push(timeStamp);
    },
    true,
  );
  const Socket = window.WebSocket;
  window.WebSocket = class extends Socket {
    constructor(...given) {
      super(...given);
      this.addEventListener("message", ({ data }) => {
        if (typeof data === "string") return;
        const now = performance.now();
        const size = new DataView(data).getUint32(0, true);
        const { about } = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, size)));
        if (about.event === "drag")
          Object.assign(seen.get(about.id) ?? {}, {
            received: now,
            column: about.column_ms,
            stage: about.stage,
          });
      });
    }

    send(text) {
      const { id, do: what } = JSON.parse(text);
      if (what === "drag") seen.set(id, { moved, sent: performance.now() });
      super.send(text);
    }
  };
  new PerformanceObserver((list) => {
    for (const { startTime, detail } of list.getEntriesByName("recoloured")) {
      const drag = detail.id === null ? null : seen.get(detail.id);
      if (!drag || drag.recoloured) continue;
      drag.recoloured = startTime;
      requestAnimationFrame((next) => (drag.next = next));
    }
  }).observe({ entryTypes: ["mark"] });
}

const folder = mkdtempSync(join(tmpdir(), "shelfbeam-drag-"));
spawnSync(program, ["new", example, join(folder, "shop"), "--quiet"], { stdio: "inherit" });
const server = await serve(program, join(folder, "shop"));
// Without a graphics card, the browser paints the page several times faster by itself.
const software = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-gpu-rasterization"];
const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", ...software, "--disable-gpu-compositing"],
});
const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
await page.addInitScript(instrument);
if (!isDrawn)
  await page.addInitScript(() => {
    for (const call of ["drawElements", "drawElementsInstanced", "drawArrays", "drawArraysInstanced"])
      WebGL2RenderingContext.prototype[call] = () => {};
    const unmaskedRenderer = 0x9246; // of WEBGL_debug_renderer_info
    WebGL2RenderingContext.prototype.getParameter = new Proxy(WebGL2RenderingContext.prototype.getParameter, {
      apply: (known, context, [name]) =>
        [context.RENDERER, unmaskedRenderer].includes(name) ? "a graphics card" : known.call(context, name),
    });
  });
await page.goto(server.address);
const sleep = (ms) => new Promise((done) => setTimeout(done, ms));
const until = async (condition) => {
  for (const end = Date.now() + patience; ; await sleep(50)) {
    if (await page.evaluate(condition)) return;
    if (Date.now() > end) throw new Error(`did not happen: ${condition}`);
  }
};
await until(() => window.shelfbeamPlanner?.planner.document.isReady);

// The candidates nearest to nine places of the room are switched on; the middle one is dragged.
const begun = performance.now();
const place = await page.evaluate(async () => {
  const { planner } = window.shelfbeamPlanner;
  const { lower, upper } = planner.wholeBounds;
  const { units } = planner.document;
  const nearest = (x, y) => {
    let [found, least] = [0, Infinity];
    for (let index = 0; index < units.count; ++index) {
      const [u, v] = units.at(index);
      const away = Math.hypot(u - x, v - y);
      if (away < least) [found, least] = [index, away];
    }
    return found;
  };
  const shares = [1 / 6, 1 / 2, 5 / 6];
  let middle = 0;
  for (const x of shares)
    for (const y of shares) {
      const index = nearest(lower[0] + x * (upper[0] - lower[0]), lower[1] + y * (upper[1] - lower[1]));
      if (x === 1 / 2 && y === 1 / 2) middle = index;
      await planner.document.ask("unit", { action: "switch", index, on: true, label: "Switch on" }, "");
    }
  return units.at(middle).slice(0, 2);
});
await until(() => {
  const { light } = window.shelfbeamPlanner.planner;
  return light.stage !== null && light.stage !== "direct";
});
const covered = performance.now();
await until(() => window.shelfbeamPlanner.planner.light.event?.operator === "fine");

const [x, y] = await page.evaluate(([u, v]) => {
  const [left, top] = window.shelfbeamPlanner.planner.viewport.toScreen([u, v]);
  const box = document.querySelector(".surface").getBoundingClientRect();
  return [box.left + left, box.top + top];
}, place);
await page.mouse.click(x, y); // selects it
await page.mouse.move(x, y);
await page.mouse.down();
await page.mouse.move(x + 8, y + 4, { steps: 4 });
await sleep(1000); // the refinement rests
await page.evaluate(() => {
  window.dragTimes.clear();
  window.dragEvents.length = 0;
});
const session = await page.context().newCDPSession(page);
await session.send("Performance.enable");
const script = async () => {
  const { metrics } = await session.send("Performance.getMetrics");
  return 1000 * metrics.find(({ name }) => name === "ScriptDuration").value;
};
const at = (k) => [x + 120 * Math.sin(k / 20), y + 60 * Math.sin(k / 13)];
for (let k = 0; k < moves; ++k) {
  const wait = sleep(interval);
  await page.mouse.move(...at(k));
  await wait;
}
await sleep(1000);
const drags = (await page.evaluate(() => [...window.dragTimes.values()])).filter(({ recoloured }) => recoloured);
// An event during a request waits for the answer to a later one.
const waits = (await page.evaluate(() => window.dragEvents)).flatMap((event) => {
  const answer = drags.find(({ moved }) => moved >= event);
  return answer ? [answer.recoloured - event] : [];
});
const frames = [];
for (let k = 0; k < 60; ++k) {
  const before = await script();
  await page.mouse.move(...at(k));
  await sleep(150);
  frames.push((await script()) - before);
}
await page.mouse.up();
await browser.close();
await server.end();
rmSync(folder, { recursive: true });

const quantiles = [0.5, 0.75, 0.9, 0.95, 0.99, 1];
const line = (what, values) => {
  const sorted = [...values].sort((a, b) => a - b);
  const found = quantiles.map((q) => sorted[Math.min(sorted.length - 1, Math.floor(q * sorted.length))]);
  console.log(what.padEnd(52) + found.map((value) => value.toFixed(1).padStart(8)).join(""));
  return found[3];
};
console.log(
  `${example}${isDrawn ? "" : ", marks are not drawn"}: ${drags.length} answers to ${moves} events of the pointer; ms`,
);
const coarse = drags.filter(({ stage }) => stage === "coarse").length;
console.log(`${coarse} answers by the coarse operator`);
console.log(`first coverage ${((covered - begun) / 1000).toFixed(1)} s after the first unit was switched on`);
console.log(" ".repeat(52) + quantiles.map((q) => (q === 1 ? "max" : `${100 * q} %`).padStart(8)).join(""));
const whole = line("from any event of the pointer to recoloured labels", waits);
line(
  "from the event that a request carries",
  drags.map(({ moved, recoloured }) => recoloured - moved),
);
line(
  "  until the request is sent",
  drags.map(({ moved, sent }) => sent - moved),
);
line(
  "  column",
  drags.map(({ column }) => column),
);
line(
  "  transport",
  drags.map(({ sent, received, column }) => received - sent - column),
);
line(
  "  sums, verdicts, marks and drawing commands",
  drags.map(({ received, recoloured }) => recoloured - received),
);
line(
  "then until the next frame (software drawing)",
  drags.flatMap(({ recoloured, next }) => (next ? [next - recoloured] : [])),
);
line("script of the page per event of the pointer", frames);
process.exitCode = whole > Number(limit) ? 1 : 0;
