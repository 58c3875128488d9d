// Tests units: placed by a click, moved by arrow keys, and changed by keys and the panel.

import { check, equal, says } from "../viewer/check.mjs";
import { placed, testAxe, testPlanner } from "./opened.mjs";
import { axisNear, chooseUnit, isAt, said, unitAt } from "./units.mjs";

const inHall = { store: "market-hall" };
const lastUnit = (tab) => tab.json.transceivers.list.at(-1);
const reachesPinned = (tab, count) =>
  tab.reaches(({ planner }, of) => planner.document.units.state.filter((state) => state === 2).length === of, count);

testPlanner("units: a click places one below the ceiling, pinned or installed", { smoke: true }, async (tab) => {
  await tab.press("u");
  says(await tab.text(".status .hint"), "Click to place");
  await tab.holding(["Alt"], async () => {
    await tab.point(12, 8.4);
    await said(tab, "below the ceiling, 3.55 m");
    await tab.picture("unit-ghost");
  });
  await tab.freely([12, 8.4]);
  await tab.steps(1);
  equal(await tab.labels(), ["Place a unit"]);
  const { list, pinned } = tab.json.transceivers;
  equal([list.length, list[0].id, list[0].type, pinned], [1, "U1", "ceiling", ["U1"]]);
  placed(list[0].position, [12, 8.4, 3.55]);
  equal(await tab.selected(), ["/transceivers/list/0"]);
  await tab.click(13, 8.4, { keys: ["Shift"] });
  await tab.steps(2);
  equal(tab.json.transceivers.installed, ["U2"]);
  await tab.choose("tool/Status", "mounted already");
  await tab.click(14, 8.4);
  await tab.steps(3);
  equal(tab.json.transceivers.installed, ["U2", "U3"]);
  await tab.press("Escape");
  equal(await tab.tool(), "select");
});

testPlanner("units: no two at one place, and none in a keep-out area", {}, async (tab) => {
  await tab.press("u");
  await tab.page.mouse.dblclick(...(await tab.at(12, 8.4)));
  await tab.steps(1);
  await tab.notice("There is a unit on the plan at this place already");
  await tab.click(21.5, 13.6);
  await tab.notice("Units cannot be placed in a keep-out area");
  await tab.press("Escape");
  await tab.hush();
  await tab.drag([12, 8.4], [21.5, 13.6]);
  await tab.notice("Units cannot be placed in a keep-out area");
  equal([await tab.labels(), tab.json.transceivers.list.length], [["Place a unit"], 1]);
});

testPlanner("units: rails and faces attract, unless Alt or the panel says no", inHall, async (tab) => {
  await tab.press("u");
  await tab.choose("tool/Type", "spot");
  await tab.point(17.05, 6);
  await said(tab, "on rail rail, 3.20 m");
  await tab.point(8.5, 3.95);
  await said(tab, "on the face of column 2");
  await tab.fill("tool/faceTilt", "20");
  await tab.page.focus(".surface");
  await tab.click(8.5, 3.95);
  await tab.steps(1);
  const { type, axis } = lastUnit(tab);
  equal(type, "spot");
  check(axis[1] < -0.9 && Math.abs(axis[2] + Math.sin(Math.PI / 9)) < 1e-4, `faces south: ${axis}`);
  await tab.holding(["Alt"], async () => {
    await tab.point(17.2, 6.2);
    await said(tab, "below the ceiling");
  });
  await tab.choose("tool/Snap to", "the ceiling only");
  await tab.fill("tool/unitTilt", "30");
  await tab.fill("tool/heading", "90");
  await tab.page.focus(".surface");
  await tab.point(17, 6.3);
  await said(tab, "below the ceiling");
  await tab.click(17, 6.3);
  await tab.steps(2);
  axisNear(lastUnit(tab).axis, [0.5, 0, -0.866025]);
});

testPlanner("units: keys switch, pin, exclude, install, move and turn", { smoke: true }, async (tab) => {
  const { id, at } = await chooseUnit(tab, 12, 8);
  const lists = () => {
    const { selected = [], pinned = [], excluded = [], installed = [] } = tab.json.transceivers;
    return { selected, pinned, excluded, installed };
  };
  const none = { selected: [], pinned: [], excluded: [], installed: [] };
  let steps = 0;
  const press = async (key, expected, state) => {
    await tab.press(key);
    await tab.steps(++steps);
    equal(lists(), { ...none, ...expected }, key);
    if (state) equal((await unitAt(tab, ...at)).state, state);
  };
  await press("q", { selected: [id] }, 4);
  await press("p", { selected: [id], pinned: [id] });
  await press("i", { selected: [id], installed: [id] });
  await press("x", { excluded: [id] }, 3);
  says(await tab.text(".properties .subtitle"), "Excluded candidate");
  await press("x", {});
  equal(await tab.labels(), [
    `Switch unit ${id} on`,
    `Pin unit ${id}`,
    `Mark unit ${id} as installed`,
    `Exclude unit ${id}`,
    `Allow unit ${id}`,
  ]);
  await tab.press("Delete");
  await tab.notice("Press X to exclude this one");
  const isMoved = (x, y) => isAt(lastUnit(tab).position, [at[0] + x, at[1] + y, 3.58], 1e-3);
  const own = { pinned: ["U1"] };
  await press("Shift+ArrowRight", own);
  isMoved(0.1, 0);
  await press("r", own);
  equal(lastUnit(tab).roll_deg, 270);
  await press("ArrowUp", own);
  isMoved(0.1, 0.01);
  equal(await tab.selected(), ["/transceivers/list/0"]);
  await press("Delete", none);
  equal(tab.json.transceivers.list, [], "the unit of its own is gone, also from the lists");
});

testPlanner("units: the panel tilts, directs and changes a candidate", inHall, async (tab) => {
  const choose = () => chooseUnit(tab, 4, 3, "A1-");
  const undo = async (...keys) => {
    await tab.press(...keys);
    await tab.steps(0);
  };
  await choose();
  await tab.fill("unit/tilt", "30");
  await tab.steps(1);
  axisNear(lastUnit(tab).axis, [0, 0.5, -0.866025]);
  equal(await tab.selected(), ["/transceivers/list/0"]);
  await tab.fill("unit/heading", "E");
  await tab.steps(2);
  axisNear(lastUnit(tab).axis, [0.5, 0, -0.866025]);
  await tab.picture("unit-panel");
  await undo("Control+z", "Control+z");
  await choose();
  await tab.fill("unit/power", "0.5");
  await tab.steps(1);
  equal(lastUnit(tab).relative_power, 0.5);
  await undo("Control+z");
  await choose();
  await tab.choose("unit/type", "spot");
  await tab.steps(1);
  equal(lastUnit(tab).type, "spot");
  says((await tab.labels()).at(-1), "spot for unit A1-");
  await chooseUnit(tab, 7, 3, "A1-");
  await tab.press("2");
  await tab.steps(2);
  equal(lastUnit(tab).type, "spot", "by its number key");
});

testPlanner("units: several at once, from the menu and the list of commands", {}, async (tab) => {
  const units = [await unitAt(tab, 11.4, 8), await unitAt(tab, 12.5, 8), await unitAt(tab, 13.7, 8)];
  for (const { place } of units) await tab.click(...place, { keys: ["Shift"] });
  says(await tab.text(".properties h2"), "3 units");
  await tab.press("p");
  await reachesPinned(tab, 3);
  equal(tab.json.transceivers.pinned.length, 3);
  equal((await tab.selected()).length, 3, "they stay selected");
  equal([...new Set(await tab.labels())], ["Pin 3 units"]);
  await tab.page.click(".surface", { button: "right", position: { x: 1, y: 1 } });
  await tab.press("Escape", "Escape");
  await tab.click(...units[0].place, { button: "right" });
  await tab.push('[data-command="unit_pin"]');
  await reachesPinned(tab, 2);
});

testPlanner("units: the second of two quick commands waits for the first, and keeps its unit", {}, async (tab) => {
  const second = await chooseUnit(tab, 14, 8);
  const shifting = await chooseUnit(tab, 10, 8);
  const first = await chooseUnit(tab, 12, 8);
  const release = tab.server.wire.hold();
  await tab.press("r", "r"); // after the first, the unit is an entry of the list
  await tab.click(...shifting.place);
  await tab.press("x"); // shifts all later numbers
  await tab.click(...second.place);
  await tab.press("p");
  release();
  await tab.steps(4);
  const { list, pinned, excluded } = tab.json.transceivers;
  equal([list.length, list[0].roll_deg, pinned, excluded], [1, 180, ["U1", second.id], [shifting.id]]);
  equal(await tab.text(".properties h2"), second.id, "late answers select nothing else");
  isAt(list[0].position, first.at, 1e-3);
  await tab.press("Escape");
  await tab.click(...first.place);
  await tab.click(...second.place, { keys: ["Shift"] });
  await tab.press("Delete");
  await tab.steps(5);
  equal([tab.json.transceivers.list, tab.json.transceivers.pinned], [[], []], "both kinds in one step");
  equal((await tab.labels()).at(-1), "Delete 2 units");
});

testPlanner("units: a number that another tab has shifted is refused", {}, async (tab, given) => {
  const { wire } = tab.server;
  const other = await given.tab(tab.server);
  await chooseUnit(other, 12, 8);
  const { id } = await chooseUnit(tab, 14, 8);
  const release = wire.hold();
  await tab.press("p");
  await wire.holds(1);
  wire.hold()();
  await other.press("x"); // shifts all later numbers
  await other.steps(1);
  await tab.reaches(({ planner }) => planner.document.history.position === 1);
  release();
  await tab.notice("has another number by now");
  equal(tab.json.transceivers.pinned, undefined, "no other unit is pinned");
  await tab.press("p");
  await tab.steps(2);
  equal(tab.json.transceivers.pinned, [id]);
});

testAxe("units", inHall, async (tab, clean) => {
  for (const key of ["u", "t", "c"]) {
    await tab.press(key);
    await clean(`tool ${key}`);
  }
  await tab.press("Escape");
  const { place } = await unitAt(tab, 4, 3);
  await tab.click(...place);
  await tab.until(() => document.querySelector('[data-key="unit/type"]') !== null);
  await clean("a candidate");
  await tab.press("Shift+F10");
  await clean("its menu");
  await tab.press("Escape");
});
