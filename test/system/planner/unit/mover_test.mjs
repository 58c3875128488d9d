import assert from "node:assert/strict";
import { test } from "node:test";

import { Refused } from "../../../../src/page/planner/document/connection";
import { Devices } from "../../../../src/page/planner/document/devices";
import { toggleMark, removeUnits, turnUnits } from "../../../../src/page/planner/units/act";
import { indexWith, traitsOf, whyFixed, whyNotAt } from "../../../../src/page/planner/units/chosen";
import { UnitMover } from "../../../../src/page/planner/units/mover";
import { UnitQueue } from "../../../../src/page/planner/units/queue";
import { deviceItem } from "../../../../src/page/planner/view/hit";
import { Selection } from "../../../../src/page/planner/view/selection";
import { square } from "./support.mjs";

const states = { candidate: 0, installed: 1, pinned: 2, excluded: 3, selected: 4 };
const kinds = { list: 0, grid: 1, file: 5 };

function show(units, rows) {
  units.position = Float32Array.from(rows.flatMap(({ at }) => at));
  units.direction = Float32Array.from(rows.flatMap(({ axis = [0, 0, -1] }) => axis));
  units.state = Uint8Array.from(rows, ({ state = "candidate" }) => states[state]);
  units.sourceKind = Uint8Array.from(rows, ({ kind = "grid" }) => kinds[kind]);
  units.source = Uint32Array.from(rows, ({ source = 0 }) => source);
  ++units.version;
  return units;
}
const unitsOf = (rows) => show(new Devices("unit"), rows);
const settle = () => new Promise(setImmediate);

/** A planner whose server says where a unit is mounted when `answer` is called: at the wanted place, 3 m high. */
function planned(given, json = { transceivers: { grids: [{}], list: [] } }) {
  const log = { asked: [], said: [], done: [], ended: [] };
  const waiting = [];
  let rows = given;
  const planner = {
    selection: new Selection({ note: () => {} }),
    connection: {
      request: (what, request) => {
        log.asked.push([what, request.unit, request.at]);
        return new Promise((resolve, reject) => waiting.push({ request, resolve, reject }));
      },
    },
    document: {
      json,
      confirmed: json,
      unit: { factor: 1 },
      locked: null,
      parts: { all: [] },
      units: unitsOf(rows),
      ask: (_, request) => {
        log.done.push(request);
        return log.reply?.(request) ?? Promise.resolve({ units: request.each.map(({ id }) => id) });
      },
    },
    answers: {
      of: (_, index) => Promise.resolve(rows[index] ? { id: rows[index].id ?? `G1-1-${index + 1}` } : null),
    },
    light: { canDrag: false, endDrag: (isKept) => log.ended.push(isKept) },
    changes: { note: () => {} },
    say: (words) => log.said.push(words),
    isPlan: true,
  };
  planner.queue = new UnitQueue(planner);
  const mover = new UnitMover(planner);
  const answer = async (refusal) => {
    await settle();
    const { request, resolve, reject } = waiting.shift();
    const [x, y, z = 3] = request.at;
    if (refusal) reject(refusal instanceof Error ? refusal : new Refused({ message: refusal }));
    else resolve({ mount: { position: [x, y, z], axis: [0, 0, -1], roll_deg: 0, on: "ceiling" } });
    await settle();
  };
  /** The units after a change, and the list of the store. */
  const change = (after, list = []) => {
    rows = after;
    planner.document.json = planner.document.confirmed = { transceivers: { ...json.transceivers, list } };
    show(planner.document.units, rows);
    mover.follow();
  };
  const select = (...indices) => planner.selection.set(indices.map((k) => deviceItem(planner.document.units, k)));
  return { planner, log, waiting, answer, change, select, mover };
}

test("a drag asks for one place at a time, shows the last answer, and writes the last place", async () => {
  const { mover, log, waiting, answer } = planned([{ at: [1, 1, 3] }]);
  assert.ok(mover.begin(0));
  assert.equal(mover.shown, null);
  for (const x of [2, 3, 4]) mover.to([x, 1]);
  await settle();
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
  const [{ index, id, position }] = each;
  assert.deepEqual([action, index, id, position], ["change", 0, "G1-1-1", [4, 1, 3]]);
  assert.equal(label, "Move unit G1-1-1");
  assert.deepEqual(log.ended, [true]);
  assert.equal(mover.shown, null);
});

test("a cancelled drag, one that moves nothing, and a refused one change nothing", async () => {
  const { mover, log, answer } = planned([{ at: [1, 1, 3] }]);
  mover.begin(0);
  mover.to([2, 2]);
  await settle();
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
  log.reply = () => Promise.resolve(null);
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
  const [first, second] = [{ at: [0, 0, 3] }, { at: [1, 1, 3] }];
  const { mover, log, answer, change } = planned([first, second]);
  mover.begin(1);
  await answer();
  const new_ = { at: [5, 5, 3], kind: "list" };
  change([new_, first, second]);
  assert.equal(mover.shown.index, 2);
  change([new_, first, second, first]);
  assert.equal(mover.shown.index, 2);
  change([new_, first, { ...second, at: [1, 2, 3] }]);
  assert.ok(!mover.isDragging);
  assert.deepEqual(log.done, []);
});

test("keep-out areas and other units refuse a place", async () => {
  const { planner, mover, log, answer } = planned([{ at: [1, 1, 3] }, { at: [5, 5, 3], state: "pinned" }], {
    transceivers: { keep_out: [{ z: [2, 4] }], list: [] },
  });
  const outline = square(2, 2, 2);
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

test("a drag that begins while the last drop is written goes on with what became of the unit", async () => {
  const [first, second] = [
    { at: [1, 1, 3], id: "A" },
    { at: [6, 6, 3], id: "B" },
  ];
  const { mover, log, waiting, answer, change } = planned([first, second]);
  let written;
  log.reply = () => new Promise((resolve) => (written = resolve));
  mover.begin(0);
  mover.to([2, 1]);
  const dropped = mover.drop();
  await answer();
  await answer();
  assert.deepEqual(mover.placeOf(0), [2, 1, 3], "it stays where it was dropped");
  assert.ok(mover.begin(0));
  mover.to([3, 1]);
  await settle();
  assert.equal(waiting.length, 0, "no question before the drop is written");
  change([{ at: [2, 1, 3], id: "U1", kind: "list", state: "pinned" }, first, second], [{ id: "U1" }]);
  written({ units: ["U1"] });
  assert.ok(await dropped);
  await answer();
  await answer();
  assert.deepEqual(mover.shown, { index: 0, mount: { ...mover.shown.mount, position: [3, 1, 3] } });
  log.reply = undefined;
  assert.ok(await mover.drop());
  assert.deepEqual(
    log.done.map(({ each: [{ index, id }] }) => `${index} ${id}`),
    ["0 A", "0 U1"],
  );
  assert.deepEqual(log.said, []);
});

test("arrow keys add up while the server is asked", async () => {
  const { mover, log, answer, select } = planned([{ at: [1, 1, 3] }]);
  select(0);
  const done = mover.nudge(0, [0.01, 0]);
  await settle();
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

test("arrow keys move each unit by its own way, and go on after an error", async () => {
  const { mover, log, answer, select } = planned([{ at: [1, 1, 3] }, { at: [5, 5, 3] }]);
  const failing = assert.rejects(mover.nudge(0, [0.01, 0]));
  await answer(new Error("a fault"));
  await failing;
  select(0);
  const first = mover.nudge(0, [0.01, 0]);
  select(1);
  const second = mover.nudge(1, [0, 0.1]);
  await answer();
  await first;
  await answer();
  await second;
  assert.deepEqual(
    log.done.map(({ each: [{ index, position }] }) => `${index} at ${position}`),
    ["0 at 1.01,1,3", "1 at 5,5.1,3"],
  );
});

test("what cannot be changed says why", () => {
  const units = [{ at: [0, 0, 3], kind: "file" }, { at: [1, 1, 3] }, { at: [2, 2, 3], kind: "list" }];
  const { planner, mover, log } = planned(units, { transceivers: { list: { csv: "units.csv" } } });
  assert.match(whyFixed(planner, 0), /another file/);
  assert.match(whyFixed(planner, 1), /is a file/);
  assert.equal(whyFixed(planner, 2), null);
  assert.ok(!mover.begin(1));
  assert.equal(log.said.length, 1);
  planner.document.locked = { message: "" };
  assert.match(whyFixed(planner, 2), /invalid/);
});

test("marks go to the units that lack them, in one step", async () => {
  const list = { at: [3, 3, 3], kind: "list", id: "U1" };
  const { planner, log } = planned([{ at: [0, 0, 3] }, { at: [1, 1, 3], state: "pinned" }, { at: [2, 2, 3] }, list]);
  assert.ok(await toggleMark(planner, [0, 1, 2], "pin"));
  const pinned = [0, 2].map((index) => ({ index, id: `G1-1-${index + 1}`, on: true }));
  assert.deepEqual(log.done, [{ action: "pin", each: pinned, label: "Pin 2 units" }]);
  assert.ok(await toggleMark(planner, [1], "switch"), "a pinned unit is on");
  assert.deepEqual([log.done[1].action, log.done[1].each], ["switch", [{ index: 1, id: "G1-1-2", on: false }]]);
  assert.ok(await removeUnits(planner, [1, 3]));
  const removed = [
    { index: 1, id: "G1-1-2" },
    { index: 3, id: "U1" },
  ];
  assert.deepEqual(log.done[2], { action: "remove", each: removed, label: "Delete 2 units" }, "one step");
});

const [one, two, three] = ["A", "B", "C"].map((id, k) => ({ id, at: [k, k, 3] }));
const turnedTwo = { id: "U1", at: two.at, kind: "list", state: "pinned" };

/** The server answers the first command, by which the unit gets another number, after the second was given. */
async function twoQuick(after, second) {
  const made = planned([one, two, three]);
  const { planner, log, change, select } = made;
  const replies = [];
  log.reply = () => new Promise((resolve) => replies.push(resolve));
  select(1);
  const turned = turnUnits(planner, [1], 90);
  await settle();
  const done = second(made);
  await settle();
  assert.equal(log.done.length, 1, "the second one waits");
  change(after, [{ id: "U1" }]);
  replies[0]({ units: ["U1"] });
  assert.ok(await turned);
  await settle();
  const request = log.done[1];
  replies[1]?.({ units: request.each.map(({ id }) => id) });
  return { ...made, request, result: await done };
}

test("the second of two quick commands means what became of the unit, under its new number", async () => {
  const { request, planner } = await twoQuick([turnedTwo, one, two, three], (made) => turnUnits(made.planner, [1], 90));
  assert.deepEqual([request.each[0].index, request.each[0].id], [0, "U1"]);
  assert.deepEqual(planner.selection.paths, ["/transceivers/list/0"]);
});

test("the second of two quick commands, for another unit, keeps to it and to its selection", async () => {
  const { request, planner } = await twoQuick([turnedTwo, one, two, three], (made) => {
    made.select(2);
    return toggleMark(made.planner, [2], "exclude");
  });
  assert.deepEqual(request.each, [{ index: 3, id: "C", on: true }]);
  const selected = planner.selection.items.map(({ index }) => index);
  assert.deepEqual(selected, [3], "the late answer selects nothing else");
});

test("a command for a unit that another tab has removed does nothing, and says so", async () => {
  const { log, result, request } = await twoQuick([turnedTwo, one, two], (made) =>
    toggleMark(made.planner, [2], "pin"),
  );
  assert.deepEqual([result, request], [false, undefined]);
  assert.match(log.said[0], /no longer there/);
});

test("numbers and ids are taken at one time", async () => {
  const { planner, log, change } = planned([one, two, three]);
  const { of } = planner.answers;
  planner.answers.of = (kind, index) => {
    planner.answers.of = of;
    change([two, three]); // another tab
    return of(kind, index);
  };
  assert.ok(await toggleMark(planner, [1], "pin"));
  assert.deepEqual(log.done[0].each, [{ index: 0, id: "B", on: true }]);
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
  const list = unitsOf([2, 3].map((source) => ({ at: [0, source, 3], kind: "list", source })));
  const shifted = unitsOf([{ at: [0, 3, 3], kind: "list", source: 2 }]);
  assert.equal(indexWith(shifted, traitsOf(list, 1)), 0, "entries of the list move up");
  const twice = unitsOf([0, 1].map((source) => ({ at: [0, 3, 3], kind: "list", source })));
  assert.equal(indexWith(twice, traitsOf(list, 1)), undefined, "two entries at one place");
});
