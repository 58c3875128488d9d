// Tests the whole planner without a pointer: none of these tests calls the mouse or clicks.

import { check, equal, says } from "../viewer/check.mjs";
import { testPlanner } from "./opened.mjs";
import { smallShop } from "./shops.mjs";
import { axisNear, isAt, said } from "./units.mjs";

/** Presses a key until the condition holds. */
async function pressUntil(tab, key, condition, what) {
  for (let k = 0; k < 90; ++k) {
    if (await condition()) return;
    await tab.page.keyboard.press(key);
  }
  throw new Error(`${key} does not reach ${what}`);
}

/** Presses a key until the control with a key, a command, or an id has the focus. */
const reach = (tab, wanted, key = "Tab") => pressUntil(tab, key, async () => (await tab.focused()) === wanted, wanted);

/** Opens a list at the left by its tab. */
async function open(tab, name) {
  await pressUntil(tab, "Tab", () => tab.evaluate(() => document.activeElement.role === "tab"), "the tabs");
  await reach(tab, `tab-${name}`, "ArrowDown");
  await tab.settle();
}

const toList = (tab) =>
  pressUntil(tab, "F6", () => tab.evaluate(() => document.activeElement.role === "listbox"), "the list");
const toPlan = (tab) => reach(tab, "surface", "F6");

testPlanner("by keys: elements from the list, moved, aligned, changed, and dissolved", { smoke: true }, async (tab) => {
  await pressUntil(tab, "Tab", () => tab.evaluate(() => document.activeElement.role === "listbox"), "the list");
  await tab.press("Home", "ArrowDown", "ArrowDown");
  equal(await tab.selected(), ["/fixtures/1"]);
  await toPlan(tab);
  await tab.press("Shift+ArrowRight");
  await tab.steps(1);
  await toList(tab);
  await tab.press("Shift+ArrowDown", "Shift+ArrowDown");
  equal(await tab.selected(), ["/fixtures/1", "/fixtures/2", "/fixtures/3"]);
  await tab.run("Align left");
  await tab.steps(2);
  equal(
    tab.json.fixtures.slice(1, 4).map(({ at }) => at[0]),
    [5, 5, 5],
  );
  equal((await tab.labels())[1], "Align 3 fixtures");
  await toPlan(tab);
  await tab.press("PageDown");
  equal((await tab.selected()).length, 1);
  await tab.press("F6");
  await reach(tab, "field/height");
  await tab.page.keyboard.type("1.9");
  await tab.press("Enter");
  await tab.steps(3);
  await toList(tab);
  await tab.press("Home", ...Array(5).fill("ArrowDown"));
  equal(await tab.selected(), ["/fixtures/4"]);
  await tab.run("Dissolve");
  await tab.steps(4);
  equal(
    tab.json.fixtures.slice(4, 8).map(({ id }) => id),
    ["A1-west", "A2-west", "A3-west", "A4-west"],
  );
});

testPlanner("by keys: layers hidden and locked, and shown again", {}, async (tab) => {
  await open(tab, "layers");
  await reach(tab, "show-grid");
  await tab.press("Space");
  equal(await tab.focused(), "show-grid", "the focus stays");
  await reach(tab, "lock-fixture", "Shift+Tab");
  await tab.press("Enter");
  await toPlan(tab);
  await tab.press("Control+a");
  equal(await tab.selected(), ["/transceivers/keep_out/0"]);
  await tab.run("Show all layers");
  await tab.press("Control+a");
  check((await tab.selected()).includes("/transceivers/grids/0"), "the grid is shown again");
});

testPlanner("by keys: types edited and given, labels of fixtures, and the history", {}, async (tab) => {
  await toPlan(tab);
  await tab.press("l");
  await tab.notice("Select shelving, a freezer or a table first: its properties set the labels.");
  await open(tab, "types");
  await reach(tab, "/label_types/standard");
  await tab.press("Enter");
  await reach(tab, "field/safety_factor");
  await tab.page.keyboard.type("1.4");
  await tab.press("Enter");
  await tab.steps(1);
  equal(tab.json.label_types.standard.safety_factor, 1.4);
  await tab.find("A3");
  await tab.press("3");
  await tab.steps(2);
  equal(tab.json.fixtures[2].preset, "wall");
  await tab.press("l", "Tab");
  await reach(tab, "field/labels/spacing");
  await tab.page.keyboard.type("0.5");
  await tab.press("Enter");
  await tab.steps(3);
  equal(tab.json.fixtures[2].labels.spacing, 0.5);
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

testPlanner("by keys: found, copied, pasted and deleted", { alone: true }, async (tab) => {
  await tab.find("F2");
  equal(await tab.selected(), ["/fixtures/9"]);
  await tab.press("Control+c");
  await tab.notice("Copied: F2");
  await tab.press("Control+v");
  await tab.steps(1);
  equal([tab.json.fixtures.length, tab.json.fixtures[13].id], [14, "F3"]);
  equal(await tab.selected(), ["/fixtures/13"]);
  await tab.press("Delete");
  await tab.steps(2);
  equal(tab.json.fixtures.length, 13);
});

testPlanner("by keys: 3-D and back, the menu, and a measurement", {}, async (tab) => {
  await tab.find("A3");
  const selected = await tab.selected();
  await toPlan(tab);
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
  check(!(await tab.has(".menu")), "the menu is closed");
  await tab.press("m", "Enter", "Shift+ArrowRight", "Shift+ArrowRight", "Enter");
  says(await tab.text(".overlay .reading"), " m");
  await tab.press("Escape", "Escape");
  check(!(await tab.has(".overlay .measure")), "the measurement is gone");
});

testPlanner("by keys: a plan is asked for, and examined", { store: "thesis", prepare: smallShop() }, async (tab) => {
  await open(tab, "plans");
  await reach(tab, "plan-start");
  await tab.press("Enter");
  await tab.computes(({ planner }) => planner.plans.runs[0]?.state === "done");
  await tab.reaches(({ planner }) => planner.plans.runs[0].entered);
  equal(await tab.focused(), "plan-start", "the focus stays");
  await tab.until(() => document.querySelector(".plan-result .files") !== null);
  await pressUntil(tab, "Tab", () => tab.evaluate(() => document.activeElement.textContent === "Report"), "the report");
  await reach(tab, "plan-1");
  await tab.press("Enter");
  equal(await tab.text('.plan-list [aria-current="true"]'), "plan");
});

testPlanner("by keys: a unit is placed, moved, directed, exchanged and marked", { store: "chiller" }, async (tab) => {
  let steps = 0;
  const step = () => tab.steps(++steps);
  const unit = () => tab.json.transceivers.list.at(-1); // the one that the test places
  await toPlan(tab);
  await tab.press("u", "Shift+ArrowRight", "Shift+ArrowUp");
  await said(tab, "below the ceiling");
  await tab.press("Enter");
  await step();
  const { position, id } = unit();
  const state = () => {
    const { pinned = [], installed = [], excluded = [], selected = [] } = tab.json.transceivers;
    const lists = { pinned, installed, excluded, selected };
    return Object.keys(lists).find((name) => lists[name].includes(id)) ?? null;
  };
  equal(state(), "pinned");
  await tab.press("Escape", "Shift+ArrowRight");
  await step();
  isAt(unit().position, [position[0] + 0.1, position[1], position[2]], 1e-3);
  await tab.press("r");
  await step();
  equal(unit().roll_deg, 270);
  await tab.run("Tilt the unit …");
  await tab.page.keyboard.type("20");
  await tab.press("Enter");
  await step();
  await reach(tab, "unit/heading");
  await tab.page.keyboard.type("E");
  await tab.press("Enter");
  await step();
  axisNear(unit().axis, [0.34202, 0, -0.939693]);
  await tab.run("Change the type of the unit …");
  await tab.press("ArrowDown");
  await step();
  equal(unit().type, "spot");
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
  await tab.press("Escape", "Escape");
  await toList(tab);
  await reach(tab, "SELECT", "Shift+Tab");
  await tab.page.keyboard.type("Units"); // a space would open the list
  await tab.until(() => document.activeElement.selectedOptions[0].label === "Units on the plan");
  await tab.settle();
  says(await tab.text(".object-list"), id, "Pinned unit");
});

testPlanner("by keys: the light, from the weakest label to 3-D", { store: "chiller", light: true }, async (tab) => {
  await tab.computes(({ planner }) => planner.light.stage === "simulated");
  await open(tab, "light");
  await tab.press("Tab");
  await tab.until(() => document.activeElement.name === "palette");
  await tab.press("ArrowRight");
  equal(await tab.state(({ planner }) => planner.light.palette), "clear");
  await tab.press("Tab");
  says(await tab.focused(), "weak-");
  await tab.press("Enter");
  equal(await tab.state(({ planner }) => planner.selection.items[0].device), "label");
  await tab.press("F6", "F6");
  await reach(tab, "light");
  const read = await tab.page.locator("[data-key=light]").ariaSnapshot();
  says(read, "Light", "term: Signal", "term: Standard error", "term: Requirement", "term: Margin", "mW/m²", "dB");
  await open(tab, "layers");
  await reach(tab, "level-0");
  await tab.press("Space");
  const isShown = () => tab.state(({ planner }) => planner.layers.isShown("level-0"));
  equal(await isShown(), false);
  await tab.run("Show all layers");
  equal(await isShown(), true);
  await toPlan(tab);
  await tab.press("d");
  await tab.until(() => document.activeElement.tagName === "CANVAS");
  const view = () => tab.state(({ page }) => JSON.stringify(page.stage.cameraPlace()));
  await tab.press("Escape");
  const before = await view();
  await tab.press("ArrowLeft", "+");
  check((await view()) !== before, "3-D turns");
});
