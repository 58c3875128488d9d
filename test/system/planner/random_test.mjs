// Tests two tabs that change the same store at the same time, at random, with a seed that a failure names.

import { check, equal } from "../viewer/check.mjs";
import { testPlanner } from "./opened.mjs";
import { randomFrom } from "./random.mjs";

const edits = 40; // of each tab

/** Some are listed twice, because they shall happen more often. */
const keys = [
  ...["ArrowRight", "ArrowUp", "Shift+ArrowLeft", "Shift+ArrowDown", "r", "r", "Shift+R", "Shift+V", "Shift+H"],
  ...["Control+d", "Control+d", "Delete", "2", "3", "Control+z", "Control+y"],
];

/** Selects one or two elements, and changes them by a key or by a value of their own. */
async function changeSomething(tab, random) {
  const numbers = [random(), random(), random()];
  const isValue = random() < 0.25;
  await tab.state(
    ({ planner: { document: store, selection } }, [first, second, third], setsValue) => {
      const { fixtures } = store.json;
      const paths = [first, second].map((share) => `/fixtures/${Math.floor(share * fixtures.length)}`);
      selection.setPaths([...paths.slice(0, third < 0.3 ? 2 : 1), ...(third > 0.95 ? ["/transceivers/grids/0"] : [])]);
      if (!setsValue || fixtures.length === 0) return;
      const index = Math.floor(first * fixtures.length);
      const before = fixtures[index].stocking;
      const op = { path: `/fixtures/${index}/stocking`, after: Number((0.3 + 0.7 * third).toFixed(3)) };
      void store.edit({ label: "Stocking", ops: [before === undefined ? op : { ...op, before }] });
    },
    numbers,
    isValue,
  );
  if (!isValue) await tab.page.keyboard.press(keys[Math.floor(random() * keys.length)]);
}

/** Until the server has answered everything that the tab has asked, also what follows from answers. */
async function quiet(tab) {
  for (let k = 0; k < 3; ++k) {
    await tab.state(({ planner }) => planner.document.request("find", { text: "A1" }));
    await tab.settle();
  }
  await tab.reaches(({ planner }) => planner.document.saving.state !== "saving");
}

/** Until a number of steps are applied. Of two edits of one element at the same time, one can remain refused. */
const applied = (tab, count) =>
  tab.reaches(
    ({ planner: { document: store } }, expected) =>
      store.history.position === expected && store.saving.state !== "saving",
    count,
  );

/** What a tab knows, with the keys of objects in order. */
const stateOf = (tab) =>
  tab.state(({ planner }) => {
    const ordered = (value) =>
      Array.isArray(value)
        ? value.map(ordered)
        : value !== null && typeof value === "object"
          ? Object.fromEntries(
              Object.keys(value)
                .sort()
                .map((key) => [key, ordered(value[key])]),
            )
          : value;
    const { json, parts, problems, history, revision, labels, units } = planner.document;
    const rounded = (devices) => [...devices.position.slice(0, 3 * devices.count)].map((one) => one.toFixed(4)).join();
    return ordered({
      json,
      parts: [...parts.all].sort((a, b) => (a.key < b.key ? -1 : 1)),
      problems,
      steps: history.steps.map(({ label }) => label),
      position: history.position,
      revision,
      labels: rounded(labels),
      units: rounded(units),
    });
  });

/** Names the first difference, not the whole stores. */
function same(found, expected, what) {
  for (const key of Object.keys(expected)) equal(found[key], expected[key], `${what}, ${key}`);
}

for (const seed of [1, 2])
  testPlanner(`two tabs that change the store at random agree, seed ${seed}`, {}, async (tab, given) => {
    const other = await given.tab(tab.server);
    const tabs = [tab, other];
    await Promise.all(
      tabs.map(async (one, k) => {
        const random = randomFrom(10 * seed + k);
        await one.page.focus(".surface");
        for (let n = 0; n < edits; ++n) await changeSomething(one, random);
      }),
    );
    for (const one of [...tabs, ...tabs]) await quiet(one);
    const { revision } = await stateOf(tab);
    await other.reaches(({ planner }, of) => planner.document.revision >= of, revision);
    const fresh = await given.tab(tab.server);
    const expected = await stateOf(fresh);
    check(expected.steps.length > edits, `${expected.steps.length} steps`);
    for (const [k, one] of tabs.entries()) same(await stateOf(one), expected, `tab ${k + 1}`);
    equal(await fresh.state(({ planner }) => planner.document.json), tab.json, "the file");
    const last = tab.server.text;
    const { position } = expected;
    await other.push("#tab-history");
    await other.use("step0");
    for (const one of [...tabs, fresh]) await applied(one, 0);
    check(tab.server.text === tab.server.first, "undoing everything brings the first bytes back");
    await other.use(`step${position}`);
    await applied(tab, position);
    check(tab.server.text === last, "redoing everything brings the last bytes back");
    await other.use("step0");
    await applied(tab, 0);
    equal(other.errors, [], "errors in the console of the other tab");
  });
