// Tests one element of each kind: moved, turned, changed by its panel, and undone.

import { check, equal } from "../viewer/check.mjs";
import { testPlanner } from "./opened.mjs";

const stays = {
  room: "begins at the origin",
  follows: "no place of its own",
  against: "only moves along it",
};

/**
 * The kind; the name in the list; the field of the panel, with what is typed. `at`: a place in the plan where a click
 * selects the element and a drag moves it. `arrow`: the key that moves it. `moves` and `turns`: why it does not.
 */
const room = ["room by its size", "Room", "size/2", "5", { moves: stays.room, turns: stays.room }];
const tables = {
  grocery: [
    room,
    ["gondola", "A2", "stocking", "0.5", { at: [10, 7.45] }],
    ["freezer", "F2", "depth", "0.7"],
    ["box", "C{n}", "repeat/count", "3"],
    ["mesh", "checkout-{n}", "scale", "1.1"],
    ["grid", "Grid 1", "spacing", "1.2", { at: [1, 5] }],
    ["keep_out", "Keep-out 1", "max/0", "22.5", { at: [21.5, 13.6] }],
  ],
  chiller: [
    room,
    ["gondola", "A3", "length", "6ft", { at: [8.2, 5.6] }],
    ["freezer", "F1", "height", "0.9"],
    ["box", "coffee", "max/2", "1", { arrow: "ArrowRight" }],
    ["mesh", "till", "scale", "1.05"],
    ["label", "coffee-cup", "position/2", "0.8", { at: [0.9, 8.27] }],
    ["grid", "Grid 3", "z", "3.1"],
    ["unit", "over-till", "position/2", "3.1", { at: [10.6, 2.6] }],
    ["keep_out", "Keep-out 1", "max/1", "2", { at: [6.6, 0.9] }],
  ],
  "market-hall": [
    ["room by its outline", "Room", "height", "4.3"],
    ["zone", "bakery", "height", "2.9"],
    // Its height is that of three points, which move with it.
    ["zone", "wing", "id", "hall", { arrow: "Shift+ArrowLeft" }],
    ["wall", "bakery wall", "thickness", "0.2", { at: [6, 11] }],
    ["gondola", "A{n}", "repeat/count2", "4"],
    ["gondola against", "S{n}", "repeat/count", "6", { arrow: "Shift+ArrowRight", turns: stays.against }],
    ["gondola against", "S{n}", "repeat/count", "7", { arrow: "ArrowUp", moves: stays.against, turns: stays.against }],
    ["box", "M{n}", "rotation_deg", "50"],
    ["freezer", "F{n}", "repeat/step", "2.2"],
    ["prism", "counter", "top", "1.2", { at: [3, 9.9] }],
    ["cylinder", "column {n}", "radius", "25cm"],
    ["panel", "sign", "id", "board"],
    ["label", "counter", "position/2", "0.9", { at: [3.3, 9.19] }],
    ["area", "Area 3", "z", "3.4", { at: [15, 1] }],
    ["area that follows", "Area 1", "spacing", "2.5", { moves: stays.follows, turns: stays.follows }],
    ["rail", "rail", "spacing", "2*0.6", { at: [16.65, 5.65] }],
    ["faces", "Faces 2", "z", "2.4", { moves: stays.follows, turns: stays.follows }],
    ["keep_out", "Keep-out 1", "z/1", "4", { at: [9.5, 9] }],
  ],
};

/** The kinds of the list, but fixtures by their types, and those apart that move in another way. */
const kindsIn = (tab) =>
  tab.state(({ planner: { document: store } }) => {
    const { room, fixtures, labels, transceivers } = store.json;
    const some = (kind, list) => (Array.isArray(list) && list.length > 0 ? [kind] : []);
    const areas = transceivers.areas ?? [];
    return [
      room.outline ? "room by its outline" : "room by its size",
      ...some("zone", room.zones),
      ...some("wall", room.inner_walls),
      ...fixtures.map(({ against }, k) => store.parts.of(`/fixtures/${k}`)[0].type + (against ? " against" : "")),
      ...some("label", labels),
      ...areas.map(({ area }) => (Array.isArray(area) ? "area" : "area that follows")),
      ...some("grid", transceivers.grids),
      ...some("rail", transceivers.rails),
      ...some("faces", transceivers.on),
      ...some("unit", transceivers.list),
      ...some("keep_out", transceivers.keep_out),
    ];
  });

/** Of the list of elements. */
const kindOfRow = (kind) => {
  const [first] = kind.split(" ");
  return ["gondola", "freezer", "box", "mesh", "prism", "cylinder", "panel"].includes(first) ? "fixture" : first;
};

/** Selects an element in the list, a row of "A{n}" by its numbers; its path. */
async function select(tab, kind, name) {
  await tab.page.selectOption(".objects select", kindOfRow(kind));
  await tab.page.fill(".objects input[type=search]", kindOfRow(kind) === "fixture" ? name.split("{")[0] : "");
  await tab.settle();
  const row = (await tab.texts(".object .name")).findIndex((shown) => {
    const [first, last] = shown.split("–");
    return first === (last === undefined ? name : name.replace("{n}", "1"));
  });
  check(row >= 0, `${name} is in the list`);
  await tab.page.click(`.object >> nth=${row}`);
  await tab.page.focus(".surface");
  const [path] = await tab.selected();
  return path;
}

async function testKind(tab, [kind, name, field, typed, { at, arrow = "Shift+ArrowRight", moves, turns } = {}]) {
  const path = await select(tab, kind, name);
  const value = (pointer = path) =>
    pointer
      .split("/")
      .slice(1)
      .reduce((found, key) => found?.[key], tab.json);
  let steps = 0;
  const change = async (what, act, why) => {
    const before = JSON.stringify(value());
    await tab.hush();
    await act();
    if (why) {
      await tab.notice(why);
      equal(JSON.stringify(value()), before, `${name} after it says why it stays`);
      return;
    }
    await tab.steps(++steps);
    check(JSON.stringify(value()) !== before, `${kind} ${name}: ${what} changes ${before}`);
  };
  if (at) {
    await tab.press("Escape");
    await tab.click(...at);
    equal(await tab.selected(), [path], `${kind} ${name} by a click`);
    const [x, y] = await tab.at(...at);
    await change("a drag", () => tab.dragPixels([x, y], [x + 20, y]));
  }
  await change("R", () => tab.press("r"), turns);
  await change("an arrow key", () => tab.press(arrow), moves);
  const before = value(`${path}/${field}`);
  await change("its panel", () => tab.fill(`field/${field}`, typed));
  check(value(`${path}/${field}`) !== before, `${kind} ${name}: the panel changes ${field} from ${before}`);
  await tab.page.focus(".surface");
  while (steps > 0) {
    await tab.press("Control+z");
    await tab.steps(--steps);
  }
  check(tab.server.text === tab.server.first, `${kind} ${name}: undo brings the store back`);
}

for (const [store, table] of Object.entries(tables))
  testPlanner(`one element of each kind of ${store} moves, turns, changes, and comes back`, { store }, async (tab) => {
    const listed = new Set(table.map(([kind]) => kind));
    const missing = (await kindsIn(tab)).filter((kind) => !listed.has(kind));
    equal(missing, [], "kinds that are not tested");
    for (const row of table) await testKind(tab, row);
  });
