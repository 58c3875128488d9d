// Tests what fields say and offer: errors, resets, and presets of catalogues.

import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { check, equal } from "../viewer/check.mjs";
import { testPlanner } from "./opened.mjs";
import { smallShop } from "./shops.mjs";

const key = (name) => `[data-key="${name}"]`;

testPlanner("an error shows while somebody types, and when the answer comes", {}, async (tab) => {
  await tab.click(11, 14.4);
  await tab.type("field/height", "high");
  await tab.until(() => document.querySelector(".why:not([hidden])")?.textContent.startsWith("Not a length"));
  await tab.type("field/height", "1.4");
  await tab.until(() => document.querySelector(".why:not([hidden])") === null);
  const release = tab.server.wire.hold();
  await tab.type("field/length", "2000");
  await tab.press("Tab");
  await tab.page.keyboard.insertText("1");
  release();
  await tab.until(() => document.querySelector('[data-field="/length"] .problem') !== null);
  equal(await tab.evaluate(() => document.activeElement.value), "1", "the field that is being typed in");
  await tab.press("Escape");
});

testPlanner("Esc in a field takes the error back with the text", {}, async (tab) => {
  await tab.click(11, 14.4);
  const field = () =>
    tab.evaluate(() => {
      const input = document.querySelector('[data-key="field/height"]');
      return [input.value, input.ariaInvalid, document.querySelector(".why:not([hidden])") === null];
    });
  const [shown] = await field();
  for (const what of ["a mistake", "the same mistake again"]) {
    await tab.fill("field/height", "high");
    equal(await field(), ["high", "true", false], what);
    await tab.press("Escape");
    equal(await field(), [shown, "false", true], what);
  }
});

/** A fixture with an angle of its own in place of that of its preset. */
function withTurned(folder) {
  const file = join(folder, "store.json");
  const fixture = { id: "T1", preset: "turned", at: [12, 1.5, 0], rotation_deg: 90 };
  const preset = { type: "box", size: [1, 1, 1], material: "steel", rotation_deg: 30 };
  const text = readFileSync(file, "utf8")
    .replace(/"presets":\s*\{/, `$& "turned": ${JSON.stringify(preset)},`)
    .replace(/"fixtures":\s*\[/, `$& ${JSON.stringify(fixture)},`);
  writeFileSync(file, text);
}

testPlanner("a reset is offered where a preset or a default takes its place", { prepare: withTurned }, async (tab) => {
  await tab.click(10, 9.85);
  await tab.until(() => document.querySelector('[data-key="field/length"]')?.placeholder === "12");
  for (const name of ["at", "id"]) check(!(await tab.has(key(`field/${name}/reset`))), `${name} cannot be left out`);
  await tab.fill("field/length", "3");
  await tab.steps(1);
  await tab.use("field/length/reset");
  await tab.steps(2);
  await tab.click(11, 14.4);
  check(!(await tab.has(key("field/length/reset"))), "without a preset, a length cannot be left out");

  // The angle returns to that of the preset, about the middle.
  const middle = () =>
    tab.state(({ planner }) => {
      const { outline } = planner.document.parts.of("/fixtures/0")[0];
      return [0, 1].map((axis) => outline.reduce((sum, point) => sum + point[axis], 0) / outline.length);
    });
  const first = await middle();
  const isReset = async () => {
    equal(tab.json.fixtures[0].rotation_deg, undefined);
    const [x, y] = await middle();
    check(Math.hypot(x - first[0], y - first[1]) < 0.01, `the middle stays at ${first}, and is at ${x}, ${y}`);
  };
  await tab.list("T1");
  await tab.use("field/rotation_deg/reset");
  await tab.steps(3);
  await isReset();
  await tab.fill("field/rotation_deg", "60");
  await tab.steps(4);
  await tab.fill("field/rotation_deg", "");
  await tab.steps(5);
  await isReset();
});

/** Moves a preset into a catalogue, in millimetres. */
function withCatalogue(folder) {
  const file = join(folder, "store.json");
  const text = readFileSync(file, "utf8").replace("{", '{ "catalogues": ["chain.json"],');
  const preset = { type: "box", size: [1200, 800, 1500], material: "steel" };
  writeFileSync(join(folder, "chain.json"), JSON.stringify({ units: "mm", presets: { "chain box": preset } }));
  const fixture = '{ "id": "C1", "preset": "chain box", "at": [12, 1.5, 0] }';
  writeFileSync(file, text.replace(/"fixtures":\s*\[/, `$& ${fixture},`));
}

testPlanner("values of a catalogue in another unit", { prepare: withCatalogue }, async (tab) => {
  await tab.click(12.6, 1.9);
  equal(await tab.selected(), ["/fixtures/0"]);
  await tab.until(() => document.querySelector('[data-key="field/size/0"]')?.placeholder === "1.2");
  await tab.press("Shift+2");
  await tab.dragPixels(await tab.grip("x1"), await tab.at(14, 1.9));
  await tab.steps(1);
  equal(tab.json.fixtures[0].size, [2, 0.8, 1.5]);
  await tab.push(`${key("field/size/0/reset")}, ${key("field/size/reset")}`);
  await tab.steps(2);
  equal(tab.json.fixtures[0].size, undefined);
});

/** A rack against the wall and a free one with a height of its own; two presets for them, and one for counters. */
function withPresets(folder) {
  smallShop()(folder);
  const file = join(folder, "store.json");
  const { fixtures, ...store } = JSON.parse(readFileSync(file, "utf8"));
  const presets = {
    counter: { type: "box", size: [1, 0.6, 0.9], material: "paper" },
    rack: { type: "gondola", depth: 0.5, height: 2, material: "paper", shelves: [0.5, 1.1], faces: ["front"] },
    tall: { preset: "rack", shelves: [0.5, 1.1, 1.8] },
  };
  const others = [
    { preset: "rack", id: "W1", against: { wall: 2, from: 1 }, length: 3, labels: fixtures[0].labels },
    { preset: "rack", id: "R1", at: [1.2, 1], length: 2, height: 1.4 },
  ];
  writeFileSync(file, JSON.stringify({ presets, ...store, fixtures: [...fixtures, ...others] }, null, 2));
}

testPlanner(
  "presets of another kind are not offered, and none makes the store invalid",
  { store: null, prepare: withPresets, keeps: true },
  async (tab) => {
    const before = tab.server.text;
    const offered = () => tab.texts('[data-key="field/preset"] option');
    await tab.push("#tab-types");
    await tab.click(2.5, 4.8);
    equal(await tab.selected(), ["/fixtures/1"]);
    await tab.until(() => document.querySelectorAll(".types kbd").length === 2);
    check(!(await offered()).includes("counter"), "not for shelving");
    await tab.press("3");
    check((await tab.text(".types kbd")) === "1" && tab.server.text === before, "there is no third one");
    await tab.press("2");
    await tab.steps(1);
    equal(tab.json.fixtures[1].preset, "tall");
    // After a tool that does not begin, digits are not for presets.
    await tab.press("n", "1");
    await tab.notice("does not stand against");
    await tab.settle();
    equal(tab.json.fixtures[1].preset, "tall");
    await tab.click(2, 1.2);
    equal(await tab.selected(), ["/fixtures/2"]);
    await tab.choose("field/preset", "tall");
    await tab.notice("Not done: tall for R1");
    await tab.steps(1);
    equal([tab.json.fixtures[2].preset, await tab.problems()], ["rack", []]);
    await tab.fill("field/height", "2.1");
    await tab.steps(2);
    await tab.press("2");
    await tab.steps(3);
    equal(tab.json.fixtures[2].preset, "tall");
    await tab.use("/presets/tall");
    const names = await offered();
    equal([names.includes("tall"), names.includes("rack")], [false, true], "a preset does not begin with itself");
  },
);

testPlanner("the panel keeps its place, and shows what is wide and long", { store: null, keeps: true }, async (tab) => {
  await tab.press("g");
  await tab.choose("tool/Preset", "gondola 1.25 m, double, 1.6 m high");
  await tab.click(3, 8);
  await tab.click(6, 8);
  await tab.steps(1);
  await tab.press("n");
  await tab.click(4.5, 10.2);
  await tab.steps(2);
  await tab.until(() => document.querySelector('[data-key="field/repeat/step/1"]') !== null);
  // Two numbers beside a choice have room, and names that are cut off are hints.
  for (const name of ["field/repeat/step/0", "field/repeat/step/1"])
    check((await tab.evaluate((of) => document.querySelector(of).clientWidth, key(name))) > 60, name);
  await tab.page.hover(key("field/preset"));
  const title = await tab.evaluate(() => document.querySelector('[data-key="field/preset"]').title);
  equal(title, "gondola 1.25 m, double, 1.6 m high");
  // A typed value leaves the panel where it was scrolled to.
  await tab.until(() => document.querySelector('[data-key="field/shelves"]')?.placeholder);
  const place = () => tab.evaluate(() => document.querySelector(".properties").scrollTop);
  await tab.evaluate(() => document.querySelector(".properties").scrollTo(0, 1e4));
  const before = await place();
  check(before > 0, "it can be scrolled");
  await tab.fill("field/shelves", "0.4, 0.9");
  await tab.steps(3);
  equal(await place(), before);
  await tab.press("Escape");
  await tab.push("#tab-types");
  equal(await tab.text(".types h3"), "Materials", "which come first");
  await tab.use("/materials/steel");
  await tab.notice("steel comes from a catalogue (catalogue.json)");
});
