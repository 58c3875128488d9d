// node dxf_corpus.mjs PACKAGES OUT: writes DXF files with ezdxf, reads each in a process of its own, and compares what
// the planner's reader finds with what ezdxf says. Each may take 500 MB. Without ezdxf, exits with 77, or with an error
// in continuous integration (CI is set).

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const mostMegabytes = 500;

const sortedBy = (list, key) => [...list].sort((a, b) => (key(a) < key(b) ? -1 : key(a) > key(b) ? 1 : 0));

/** What the comparison needs of a drawing. */
function factsOf({ version, unit, layers, segments, layerOf, texts, outlines, origin, size, notes }) {
  const found = layers.map(({ name, isOn, lines, texts: count }) => ({
    name,
    ...{ on: isOn, texts: count, length: 0, bounds: null, lines },
  }));
  for (let k = 0; k < layerOf.length; ++k) {
    const layer = found[layerOf[k]];
    const [x0, y0, x1, y1] = segments.subarray(4 * k, 4 * k + 4);
    layer.length += Math.hypot(x1 - x0, y1 - y0);
    const bounds = layer.bounds ?? [x0, y0, x0, y0];
    layer.bounds = [
      Math.min(bounds[0], x0, x1),
      Math.min(bounds[1], y0, y1),
      Math.max(bounds[2], x0, x1),
      Math.max(bounds[3], y0, y1),
    ];
    --layer.lines;
  }
  for (const layer of found) layer.bounds = layer.bounds?.map((side, k) => side + origin[k % 2]) ?? null;
  return {
    version,
    unit,
    layers: found,
    size,
    notes,
    outlines: outlines.length,
    texts: texts.map(({ layer, text }) => [layers[layer].name, text]),
  };
}

/** In the process of one file. */
async function read(bundle, file) {
  const { proposedUnit, readDxf } = await import(pathToFileURL(bundle));
  const bytes = readFileSync(file);
  const before = process.cpuUsage();
  let [drawing, error] = [null, null];
  try {
    drawing = readDxf(bytes);
  } catch (thrown) {
    error = thrown.name === "DxfError" ? { code: thrown.code, values: thrown.values } : { code: String(thrown) };
  }
  const { user, system } = process.cpuUsage(before);
  const result = {
    error,
    facts: drawing && factsOf(drawing),
    proposed: drawing && proposedUnit(drawing),
    seconds: (user + system) / 1e6,
    megabytes: process.resourceUsage().maxRSS / 1024,
  };
  process.stdout.write(JSON.stringify(result));
}

function isNear(found, expected, tolerance, what) {
  assert.ok(Math.abs(found - expected) <= tolerance, `${what}: ${found} instead of ${expected}`);
}

function compare({ error, facts, proposed }, expected) {
  assert.equal(error?.code, expected.error, JSON.stringify(error));
  if (expected.error) return;
  assert.equal(facts.version, expected.version);
  assert.equal(facts.unit, expected.unit);
  if (expected.proposed) assert.deepEqual([proposed.unit, proposed.why], expected.proposed);
  assert.deepEqual(facts.layers.map(({ name }) => name).sort(), Object.keys(expected.layers).sort());
  for (const { name, length, bounds, texts, on, lines } of facts.layers) {
    const layer = expected.layers[name];
    assert.deepEqual([on, texts, lines], [layer.on, layer.texts, 0], name);
    if (layer.length !== null) isNear(length, layer.length, 5e-4 * layer.length, `length of ${name}`);
    assert.equal(bounds === null, layer.bounds === null);
    const size = bounds ? Math.max(bounds[2] - bounds[0], bounds[3] - bounds[1]) : 0;
    for (const [k, side] of (bounds ?? []).entries())
      isNear(side, layer.bounds[k], 5e-4 * size, `side ${k} of ${name}`);
  }
  assert.deepEqual(sortedBy(facts.texts, String), sortedBy(expected.texts, String));
  const notes = {};
  for (const { code, name } of facts.notes) notes[code] = [...(notes[code] ?? []), name].sort();
  const wanted = Object.entries(expected.notes ?? {}).map(([code, names]) => [code, names ?? [null]]);
  assert.deepEqual(notes, Object.fromEntries(wanted));
}

function run(packages, out) {
  rmSync(out, { recursive: true, force: true });
  mkdirSync(out, { recursive: true });
  const bundle = join(out, "reader.mjs");
  const source = (name) => fileURLToPath(new URL(`../../../src/page/planner/dxf/${name}`, import.meta.url));
  createRequire(`${packages}/`)("esbuild").buildSync({
    stdin: {
      contents: `export * from ${JSON.stringify(source("reader.ts"))}; export * from ${JSON.stringify(source("unit.ts"))};`,
      resolveDir: out,
    },
    bundle: true,
    platform: "node",
    format: "esm",
    target: "node18",
    outfile: bundle,
  });
  const files = join(out, "files");
  const corpus = fileURLToPath(new URL("../../data/dxf_corpus.py", import.meta.url));
  const python = spawnSync("/usr/bin/python3", ["-B", corpus, files], { stdio: "inherit" });
  assert.equal(python.status, 0);
  const all = JSON.parse(readFileSync(join(files, "expected.json"), "utf8"));
  const self = fileURLToPath(import.meta.url);
  const failed = [];
  let slowest = { seconds: 0 };
  let largest = { megabytes: 0 };
  let control = null;
  for (const [name, expected] of Object.entries(all)) {
    const child = spawnSync(process.execPath, [self, "read", bundle, join(files, name)], {
      encoding: "utf8",
      maxBuffer: 1e8,
      timeout: 120_000,
    });
    try {
      assert.equal(child.status, 0, child.stderr);
      const result = JSON.parse(child.stdout);
      if (result.seconds > slowest.seconds) slowest = { name, ...result };
      if (result.megabytes > largest.megabytes) largest = { name, ...result };
      compare(result, expected);
      assert.ok(result.megabytes <= mostMegabytes, `takes ${result.megabytes} MB`);
      if (name === "blocks_R2010.dxf") control = { result, expected };
    } catch (error) {
      failed.push(name);
      console.log(`${name}: ${error.message}`);
    }
  }
  // Negative controls: a layer that is 0.1 % longer, or a little larger, is found.
  const { result, expected } = control;
  const { WALL } = expected.layers;
  for (const change of [{ length: 1.001 * WALL.length }, { bounds: WALL.bounds.map((side) => side + 0.3) }]) {
    const layers = { ...expected.layers, WALL: { ...WALL, ...change } };
    assert.throws(() => compare(result, { ...expected, layers }), /WALL/);
  }
  const show = ({ name, seconds, megabytes }) => `${name} ${seconds.toFixed(2)} s, ${megabytes.toFixed(0)} MB`;
  console.log(`${Object.keys(all).length - failed.length} of ${Object.keys(all).length} files as ezdxf reads them`);
  console.log(`slowest: ${show(slowest)}; largest: ${show(largest)}`);
  rmSync(files, { recursive: true });
  process.exit(failed.length === 0 ? 0 : 1);
}

if (process.argv[2] === "read") await read(...process.argv.slice(3));
else if (spawnSync("/usr/bin/python3", ["-c", "import ezdxf"]).status !== 0) {
  console.log("skipped: needs ezdxf (python3-ezdxf)");
  process.exit(process.env.CI ? 1 : 77);
} else run(...process.argv.slice(2));
