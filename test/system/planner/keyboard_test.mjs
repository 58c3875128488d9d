// Tests the whole planner without a pointer: none of these tests calls the mouse or clicks.

import { check, equal, says } from "../viewer/check.mjs";
import { wait } from "./light.mjs";
import { testPlanner } from "./opened.mjs";
import { smallShop } from "./small_shop.mjs";
import { axisNear, isAt, last, said } from "./units.mjs";

const focusedKey = (tab) =>
  tab.page.evaluate(() => {
    const { dataset, id } = document.activeElement;
    return dataset.key ?? dataset.command ?? id;
  });

/** Presses a key until the control with a key or id has the focus. */
async function reach(tab, wanted, key = "Tab") {
  for (let k = 0; k < 90; ++k) {
    if ((await focusedKey(tab)) === wanted) return;
    await tab.page.keyboard.press(key);
  }
  throw new Error(`${key} does not reach ${wanted}`);
}

/** Opens a list at the left by its tab. */
async function open(tab, name) {
  for (let k = 0; k < 90; ++k) {
    if (await tab.page.evaluate(() => document.activeElement.role === "tab")) break;
    await tab.page.keyboard.press("Tab");
  }
  await reach(tab, `tab-${name}`, "ArrowDown");
  await tab.settle();
}

/** Goes to the list of elements. */
async function toList(tab) {
  for (let k = 0; k < 4; ++k) {
    if (await tab.page.evaluate(() => document.activeElement.role === "listbox")) return;
    await tab.press("F6");
  }
  throw new Error("F6 does not reach the list");
}

async function toPlan(tab) {
  for (let k = 0; k < 4; ++k) {
    if (await tab.page.evaluate(() => document.activeElement.className === "surface")) return;
    await tab.press("F6");
  }
  throw new Error("F6 does not reach the plan");
}

/** Runs a command of the list of commands. */
async function run(tab, name) {
  await tab.press("Control+k");
  await tab.page.keyboard.type(name);
  await tab.until((of) => document.querySelector(".results li span")?.textContent === of, name);
  await tab.press("Enter");
}

async function find(tab, name) {
  await tab.press("Control+f");
  await tab.page.keyboard.type(name);
  await tab.until((of) => document.querySelector(".results li span")?.textContent === of, name);
  await tab.press("Enter");
}

testPlanner("by keys: elements from the list, aligned, and dissolved", {}, async (tab) => {
  await toList(tab);
  await tab.press("Home", "ArrowDown", "ArrowDown");
  equal(await tab.selected(), ["/fixtures/1"]);
  await toPlan(tab);
  await tab.press("Shift+ArrowRight");
  await tab.steps(1);
  await toList(tab);
  await tab.press("Shift+ArrowDown", "Shift+ArrowDown");
  equal(await tab.selected(), ["/fixtures/1", "/fixtures/2", "/fixtures/3"]);
  await run(tab, "Align left");
  await tab.steps(2);
  equal(
    tab.json.fixtures.slice(1, 4).map(({ at }) => at[0]),
    [5, 5, 5],
  );
  equal((await tab.labels())[1], "Align 3 fixtures");
  await toList(tab);
  await tab.press("Home", ...Array(5).fill("ArrowDown"));
  equal(await tab.selected(), ["/fixtures/4"]);
  await run(tab, "Dissolve");
  await tab.steps(3);
  equal(
    tab.json.fixtures.slice(4, 8).map(({ id }) => id),
    ["A1-west", "A2-west", "A3-west", "A4-west"],
  );
});

testPlanner("by keys: layers hidden and locked, and shown again", {}, async (tab) => {
  await open(tab, "layers");
  await reach(tab, "show-grid");
  await tab.press("Space");
  equal(await focusedKey(tab), "show-grid", "the focus stays");
  await reach(tab, "lock-fixture", "Shift+Tab");
  await tab.press("Enter");
  await toPlan(tab);
  await tab.press("Control+a");
  equal(await tab.selected(), ["/transceivers/keep_out/0"]);
  await run(tab, "Show all layers");
  await tab.press("Control+a");
  check((await tab.selected()).includes("/transceivers/grids/0"), "the grid is shown again");
});

testPlanner("by keys: types edited and given, and the history", {}, async (tab) => {
  await open(tab, "types");
  await reach(tab, "/label_types/standard");
  await tab.press("Enter");
  await reach(tab, "field/safety_factor");
  await tab.page.keyboard.type("1.4");
  await tab.press("Enter");
  await tab.steps(1);
  equal(tab.json.label_types.standard.safety_factor, 1.4);
  await find(tab, "A3");
  await tab.press("3");
  await tab.steps(2);
  equal(tab.json.fixtures[2].preset, "wall");
  await open(tab, "history");
  await reach(tab, "step1");
  await tab.press("Enter");
  await tab.steps(1);
  equal(tab.json.fixtures[2].preset, "row");
  equal(await tab.text(".history [aria-current]"), "Safety factor of standard");
  await reach(tab, "step2", "Shift+Tab");
  await tab.press("Space");
  await tab.steps(2);
});

testPlanner("by keys: labels of fixtures, with L from the plan", {}, async (tab) => {
  await toPlan(tab);
  await tab.press("l");
  says(await tab.text(".notice"), "Select shelving, a freezer or a table first: its properties set the labels.");
  await find(tab, "A3");
  await tab.press("l", "Tab");
  await reach(tab, "field/labels/spacing");
  await tab.page.keyboard.type("0.5");
  await tab.press("Enter");
  await tab.steps(1);
  equal(tab.json.fixtures[2].labels.spacing, 0.5);
});

testPlanner("by keys: found, copied, pasted and deleted", { alone: true }, async (tab) => {
  await find(tab, "F2");
  equal(await tab.selected(), ["/fixtures/9"]);
  await tab.press("Control+c");
  says(await tab.text(".notice"), "Copied: F2");
  await tab.press("Control+v");
  await tab.steps(1);
  equal([tab.json.fixtures.length, tab.json.fixtures[13].id], [14, "F3"]);
  equal(await tab.selected(), ["/fixtures/13"]);
  await tab.press("Delete");
  await tab.steps(2);
  equal(tab.json.fixtures.length, 13);
});

testPlanner("by keys: 3-D and back, the menu, and a measurement", {}, async (tab) => {
  await find(tab, "A3");
  const selected = await tab.selected();
  await tab.page.focus(".plan .surface");
  await tab.press("d");
  await tab.until(() => document.querySelector(".plan").classList.contains("space"));
  await tab.until(() => document.activeElement.tagName === "CANVAS");
  await tab.press("+", "-", "Shift+ArrowUp");
  await tab.steps(1);
  await tab.press("d");
  equal(await tab.selected(), selected);
  await tab.until(() => document.activeElement.classList.contains("surface"));
  await tab.press("Shift+F10");
  await reach(tab, "duplicate", "ArrowDown");
  await tab.press("Enter");
  await tab.steps(2);
  equal(await tab.page.$(".menu"), null);
  await tab.press("m", "Enter", "Shift+ArrowRight", "Shift+ArrowRight", "Enter");
  check(
    /\d m$/.test((await tab.text(".overlay .reading")).replace(/\u00a0/g, " ")),
    await tab.text(".overlay .reading"),
  );
  await tab.press("Escape", "Escape");
  equal(await tab.page.$(".overlay .measure"), null);
});

testPlanner("by keys: a plan is asked for, and examined", { store: "thesis", prepare: smallShop() }, async (tab) => {
  await open(tab, "plans");
  await reach(tab, "plan-start");
  await tab.press("Enter");
  await wait(tab, () => window.shelfbeamPlanner.planner.plans.runs[0]?.state === "done");
  await tab.until(() => window.shelfbeamPlanner.planner.plans.runs[0].entered);
  equal(await focusedKey(tab), "plan-start", "the focus stays");
  await tab.until(() => document.querySelector(".plan-result .files") !== null);
  const isReport = () => tab.page.evaluate(() => document.activeElement.textContent === "Report");
  for (let k = 0; k < 30 && !(await isReport()); ++k) await tab.page.keyboard.press("Tab");
  check(await isReport(), "Tab reaches the report");
  await reach(tab, "plan-1");
  await tab.press("Enter");
  equal(await tab.text('.plan-list [aria-current="true"]'), "plan");
});

/** The unit that the next test places is the last of the list. */
const placedUnit = (tab) => last(tab.json.transceivers.list);

testPlanner("by keys: a unit is placed, moved, directed, exchanged and marked", { store: "chiller" }, async (tab) => {
  let steps = 0;
  const step = () => tab.steps(++steps);
  await toPlan(tab);
  await tab.press("u", "Shift+ArrowRight", "Shift+ArrowUp");
  await said(tab, "below the ceiling");
  await tab.press("Enter");
  await step();
  const { position, id } = placedUnit(tab);
  const state = () => {
    const { pinned = [], installed = [], excluded = [], selected = [] } = tab.json.transceivers;
    const lists = { pinned, installed, excluded, selected };
    return Object.keys(lists).find((name) => lists[name].includes(id)) ?? null;
  };
  equal(state(), "pinned");
  await tab.press("Escape", "Shift+ArrowRight");
  await step();
  isAt(placedUnit(tab).position, [position[0] + 0.1, position[1], position[2]], 1e-3);
  await tab.press("r");
  await step();
  equal(placedUnit(tab).roll_deg, 270);
  await run(tab, "Tilt the unit …");
  await tab.page.keyboard.type("20");
  await tab.press("Enter");
  await step();
  await reach(tab, "unit/heading");
  await tab.page.keyboard.type("E");
  await tab.press("Enter");
  await step();
  axisNear(placedUnit(tab).axis, [0.34202, 0, -0.939693]);
  await run(tab, "Change the type of the unit …");
  await tab.press("ArrowDown");
  await step();
  equal(placedUnit(tab).type, "spot");
  await toPlan(tab);
  for (const [key, expected] of [
    ["x", "excluded"],
    ["x", null],
    ["q", "selected"],
    ["q", null],
    ["i", "installed"],
    ["i", null],
    ["p", "pinned"],
  ]) {
    await tab.press(key);
    await step();
    equal(state(), expected, key);
  }
  for (; steps > 0; ) {
    await tab.press("Control+z");
    await tab.steps(--steps);
  }
  check(await tab.isUntouched(), "undo brings everything back");
});

testPlanner("by keys: the light, from the weakest label to 3-D", { store: "chiller", light: true }, async (tab) => {
  await wait(tab, () => window.shelfbeamPlanner.planner.light.stage === "simulated");
  await open(tab, "light");
  await tab.press("Tab");
  await tab.until(() => document.activeElement.name === "palette");
  await tab.press("ArrowRight");
  equal(await tab.page.evaluate(() => window.shelfbeamPlanner.planner.light.palette), "clear");
  await tab.press("Tab");
  says(await focusedKey(tab), "weak-");
  await tab.press("Enter");
  const [selected] = await tab.page.evaluate(() => window.shelfbeamPlanner.planner.selection.items);
  equal(selected.device, "label");
  await tab.press("F6", "F6");
  await reach(tab, "light");
  const read = await tab.page.locator("[data-key=light]").ariaSnapshot();
  says(read, "Light", "term: Signal", "term: Standard error", "term: Requirement", "term: Margin", "mW/m²", "dB");
  await open(tab, "layers");
  await reach(tab, "level-0");
  await tab.press("Space");
  const isShown = () => window.shelfbeamPlanner.planner.layers.isShown("level-0");
  equal(await tab.page.evaluate(isShown), false);
  await run(tab, "Show all layers");
  equal(await tab.page.evaluate(isShown), true);
  await toPlan(tab);
  await tab.press("d");
  await tab.until(() => document.activeElement.tagName === "CANVAS");
  const view = () => tab.page.evaluate(() => JSON.stringify(window.shelfbeamPlanner.page.stage.cameraPlace()));
  await tab.press("Escape");
  const before = await view();
  await tab.press("ArrowLeft", "+");
  check((await view()) !== before, "3-D turns");
});
