// Measures the planner: the processor time of an edit, and the time from the first request to the first drawn frame.
// Prints a table, and fails if a limit is exceeded.
//
// node figures.mjs SHELFBEAM PACKAGES EXAMPLES

import { spawn } from "node:child_process";
import { cpSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";

const [program, packages, examples] = process.argv.slice(2);
const require = createRequire(`${packages}/`);
const WebSocket = require("ws");
const { chromium } = require("playwright-core");

const edits = 30;
const limits = { grocery: 10, supermarket: 40, hypermarket: 200 }; // ms of processor time for an edit
const firstFrame = 1000; // ms, of the grocery

// The processor time of a process so far, in ms.
function processorTime(pid) {
  const fields = readFileSync(`/proc/${pid}/stat`, "utf8").split(") ")[1].split(" ");
  return 10 * (Number(fields[11]) + Number(fields[12]));
}

async function serve(name) {
  const folder = mkdtempSync(join(tmpdir(), "shelfbeam-figures-"));
  cpSync(join(examples, name), folder, { recursive: true });
  const server = spawn(program, ["serve", folder, "--no-browser", "--json"]);
  const address = await new Promise((resolve) => {
    let out = "";
    server.stdout.on("data", (bytes) => {
      out += bytes;
      if (out.includes("}")) resolve(JSON.parse(out).address);
    });
  });
  const end = () => {
    server.kill("SIGINT");
    return new Promise((resolve) => server.on("exit", resolve)).then(() => rmSync(folder, { recursive: true }));
  };
  return { address, pid: server.pid, end };
}

// A page without a browser.
class Tab {
  constructor(address) {
    this.answers = new Map();
    this.next = 0;
    this.socket = new WebSocket(`${address.replace("http", "ws")}socket`, { origin: new URL(address).origin });
    this.project = new Promise((resolve) => {
      this.socket.on("message", (data, isBinary) => {
        if (isBinary) return;
        const message = JSON.parse(data);
        if (message.event === "project") resolve(message);
        else if (!message.event) this.answers.get(message.id)(message);
      });
    });
  }

  async ask(request) {
    const id = ++this.next;
    const answer = new Promise((resolve) => this.answers.set(id, resolve));
    this.socket.send(JSON.stringify({ id, ...request }));
    const { error } = await answer;
    if (error) throw new Error(error.message);
  }
}

/** The path and the value of the first number whose path fits. */
function numberAt(json, pattern, path = "") {
  if (typeof json === "number") return pattern.test(path) ? [path, json] : null;
  if (typeof json !== "object" || json === null) return null;
  for (const [key, value] of Object.entries(json)) {
    const found = numberAt(value, pattern, `${path}/${key}`);
    if (found) return found;
  }
  return null;
}

/** What people change, and the number of the store that stands for it. */
const changes = {
  place: /^\/fixtures\/\d+\/at\/0$/,
  preset: /^\/presets\/[^/]+\/(length|depth|height)$/,
  material: /^\/materials\/[^/]+\/(reflectance|ior|eta|roughness)$/,
  "label type": /^\/label_types\//,
  room: /^\/room\/(size\/2|height)$/,
};

/** Milliseconds for each kind of edit. */
async function timesOfEdits(name) {
  const server = await serve(name);
  const tab = new Tab(server.address);
  const { json } = await tab.project;
  const times = [];
  // The search for warnings begins after each pause of 0.3 s; it is a process of its own.
  for (const [kind, pattern] of Object.entries(changes)) {
    const found = numberAt(json, pattern);
    if (!found) continue;
    const [path, first] = found;
    let before = first;
    const [cpu, wall] = [processorTime(server.pid), performance.now()];
    for (let k = 0; k < edits; ++k) {
      const after = before === first ? first * 1.001 : first;
      await tab.ask({ do: "edit", label: kind, ops: [{ path, before, after }] });
      before = after;
    }
    times.push({
      kind,
      cpu: (processorTime(server.pid) - cpu) / edits,
      wall: (performance.now() - wall) / edits,
    });
  }
  tab.socket.close();
  await server.end();
  return times;
}

async function timeOfFirstFrame(name) {
  const server = await serve(name);
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

let failed = false;
const report = (what, value, limit) => {
  failed ||= value > limit;
  console.log(`${what.padEnd(76)} ${value.toFixed(1).padStart(8)} ms  at most ${limit} ms`);
};
for (const [name, limit] of Object.entries(limits))
  for (const { kind, cpu, wall } of await timesOfEdits(name))
    report(`${name}: processor time of an edit, ${kind} (on the disk after ${wall.toFixed(0)} ms)`, cpu, limit);
report("grocery: from the first request to the first drawn frame", await timeOfFirstFrame("grocery"), firstFrame);
process.exit(failed ? 1 : 0);
