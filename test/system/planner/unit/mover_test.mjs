import assert from "node:assert/strict";
import { test } from "node:test";

import { Refused } from "../../../../src/page/planner/document/connection";
import { Devices } from "../../../../src/page/planner/document/devices";
import { markUnits, removeUnits } from "../../../../src/page/planner/units/act";
import { indexWith, traitsOf, whyFixed, whyNotAt } from "../../../../src/page/planner/units/chosen";
import { UnitMover } from "../../../../src/page/planner/units/mover";

const states = { candidate: 0, installed: 1, pinned: 2, excluded: 3, selected: 4 };
const kinds = { list: 0, grid: 1, file: 5 };

function unitsOf(rows) {
  const units = new Devices("unit");
  units.position = Float32Array.from(rows.flatMap(({ at }) => at));
  units.direction = Float32Array.from(rows.flatMap(() => [0, 0, -1]));
  units.state = Uint8Array.from(rows, ({ state = "candidate" }) => states[state]);
  units.sourceKind = Uint8Array.from(rows, ({ kind = "grid" }) => kinds[kind]);
  units.source = Uint32Array.from(rows, ({ source = 0 }) => source);
  return units;
}

/** A planner whose server answers when `answer` is called: with the wanted place at a height of 3 m. */
function planned(rows, json = { transceivers: { grids: [{}], list: [] } }) {
  const log = { asked: [], said: [], done: [], ended: [] };
  const waiting = [];
  const selection = { items: [], set: (items) => (selection.items = items), setPaths: () => {} };
  const planner = {
    selection,
    connection: {
      request: (what, request) => {
        log.asked.push([what, request.unit, request.at]);
        return new Promise((resolve, reject) => waiting.push({ request, resolve, reject }));
      },
    },
    document: {
      json,
      unit: { factor: 1 },
      locked: null,
      parts: { all: [] },
      units: unitsOf(rows),
      ask: (_, request) => {
        log.done.push(request);
        return Promise.resolve(log.refuses ? null : { units: (request.each ?? [0]).map(() => "U1") });
      },
    },
    answers: { of: () => Promise.resolve(), now: () => ({ id: "G1-1-1" }) },
    light: { canDrag: false, endDrag: (isKept) => log.ended.push(isKept) },
    changes: { note: () => {} },
    say: (words) => log.said.push(words),
    isPlan: true,
  };
  const settle = () => new Promise(setImmediate);
  const answer = async (refusal) => {
    const { request, resolve, reject } = waiting.shift();
    const [x, y, z = 3] = request.at;
    if (refusal) reject(new Refused({ message: refusal }));
    else resolve({ mount: { position: [x, y, z], axis: [0, 0, -1], roll_deg: 0, on: "ceiling" } });
    await settle();
  };
  return { planner, log, waiting, answer, settle, mover: new UnitMover(planner) };
}

test("a drag asks for one place at a time, shows the last answer, and writes the last place", async () => {
  const { mover, log, waiting, answer, settle } = planned([{ at: [1, 1, 3] }]);
  assert.ok(mover.begin(0));
  assert.equal(mover.shown, null);
  for (const x of [2, 3, 4]) mover.to([x, 1]);
  assert.equal(waiting.length, 1, "one without an answer");
  await answer();
  assert.deepEqual(mover.shown.mount.position, [1, 1, 3]);
  assert.deepEqual(log.asked[1], ["mount", 0, [4, 1]], "the newest");
  const dropped = mover.drop();
  assert.ok(!mover.isDragging);
  mover.to([9, 9]);
  await answer();
  assert.ok(await dropped);
  await settle();
  assert.equal(waiting.length, 0, "no movement after the drop");
  assert.equal(log.done.length, 1);
  const [{ action, each, label }] = log.done;
  const [{ index, position }] = each;
  assert.deepEqual([action, index, position], ["change", 0, [4, 1, 3]]);
  assert.equal(label, "Move unit G1-1-1");
  assert.deepEqual(log.ended, [true]);
  assert.equal(mover.shown, null);
});

test("a cancelled drag, one that moves nothing, and a refused one change nothing", async () => {
  const { mover, log, answer, settle } = planned([{ at: [1, 1, 3] }]);
  mover.begin(0);
  mover.to([2, 2]);
  assert.ok(mover.cancel());
  assert.ok(!mover.cancel(), "there is nothing more to cancel");
  await answer();
  assert.equal(mover.shown, null, "late answers show nothing");
  assert.equal(await mover.drop(), false);
  mover.begin(0);
  const still = mover.drop();
  await answer();
  assert.equal(await still, false);
  assert.deepEqual([log.done, log.ended], [[], [false, false]]);
  log.refuses = true;
  mover.begin(0);
  mover.to([2, 2]);
  const refused = mover.drop();
  await answer();
  await answer();
  assert.equal(await refused, false);
  assert.deepEqual(log.ended.slice(2), [true, false], "its light is taken back");
  await settle();
});

test("a drag ends if another tab replaces the unit, and follows its number otherwise", async () => {
  const { mover, log, answer } = planned([{ at: [0, 0, 3] }, { at: [1, 1, 3] }]);
  mover.begin(1);
  await answer();
  mover.follow(0, 0, 2);
  assert.equal(mover.shown.index, 3);
  mover.follow(4, 1, 1);
  assert.equal(mover.shown.index, 3);
  mover.follow(2, 3, 1);
  assert.ok(!mover.isDragging);
  assert.deepEqual(log.done, []);
});

test("keep-out areas and other units refuse a place", async () => {
  const { planner, mover, log, answer } = planned([{ at: [1, 1, 3] }, { at: [5, 5, 3], state: "pinned" }], {
    transceivers: { keep_out: [{ z: [2, 4] }], list: [] },
  });
  const outline = [
    [2, 2],
    [4, 2],
    [4, 4],
    [2, 4],
  ];
  planner.document.parts.all = [{ kind: "keep_out", path: "/transceivers/keep_out/0", outline }];
  assert.match(whyNotAt(planner, [3, 3, 3]), /keep-out/);
  assert.equal(whyNotAt(planner, [3, 3, 1.5]), null, "below it");
  assert.equal(whyNotAt(planner, [4.5, 3, 3]), null);
  assert.match(whyNotAt(planner, [5, 5, 3]), /already/);
  assert.equal(whyNotAt(planner, [1, 1, 3]), null, "a candidate is no unit on the plan");
  mover.begin(0);
  mover.to([3, 3]);
  const dropped = mover.drop();
  await answer();
  await answer();
  assert.equal(await dropped, false);
  assert.deepEqual([log.done, log.ended], [[], [false]]);
  assert.match(log.said[0], /keep-out/);
});

test("arrow keys add up while the server is asked", async () => {
  const { mover, planner, log, answer, settle } = planned([{ at: [1, 1, 3] }]);
  planner.selection.items = [{ kind: "device", device: "unit", index: 0, path: "/transceivers/grids/0" }];
  const done = mover.nudge(0, [0.01, 0]);
  void mover.nudge(0, [0.01, 0]);
  void mover.nudge(0, [0, 0.1]);
  await answer();
  assert.deepEqual(log.done[0].each[0].position, [1.01, 1, 3]);
  assert.equal(log.done[0].join, true);
  await settle();
  assert.deepEqual(log.asked[1][2].slice(0, 2), [1.01, 1.1]);
  await answer("beyond the rail");
  await done;
  assert.deepEqual(log.said, ["beyond the rail"]);
});

test("what cannot be changed says why", () => {
  const { planner, mover, log } = planned(
    [{ at: [0, 0, 3], kind: "file" }, { at: [1, 1, 3] }, { at: [2, 2, 3], kind: "list" }],
    {
      transceivers: { list: { csv: "units.csv" } },
    },
  );
  assert.match(whyFixed(planner, 0), /another file/);
  assert.match(whyFixed(planner, 1), /is a file/);
  assert.equal(whyFixed(planner, 2), null);
  assert.ok(!mover.begin(1));
  assert.equal(log.said.length, 1);
  planner.document.locked = { message: "" };
  assert.match(whyFixed(planner, 2), /invalid/);
});

test("marks go to the units that lack them, in one step", async () => {
  const { planner, log } = planned([{ at: [0, 0, 3] }, { at: [1, 1, 3], state: "pinned" }, { at: [2, 2, 3] }]);
  assert.ok(await markUnits(planner, [0, 1, 2], "pin", true));
  const pinned = [0, 2].map((index) => ({ index, on: true }));
  assert.deepEqual(log.done, [{ action: "pin", each: pinned, label: "Pin 2 units" }]);
  assert.ok(await markUnits(planner, [1], "switch", false), "a pinned unit is on");
  assert.deepEqual([log.done[1].action, log.done[1].each], ["switch", [{ index: 1, on: false }]]);
  assert.ok(await removeUnits(planner, [1]));
  assert.equal(log.done[2].action, "remove");
});

test("a unit is found again by its place and source", () => {
  const before = unitsOf([{ at: [0, 0, 3] }, { at: [1, 1, 3], source: 1 }]);
  const after = unitsOf([
    { at: [1, 1, 3], source: 0 },
    { at: [0, 0, 3] },
    { at: [1, 1, 3], source: 1, state: "excluded" },
  ]);
  assert.equal(indexWith(after, traitsOf(before, 1)), 2);
  assert.equal(indexWith(after, traitsOf(before, 0)), 1);
  assert.equal(indexWith(unitsOf([]), traitsOf(before, 0)), undefined);
});
