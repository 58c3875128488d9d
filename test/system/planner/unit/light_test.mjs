import assert from "node:assert/strict";
import { test } from "node:test";

import fc from "fast-check";

import { Refused } from "../../../../src/page/planner/document/connection";
import { changesLight, showsOtherLight } from "../../../../src/page/planner/light/causes";
import { sinceBefore, sincePlan } from "../../../../src/page/planner/light/comparison";
import { lightFacts } from "../../../../src/page/planner/light/facts";
import { Column, Field } from "../../../../src/page/planner/light/field";
import { histogramOf } from "../../../../src/page/planner/light/histogram";
import { Light } from "../../../../src/page/planner/light/light";
import { Verdicts, verdicts } from "../../../../src/page/planner/light/verdicts";
import { weakestLabels, weakestOfGroups } from "../../../../src/page/planner/light/weakest";
import { dataFile } from "./support.mjs";

globalThis.requestAnimationFrame ??= (draw) => draw();
const timers = () => new Promise((done) => setTimeout(done));

const noPreview = { parts: new Map(), devices: new Map(), added: [], hidden: new Set() };
const column = (signal, { stage = "simulated", error = signal.map(() => 0) } = {}) =>
  new Column(stage, Float32Array.from(signal), Float32Array.from(error), new Uint8Array(signal.length));
const frame = (about, arrays) => ({ about, get: (name) => arrays[name] });
const requirements = (generation, requirement) =>
  frame({ event: "requirements", generation }, { requirement: Float32Array.from(requirement) });
const columnFrame = (generation, unit, signal, { stage = "simulated", error = signal.map(() => 0) } = {}) =>
  frame(
    { event: "column", generation, unit, stage },
    { signal: Float32Array.from(signal), error: Float32Array.from(error), doubts: new Uint8Array(signal.length) },
  );
const event = (generation, revision, keys, more = {}) => ({
  ...{ event: "light", generation, revision, phase: "refining", operator: "fine" },
  units: keys.map((key, index) => ({ index, id: `U${index}`, key })),
  ...{ undecided: null, progress: null, baseline: null },
  ...more,
});
const answer = (generation, signal) => ({
  about: { event: "drag", id: 1, generation, position: [1, 2, 3], axis: [0, 0, -1], roll_deg: 0, stage: "fine" },
  column: column(signal, { stage: "fine" }),
});

/** Takes values of all generations. */
class Credulous extends Light {
  isCurrent() {
    return true;
  }
}

const letters = { reached: "r", missed: "m", undecided: "u", unknown: "-" };

/** `said`: the verdicts of all labels. */
function lit(count, Kind = Light) {
  const document = { revision: 1, labels: { count }, pendingOps: [], preview: noPreview };
  const connection = { sent: [] };
  connection.request = (what, members) =>
    new Promise((resolve, reject) => connection.sent.push({ what, members, resolve, reject }));
  const light = new Kind(document, { note: () => {} }, connection);
  const said = () => {
    light.refresh();
    return [...light.verdicts.verdict].map((verdict) => letters[verdicts[verdict]]).join("");
  };
  return { light, document, connection, said };
}

/** Two units and four labels, of which the second unit alone reaches the third. */
function shop(Kind) {
  const made = lit(4, Kind);
  made.light.receive(event(3, 1, ["a", "b"]));
  made.light.receiveFrame(requirements(3, [1, 1, 1, 1]));
  made.light.receiveFrame(columnFrame(3, "a", [2, 0.6, 0, 0.1]));
  made.light.receiveFrame(columnFrame(3, "b", [0, 0.6, 2, 0.1]));
  return made;
}

test("signals of the units on the plan add up, and each label has a verdict", () => {
  const { light, said } = shop();
  assert.equal(said(), "rrrm");
  assert.ok(!light.isStale && !light.isPreview && light.stage === "simulated");
  assert.equal(light.reachOf("a"), 1);
  const unitsFor = (label) => light.contributions(label).map(({ unit }) => unit);
  assert.deepEqual([unitsFor(1), unitsFor(2)], [[0, 1], [1]]);
  light.receive(event(3, 2, ["a"]));
  assert.equal(said(), "rmmm", "without the second unit");
  light.receive(event(3, 3, ["a", "b"]));
  assert.equal(said(), "rrrm", "its column is kept");
});

test("the page shows the sum of all units, with the root of the sum of their variances", () => {
  const { light, document, said } = lit(2);
  light.receive(event(1, 1, ["a", "b", "c"]));
  light.receiveFrame(requirements(1, [1, 1]));
  light.receiveFrame(columnFrame(1, "a", [2, 0.5], { error: [0.25, 0] }));
  light.receiveFrame(columnFrame(1, "b", [4, 0], { error: [0.375, 0] }));
  light.receiveFrame(columnFrame(1, "c", [8.25, 1], { error: [0.75, 0.125] }));
  assert.equal(said(), "rr");
  const { total, variance } = light.field;
  assert.deepEqual([...total], [14.25, 1.5]);
  assert.deepEqual([...variance].map(Math.sqrt), [0.875, 0.125]);
  document.labels.state = [0, 0];
  const facts = Object.fromEntries(lightFacts({ light, document, plans: { availability: [] } }, 0));
  assert.deepEqual([facts.Signal, facts["Standard error"]], ["14.3\u00a0W/m²", "±\u00a00.88\u00a0W/m²"]);
});

test("labels without a value, and those that more light may reach, are never guessed", () => {
  const { light, said } = lit(3);
  assert.equal(said(), "---");
  light.receive(event(3, 1, ["a", "b"]));
  light.receiveFrame(requirements(3, [1, 1, 1]));
  assert.equal(said(), "---");
  light.receiveFrame(columnFrame(3, "a", [2, 0.5, 0]));
  assert.equal(said(), "ruu", "the other unit may add to it");
  light.receiveFrame(columnFrame(3, "b", [0, 0, 0.5], { stage: "direct" }));
  assert.equal(said(), "ruu", "reflections may add to it");
  assert.ok(light.isPreview && light.stage === "direct");
  light.receiveFrame(columnFrame(3, "b", [0, 0, 0.5], { stage: "coarse" }));
  assert.equal(said(), "rmm");
  assert.ok(light.isPreview);
  light.receiveFrame(columnFrame(3, "b", [0, 0.4, 0.5], { error: [0, 0.06, 0.1] }));
  assert.equal(said(), "rum", "0.1 is within 1.96 x 0.06, 0.5 not within 1.96 x 0.1");
});

/** Values of an older generation come late. */
function afterChange(Kind) {
  const made = shop(Kind);
  const { light } = made;
  light.receive(event(4, 2, ["a", "b"]));
  light.receiveFrame(requirements(4, [1, 1, 1, 1]));
  light.receiveFrame(columnFrame(4, "a", [0.1, 0.1, 0.1, 0.1]));
  light.receiveFrame(columnFrame(4, "b", [0.1, 0.1, 0.1, 0.1]));
  light.receiveFrame(columnFrame(3, "b", [9, 9, 9, 9]));
  light.receiveFrame(requirements(3, [0, 0, 0, 0]));
  light.drag(0, answer(3, [9, 9, 9, 9]));
  return made;
}

test("values of an older generation are dropped", () => {
  const isRight = (Kind) => afterChange(Kind).said() === "mmmm";
  assert.ok(isRight(Light));
  assert.ok(!isRight(Credulous), "control: without the check they are noticed");
});

test("no order of messages makes values of an older generation current", () => {
  const message = fc.record({ late: fc.nat(2), unit: fc.constantFrom("a", "b"), isDrag: fc.boolean() });
  const run = (Kind, steps) => {
    const { light, said } = lit(1, Kind);
    let generation = 0;
    const begin = () => {
      light.receive(event(++generation, generation, ["a", "b"]));
      light.receiveFrame(requirements(generation, [generation]));
    };
    begin();
    for (const { late, unit, isDrag } of steps) {
      if (late === 0) begin();
      const of = Math.max(generation - late, 1);
      if (isDrag) light.drag(unit === "a" ? 0 : 1, answer(of, [of]));
      else light.receiveFrame(columnFrame(of, unit, [of])); // both units together: twice the requirement
      said();
      if (!light.isStale && light.field && light.field.total[0] % generation !== 0) return false;
    }
    return true;
  };
  const holdsFor = (Kind) =>
    fc.check(fc.property(fc.array(message, { minLength: 1, maxLength: 30 }), (steps) => run(Kind, steps)));
  assert.deepEqual([holdsFor(Light).failed, holdsFor(Credulous).failed], [false, true]);
});

test("values stay, but as stale, until those of the next generation are complete", () => {
  const { light, said } = shop();
  light.noteChange(2, [{ path: "/fixtures/0/at" }]);
  said();
  assert.ok(light.isStale, "the event of the change has not come");
  light.receive(event(4, 2, ["a", "b"]));
  light.receiveFrame(requirements(4, [1, 1, 1, 1]));
  light.receiveFrame(columnFrame(4, "a", [2, 0, 0, 0]));
  assert.equal(said(), "rrrm");
  assert.ok(light.isStale);
  light.receiveFrame(columnFrame(4, "b", [0, 0, 0, 0]));
  assert.equal(said(), "rmmm");
  assert.ok(!light.isStale);
  light.receive(event(5, 3, ["a", "b"], { phase: "failed", message: "too large" }));
  assert.equal(said(), "----", "nothing will come");
});

test("edits without an answer, and gestures on what reflects or holds labels, make values stale at once", () => {
  const { light, document, said } = shop();
  const isStale = () => {
    said();
    return light.isStale;
  };
  assert.ok(!isStale());
  document.pendingOps = [{ path: "/transceivers/selected" }, { path: "/name" }, { path: "/drawing/scale" }];
  assert.ok(!isStale());
  document.pendingOps = [{ path: "/materials/paint/reflectance" }];
  assert.ok(isStale());
  document.pendingOps = [];
  assert.ok(!isStale(), "taken back");
  const part = (path, kind) => ({ key: path, path, kind, id: "", outline: [] });
  const preview = (...parts) => ({ ...noPreview, parts: new Map(parts.map((one) => [one.key, one])) });
  assert.ok(!showsOtherLight([], preview(part("/transceivers/rails/0", "rail"))));
  assert.ok(showsOtherLight([], preview(part("/fixtures/0", "fixture"))));
  assert.ok(!showsOtherLight([], { ...noPreview, added: [part(null, "keep_out")] }));
  assert.ok(showsOtherLight([], { ...noPreview, added: [part(null, "wall")] }));
  assert.ok(showsOtherLight([], { ...noPreview, devices: new Map([["/labels/3", {}]]) }));
});

test("the page and the server agree on the keys that change no light", () => {
  const shop = dataFile("../../src/serve/live/shop.cpp").toString();
  const [, listed] = /without_light[^;]*\{([^}]*)\}/.exec(shop);
  const keys = "name language currency source confirmed assumed drawing variation ignore transceivers".split(" ");
  assert.deepEqual(JSON.parse(`[${listed}]`), keys);
  for (const key of keys) assert.ok(!changesLight(`/${key}`) && !changesLight(`/${key}/0/id`), key);
  for (const key of ["fixtures", "labels", "materials", "room", "transceiver_types", "units"])
    assert.ok(changesLight(`/${key}/0`), key);
});

test("of columns of units that are not on the plan, the newest are kept, up to 32 MiB", () => {
  const labels = 40_000;
  const field = new Field(1);
  const kept = column(new Array(labels).fill(1));
  const keep = (key, ...onPlan) =>
    field.keep(
      key,
      kept,
      onPlan.map((unit) => ({ key: unit })),
    );
  for (const key of ["a", "b", "c"]) keep(key, "a", "b", "c");
  const most = Math.ceil(2 ** 25 / (9 * labels));
  for (let k = 0; k < 2 * most; ++k) keep(`moved ${k}`, "a", "b");
  assert.equal(field.columns.size, most);
  assert.ok(field.columns.has("a") && field.columns.has("b") && !field.columns.has("c"));
  keep("new", "b");
  assert.ok(field.columns.has("a"), "an undo brings it back");
  const all = Array.from({ length: most + 5 }, (_, k) => `unit ${k}`);
  for (const key of all) keep(key, ...all);
  assert.ok(
    all.every((key) => field.columns.has(key)),
    "never those on the plan",
  );
});

test("values of another number of labels are not shown", () => {
  const { light, document, said } = shop();
  document.labels = { count: 5 };
  assert.equal(said(), "-----");
  document.labels = { count: 4 };
  assert.equal(said(), "rrrm");
  light.restart();
  assert.equal(said(), "rrrm");
  assert.ok(light.isStale, "another server counts its generations anew");
});

test("a drag replaces the column of its unit until that of the changed unit has come", () => {
  const { light, document, said } = shop();
  light.drag(0, answer(3, [0, 0, 0, 2]));
  assert.equal(said(), "mmrr");
  assert.ok(light.isPreview && light.dragged !== null);
  assert.deepEqual(sinceBefore(light.before, light.verdicts.verdict), { gained: 1, lost: 2 });
  assert.deepEqual(light.contributions(3)[0].position, [1, 2, 3]);
  light.drag(0, answer(3, [0, 0, 0, 0]));
  assert.equal(said(), "mmrm", "the newest answer");
  light.endDrag();
  assert.equal(said(), "mmrm", "after the drop");
  document.revision = 2;
  light.receive(event(3, 2, ["c", "b"]));
  assert.equal(said(), "mmrm", "its column has not come");
  light.receiveFrame(columnFrame(3, "c", [2, 2, 2, 2]));
  assert.equal(said(), "rrrr");
  assert.ok(!light.isPreview && light.dragged === null);
});

test("a drag that is cancelled, or changes nothing, leaves the columns as they were", () => {
  const { light, said } = shop();
  const before = said();
  light.drag(1, answer(3, [0, 0, 0, 2]));
  light.endDrag(false);
  assert.equal(said(), before);
  light.drag(1, answer(3, [0, 0, 0, 2]));
  light.endDrag();
  light.receive(event(3, 2, ["a", "b"]));
  assert.equal(said(), before, "the same place");
});

test("drags send one request at a time, and then the newest", async () => {
  const { light, connection } = shop();
  const results = [1, 2, 3].map((x) => light.dragger.move({ at: [x, 0], unit: 0 }));
  assert.deepEqual(
    connection.sent.map(({ what, members }) => [what, members.at[0]]),
    [["drag", 1]],
  );
  const { about, column: sent } = answer(3, [5, 5, 5, 5]);
  const arrays = { signal: sent.signal, error: sent.error, doubts: sent.doubts };
  connection.sent[0].resolve(frame(about, arrays));
  assert.equal((await results[0]).about, about);
  assert.equal(await results[1], null, "overtaken");
  assert.ok(light.dragged !== null);
  await timers();
  assert.equal(connection.sent[1].members.at[0], 3);
  connection.sent[1].reject(new Refused({ message: "no" }));
  assert.ok((await results[2]) instanceof Refused);
  await timers();
  const late = light.dragger.move({ at: [4, 0], unit: 0 });
  light.endDrag(false);
  connection.sent[2].resolve(frame(about, arrays));
  assert.equal(await late, null);
  assert.equal(light.dragged, null, "late");
});

test("sums by differences are those of the columns", () => {
  const values = fc.array(fc.float({ min: 0, max: 1e3, noNaN: true }), { minLength: 3, maxLength: 3 });
  const step = fc.record({ key: fc.constantFrom("a", "b", "c"), signal: fc.option(values) });
  fc.assert(
    fc.property(fc.array(step, { maxLength: 40 }), (steps) => {
      const field = new Field(1);
      field.require(Float32Array.from([1, 1, 1]));
      const wanted = new Map();
      for (const { key, signal } of steps) {
        if (signal) wanted.set(key, column(signal, { error: signal }));
        else wanted.delete(key);
        field.sum(new Map(wanted));
      }
      for (let label = 0; label < 3; ++label) {
        const all = [...wanted.values()].map(({ signal }) => signal[label]);
        const total = all.reduce((sum, value) => sum + value, 0);
        const variance = all.reduce((sum, value) => sum + value * value, 0);
        assert.ok(Math.abs(field.total[label] - total) < 1e-9);
        assert.ok(Math.abs(field.variance[label] - variance) < 1e-6);
      }
    }),
  );
});

test("classes of margins are those of the report", () => {
  const field = new Field(1);
  const margins = [-20, -3.01, -2.99, -0.01, 0.01, 0.99, 1.01, 2.99, 3.01, 5.99, 6.01, 9.99, 10.01, 40];
  field.require(Float32Array.from(margins, () => 1));
  field.sum(new Map([["a", column(margins.map((margin) => 10 ** (margin / 10)))]]));
  const found = new Verdicts();
  found.update(field, margins.length, false);
  assert.deepEqual([...found.band], [0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6]);
  assert.deepEqual([...found.counts], [4, 0, 0, 10]);
  assert.deepEqual([...found.bandCounts], [2, 2, 2, 2, 2, 2, 2]);
  field.require(new Float32Array(margins.length));
  found.update(field, margins.length, false);
  assert.ok(
    found.verdict.every((verdict) => verdicts[verdict] === "reached"),
    "labels without a requirement",
  );
});

test("the weakest shown label of a point lies in front", () => {
  const groups = Uint32Array.from([0, 0, 0, 1, 1, 2]);
  const field = new Field(1);
  field.require(Float32Array.from([1, 1, 1, 1, 1, 1]));
  field.sum(new Map([["a", column([5, 0.2, 0.5, 3, 2, 9], { error: [0, 0, 0.4, 0, 0, 0] })]]));
  const found = new Verdicts();
  found.update(field, 6, false);
  assert.deepEqual([...weakestOfGroups(groups, found.strength, () => true)], [0, 1, 0, 0, 1, 1]);
  assert.deepEqual(
    [...weakestOfGroups(groups, found.strength, (label) => label !== 1)],
    [0, 0, 1, 0, 1, 1],
    "an undecided label is worse than one that is reached",
  );
  assert.deepEqual([...weakestOfGroups(groups, found.strength, (label) => label > 2)], [0, 0, 0, 0, 1, 1]);
  assert.deepEqual(weakestLabels(found.strength, 3), [1, 2, 4]);
});

test("weakest labels", () => {
  fc.assert(
    fc.property(fc.array(fc.integer({ min: 0, max: 20 })), fc.integer({ min: 1, max: 8 }), (values, most) => {
      const strength = Float32Array.from(values);
      const sorted = [...strength.keys()].sort((a, b) => strength[a] - strength[b] || a - b).slice(0, most);
      assert.deepEqual(weakestLabels(strength, most), sorted);
    }),
  );
});

test("a histogram counts every label with a requirement", () => {
  const field = new Field(1);
  field.require(Float32Array.from([1, 1, 1, 1, 0]));
  field.sum(new Map([["a", column([0, 1, 10 ** 0.25, 1e6, 1])]]));
  const { counts, from, width, weakest, median } = histogramOf(field);
  const bin = (margin) => counts[(margin - from) / width];
  assert.equal(
    counts.reduce((sum, count) => sum + count, 0),
    4,
  );
  assert.deepEqual([counts[0], bin(0), bin(2), counts[counts.length - 1]], [1, 1, 1, 1]);
  assert.equal(weakest, Number.NEGATIVE_INFINITY);
  assert.ok(Math.abs(median - 2.5) <= 0.1);
  field.require(new Float32Array(5));
  assert.equal(histogramOf(field), null);
});

test("gains and losses against a plan leave out what is not known", () => {
  const now = Uint8Array.from(["reached", "missed", "reached", "missed", "undecided", "undecided"], (name) =>
    verdicts.indexOf(name),
  );
  assert.deepEqual(sincePlan("110001", now), { gained: 1, lost: 1 });
  assert.deepEqual(sincePlan("-----1", now), { gained: 0, lost: 0 });
  assert.equal(sincePlan("11", now), null, "another number of labels");
});
