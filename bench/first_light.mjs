// Measures how soon the planner shows the light of a shop: the time from the last of some units that are switched on to
// the first values of all labels, and to simulated values of all units, beside `verify` of the same units.
// Prints the times, and fails if `verify` is earlier.
//
// node bench/first_light.mjs SHELFBEAM PACKAGES EXAMPLE [UNITS]
//
// PACKAGES: the node_modules of the pages in the build folder. UNITS: 20 by default, spread over the candidates.
// Nothing else should run on the machine.

import { spawnSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";

import { serve } from "../test/system/planner/server.mjs";

const [program, packages, example = "supermarket", units = "20"] = process.argv.slice(2);
const WebSocket = createRequire(`${packages}/`)("ws");

const folder = mkdtempSync(join(tmpdir(), "shelfbeam-light-"));
const store = join(folder, "shop", "store.json");
const run = (...given) => spawnSync(program, given, { encoding: "utf8" }).stdout;
run("new", example, join(folder, "shop"), "--quiet");
const { transceivers: candidates } = JSON.parse(run("inspect", store, "--json"));

const server = await serve(program, join(folder, "shop"));
const socket = new WebSocket(`${server.address.replace("http", "ws")}socket`, {
  origin: new URL(server.address).origin,
});
const answers = new Map();
const found = {}; // when values came first, ms
const stages = new Map(); // by the key of the unit
let begun = Infinity;
let keys = [];
let end;
const done = new Promise((resolve) => {
  end = resolve;
});
const note = (what) => {
  if (what in found) return;
  found[what] = performance.now() - begun;
  console.error(`${what}: ${(found[what] / 1000).toFixed(1)} s`);
};
const look = () => {
  if (begun === Infinity || keys.length < Number(units)) return;
  const all = (...some) => keys.every((key) => some.includes(stages.get(key)));
  if (all("coarse", "fine", "simulated")) note("first coverage");
  if (all("fine", "simulated")) note("fine previews");
  if (all("simulated")) note("simulated values");
};
await new Promise((resolve) => {
  socket.on("message", (data, isBinary) => {
    const size = isBinary ? data.readUInt32LE(0) : 0;
    const message = isBinary ? JSON.parse(data.subarray(4, 4 + size).toString()).about : JSON.parse(data);
    if (message.event === "project") resolve();
    if (message.event === "column") stages.set(message.unit, message.stage);
    if (message.event === "light") keys = message.units.map(({ key }) => key);
    if (!message.event) answers.get(message.id)?.(message);
    look();
    if (message.event === "light" && message.phase === "done" && found["simulated values"]) {
      note("end of the refinement");
      end();
    }
  });
});
for (let k = 0; k < Number(units); ++k) {
  const index = Math.floor(((k + 0.5) * candidates) / Number(units));
  const answer = new Promise((resolve) => answers.set(k + 1, resolve));
  const label = "Switch on";
  socket.send(JSON.stringify({ id: k + 1, do: "unit", action: "switch", index, on: true, label }));
  const { error } = await answer;
  if (error) throw new Error(error.message);
}
begun = performance.now();
await done;
socket.close();
await server.end();

const before = performance.now();
run("verify", store, "-o", join(folder, "verification.csv"), "--quiet");
const verified = (performance.now() - before) / 1000;
rmSync(folder, { recursive: true });
console.log(`${example}, ${units} units: verify ${verified.toFixed(1)} s`);
for (const [what, ms] of Object.entries(found))
  console.log(`${what.padEnd(52)}${(ms / 1000).toFixed(1).padStart(8)} s`);
process.exitCode = found["simulated values"] / 1000 > verified ? 1 : 0;
