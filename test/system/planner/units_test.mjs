// Tests units: placed by a click, moved by arrow keys, and changed by keys and the panel.

import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { check, equal, says } from "../viewer/check.mjs";
import { findings } from "./findings.mjs";
import { placed, testPlanner } from "./opened.mjs";
import { axisNear, isAt, last, notice, said, unitAt } from "./units.mjs";

testPlanner("units: a click places one below the ceiling, pinned or installed", { smoke: true }, async (tab) => {
  await tab.press("u");
  says(await tab.text(".status .hint"), "Click to place");
  await tab.page.keyboard.down("Alt");
  await tab.point(12, 8.4);
  await said(tab, "below the ceiling, 3.55 m");
  await tab.picture("unit-ghost");
  await tab.click(12, 8.4);
  await tab.page.keyboard.up("Alt");
  await tab.steps(1);
  equal(await tab.labels(), ["Place a unit"]);
  const { list, pinned } = tab.json.transceivers;
  equal([list.length, list[0].id, list[0].type, pinned], [1, "U1", "ceiling", ["U1"]]);
  placed(list[0].position, [12, 8.4, 3.55]);
  equal(await tab.selected(), ["/transceivers/list/0"]);
  await tab.page.keyboard.down("Shift");
  await tab.click(13, 8.4);
  await tab.page.keyboard.up("Shift");
  await tab.steps(2);
  equal(tab.json.transceivers.installed, ["U2"]);
  await tab.choose("tool/Status", "mounted already");
  await tab.click(14, 8.4);
  await tab.steps(3);
  equal(tab.json.transceivers.installed, ["U2", "U3"]);
  await tab.press("Escape");
  equal(await tab.page.evaluate(() => window.shelfbeamPlanner.planner.tool), "select");
});

testPlanner("units: no two at one place, and none in a keep-out area", {}, async (tab) => {
  await tab.press("u");
  await tab.page.mouse.dblclick(...(await tab.at(12, 8.4)));
  await tab.steps(1);
  await notice(tab, "There is a unit on the plan at this place already");
  await tab.click(21.5, 13.6);
  await notice(tab, "Units cannot be placed in a keep-out area");
  await tab.press("Escape");
  await tab.drag([12, 8.4], [21.5, 13.6]);
  await notice(tab, "Units cannot be placed in a keep-out area");
  equal(await tab.labels(), ["Place a unit"]);
  equal(tab.json.transceivers.list.length, 1);
});

testPlanner(
  "units: rails and faces attract, unless Alt or the panel says no",
  { store: "market-hall" },
  async (tab) => {
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
    const [unit] = tab.json.transceivers.list;
    equal(unit.type, "spot");
    check(unit.axis[1] < -0.9 && Math.abs(unit.axis[2] + Math.sin(Math.PI / 9)) < 1e-4, `faces south: ${unit.axis}`);
    await tab.page.keyboard.down("Alt");
    await tab.point(17.2, 6.2);
    await said(tab, "below the ceiling");
    await tab.page.keyboard.up("Alt");
    await tab.choose("tool/Snap to", "the ceiling only");
    await tab.fill("tool/unitTilt", "30");
    await tab.fill("tool/heading", "90");
    await tab.page.focus(".surface");
    await tab.point(17, 6.3);
    await said(tab, "below the ceiling");
    await tab.click(17, 6.3);
    await tab.steps(2);
    axisNear(last(tab.json.transceivers.list).axis, [0.5, 0, -0.866025]);
  },
);

testPlanner("units: arrow keys move along the surface", {}, async (tab) => {
  const { at } = await unitAt(tab, 12, 8);
  await tab.click(at[0], at[1]);
  await tab.press("Shift+ArrowRight");
  await tab.steps(1);
  isAt(tab.json.transceivers.list[0].position, [at[0] + 0.1, at[1], 3.58], 1e-3);
  await tab.press("ArrowUp");
  await tab.steps(2);
  const [, y] = tab.json.transceivers.list[0].position;
  check(Math.abs(y - at[1] - 0.01) < 1e-3, `one centimetre: ${y - at[1]}`);
  equal(await tab.selected(), ["/transceivers/list/0"]);
});

testPlanner("units: keys switch, pin, exclude, install and turn", { smoke: true }, async (tab) => {
  const { at } = await unitAt(tab, 12, 8);
  await tab.click(at[0], at[1]);
  const id = await tab.until(() => {
    const name = document.querySelector(".properties h2").textContent;
    return name.startsWith("G1-") && name;
  });
  const lists = () => {
    const { selected = [], pinned = [], excluded = [], installed = [] } = tab.json.transceivers;
    return { selected, pinned, excluded, installed };
  };
  const none = { selected: [], pinned: [], excluded: [], installed: [] };
  let steps = 0;
  const press = async (key, expected) => {
    await tab.press(key);
    await tab.steps(++steps);
    equal(lists(), { ...none, ...expected }, key);
  };
  await press("q", { selected: [id] });
  equal((await unitAt(tab, at[0], at[1])).state, 4);
  await press("p", { selected: [id], pinned: [id] });
  await press("i", { selected: [id], installed: [id] });
  await press("x", { excluded: [id] });
  equal((await unitAt(tab, at[0], at[1])).state, 3);
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
  await notice(tab, "Press X to exclude this one");
  await tab.press("r");
  await tab.steps(++steps);
  equal([tab.json.transceivers.list[0].roll_deg, lists().pinned], [270, ["U1"]]);
  await tab.press("Delete");
  await tab.steps(++steps);
  equal([tab.json.transceivers.list, lists()], [[], none], "the unit of its own is gone, also from the lists");
});

testPlanner("units: the panel tilts, directs and changes a candidate", { store: "market-hall" }, async (tab) => {
  const { at } = await unitAt(tab, 4, 3);
  await tab.click(at[0], at[1]);
  await tab.fill("unit/tilt", "30");
  await tab.steps(1);
  axisNear(tab.json.transceivers.list[0].axis, [0, 0.5, -0.866025]);
  equal(await tab.selected(), ["/transceivers/list/0"]);
  await tab.fill("unit/heading", "E");
  await tab.steps(2);
  axisNear(tab.json.transceivers.list[0].axis, [0.5, 0, -0.866025]);
  await tab.picture("unit-panel");
  await tab.press("Control+z", "Control+z");
  await tab.steps(0);
  await tab.press("Escape");
  await tab.click(at[0], at[1]);
  await tab.fill("unit/power", "0.5");
  await tab.steps(1);
  equal(tab.json.transceivers.list[0].relative_power, 0.5);
  await tab.press("Control+z");
  await tab.steps(0);
  await tab.press("Escape");
  await tab.click(at[0], at[1]);
  await tab.choose("unit/type", "spot");
  await tab.steps(1);
  equal(tab.json.transceivers.list[0].type, "spot");
  says(last(await tab.labels()), "spot for unit A1-");
  const { at: other } = await unitAt(tab, 7, 3);
  await tab.press("Escape");
  await tab.click(other[0], other[1]);
  await tab.press("2");
  await tab.steps(2);
  equal(last(tab.json.transceivers.list).type, "spot", "by its number key");
});

testPlanner("units: several at once, from the menu and the list of commands", {}, async (tab) => {
  const units = [await unitAt(tab, 11.4, 8), await unitAt(tab, 12.5, 8), await unitAt(tab, 13.7, 8)];
  await tab.page.keyboard.down("Shift");
  for (const { at } of units) await tab.click(at[0], at[1]);
  await tab.page.keyboard.up("Shift");
  says(await tab.text(".properties h2"), "3 units");
  await tab.press("p");
  await tab.until(
    () => window.shelfbeamPlanner.planner.document.units.state.filter((state) => state === 2).length === 3,
  );
  equal(tab.json.transceivers.pinned.length, 3);
  equal((await tab.selected()).length, 3, "they stay selected");
  equal([...new Set(await tab.labels())], ["Pin 3 units"]);
  await tab.page.click(".surface", { button: "right", position: { x: 1, y: 1 } });
  await tab.press("Escape", "Escape");
  const [x, y] = await tab.at(units[0].at[0], units[0].at[1]);
  await tab.page.mouse.click(x, y, { button: "right" });
  await tab.push('[data-command="unit_pin"]');
  await tab.until(
    () => window.shelfbeamPlanner.planner.document.units.state.filter((state) => state === 2).length === 2,
  );
});

/** Selects a candidate near a place; its id and place. */
async function choose(tab, x, y) {
  const { at } = await unitAt(tab, x, y);
  await tab.press("Escape");
  await tab.click(at[0], at[1]);
  const id = await tab.until(() => {
    const name = document.querySelector(".properties h2").textContent;
    return name.startsWith("G1-") && name;
  });
  return { at, id };
}

testPlanner("units: the second of two quick commands waits for the first, and keeps its unit", {}, async (tab) => {
  const second = await choose(tab, 14, 8);
  const shifting = await choose(tab, 10, 8);
  const first = await choose(tab, 12, 8);
  const release = tab.server.wire.hold();
  await tab.press("r", "r"); // after the first, the unit is an entry of the list
  await tab.click(...shifting.at);
  await tab.press("x"); // shifts all later numbers
  await tab.click(...second.at);
  await tab.press("p");
  release();
  await tab.steps(4);
  const { list, pinned, excluded } = tab.json.transceivers;
  equal([list.length, list[0].roll_deg, pinned, excluded], [1, 180, ["U1", second.id], [shifting.id]]);
  equal(await tab.text(".properties h2"), second.id, "late answers select nothing else");
  isAt(list[0].position, first.at, 1e-3);
  await tab.press("Escape");
  await tab.click(...first.at);
  await tab.page.keyboard.down("Shift");
  await tab.click(...second.at);
  await tab.page.keyboard.up("Shift");
  await tab.press("Delete");
  await tab.steps(5);
  equal([tab.json.transceivers.list, tab.json.transceivers.pinned], [[], []], "both kinds in one step");
  equal(last(await tab.labels()), "Delete 2 units");
});

testPlanner("units: a number that another tab has shifted is refused", {}, async (tab, given) => {
  const { wire } = tab.server;
  const other = await given.tab(tab.server);
  await choose(other, 12, 8);
  const { id } = await choose(tab, 14, 8);
  const release = wire.hold();
  await tab.press("p");
  await new Promise((done) => setTimeout(done, 200)); // until the wire holds it
  wire.hold()();
  await other.press("x"); // shifts all later numbers
  await other.steps(1);
  await tab.until(() => window.shelfbeamPlanner.planner.document.history.position === 1);
  release();
  await notice(tab, "has another number by now");
  equal(tab.json.transceivers.pinned, undefined, "no other unit is pinned");
  await tab.press("p");
  await tab.steps(2);
  equal(tab.json.transceivers.pinned, [id]);
});

testPlanner("units: by keys alone, from the tool to the list", {}, async (tab) => {
  await tab.page.focus(".surface");
  await tab.press("u");
  for (let k = 0; k < 4; ++k) await tab.press("Shift+ArrowRight");
  await tab.press("Enter");
  await tab.steps(1);
  const [{ position }] = tab.json.transceivers.list;
  await tab.press("Escape", "Escape");
  equal(await tab.selected(), []);
  await tab.page.selectOption(".objects select", { label: "Units on the plan" });
  await tab.settle();
  equal(await tab.text(".object .name"), "U1");
  says(await tab.text(".object small"), "Pinned unit");
  await tab.page.focus(".object-list");
  await tab.press("Enter");
  equal(await tab.selected(), ["/transceivers/list/0"]);
  await tab.page.focus(".surface");
  await tab.press("ArrowLeft");
  await tab.steps(2);
  check(Math.abs(position[0] - 0.01 - tab.json.transceivers.list[0].position[0]) < 1e-3, "one centimetre");
});

/** Candidates from a CSV file. */
function withList(folder) {
  const file = join(folder, "store.json");
  const text = readFileSync(file, "utf8").replace(/"transceivers":\s*\{/, '$& "list": { "csv": "units.csv" },');
  writeFileSync(file, text);
  writeFileSync(join(folder, "units.csv"), "id,x,y,z,ax,ay,az,roll_deg,type\nover-door,3.2,8.2,3.5,0,0,-1,0,ceiling\n");
}

testPlanner("units: a list in a file stays as it is", { prepare: withList }, async (tab) => {
  const { at } = await unitAt(tab, 12, 8);
  await tab.press("u");
  await tab.click(12, 8.4);
  await notice(tab, "The list of units is a file");
  await tab.press("Escape");
  await tab.click(at[0], at[1]);
  await tab.drag([at[0], at[1]], [at[0] + 1, at[1]]);
  await notice(tab, "The list of units is a file");
  check(await tab.isUntouched(), "nothing is written");
  await tab.press("p");
  await tab.steps(1);
  equal(tab.json.transceivers.pinned.length, 1, "ids can be listed");
});

testPlanner("units: axe has no findings", { store: "market-hall" }, async (tab, { axe }) => {
  const clean = async (what) => equal(await findings(tab, axe), [], what);
  for (const key of ["u", "t", "c"]) {
    await tab.press(key);
    await clean(`tool ${key}`);
  }
  await tab.press("Escape");
  const { at } = await unitAt(tab, 4, 3);
  await tab.click(at[0], at[1]);
  await tab.until(() => document.querySelector('[data-key="unit/type"]') !== null);
  await clean("a candidate");
  await tab.press("Shift+F10");
  await clean("its menu");
  await tab.press("Escape");
});
