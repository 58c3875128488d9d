// Tests the panel of properties, types, and the lists.

import { check, equal, says } from "../viewer/check.mjs";
import { testPlanner } from "./opened.mjs";

const places = (tab, from) => tab.json.fixtures.slice(from, from + 2).flatMap(({ at }) => at);

testPlanner("fields show presets in grey, accept expressions, and are one step each", { smoke: true }, async (tab) => {
  await tab.click(10, 9.85);
  await tab.until(() => document.querySelector('[data-key="field/length"]')?.placeholder === "12");
  await tab.fill("field/length", "3*1.33");
  await tab.steps(1);
  equal([tab.json.fixtures[2].length, await tab.labels()], [3.99, ["Length of A3"]]);
  await tab.fill("field/length", "6ft", "Tab");
  await tab.steps(2);
  equal(tab.json.fixtures[2].length, 1.8288);
  await tab.use("field/length/reset");
  await tab.steps(3);
  equal(tab.json.fixtures[2].length, undefined);
  await tab.fill("field/length", "abc");
  await tab.until(() => document.querySelector(".why:not([hidden])")?.textContent.startsWith("Not a length"));
  await tab.press("Escape");
  equal((await tab.labels()).length, 3);
  await tab.fill("field/labels/spacing", "1.2");
  await tab.steps(4);
  equal(tab.json.fixtures[2].labels, { spacing: 1.2 });
});

testPlanner("a typed value goes to the element that it was typed for", {}, async (tab) => {
  const row = (id) => tab.page.locator(".object", { has: tab.page.locator(".name", { hasText: id }) }).click();
  await tab.click(11, 14.4);
  await tab.type("field/rotation_deg", "180");
  await row("A3");
  await tab.steps(1);
  equal(await tab.labels(), ["Rotate F1"]);
  const { at, rotation_deg } = tab.json.fixtures[8];
  equal([at, rotation_deg], [[16, 15], 180], "about its middle");
  equal(await tab.selected(), ["/fixtures/2"]);
  await tab.drag([5.6, 16.2], [16.6, 13.9]);
  await tab.type("place/0", "7");
  await row("A3");
  await tab.steps(2);
  equal([tab.json.fixtures[2].at, (await tab.labels())[1]], [[5, 9.4], "Move 2 fixtures"]);
});

testPlanner("a typed value follows its element, and leaves what another tab made", {}, async (tab, given) => {
  const other = await given.tab(tab.server);
  await tab.drag([5.6, 16.2], [16.6, 13.9]);
  await tab.type("place/1", "14");
  await other.click(10, 9.85);
  await other.press("Delete");
  await other.steps(1);
  await other.drag([5.6, 16.2], [16.6, 13.9]);
  await other.press("Shift+ArrowUp");
  await other.steps(2);
  await tab.steps(2);
  await tab.press("Tab");
  await tab.steps(3);
  equal(places(tab, 7), [6, 14, 6, 14.8]);
  await tab.click(11, 14.2);
  await tab.type("field/at/0", "7");
  await other.steps(3);
  await other.press("Shift+ArrowUp");
  await other.steps(4);
  await tab.steps(4);
  await tab.press("Tab");
  await tab.steps(5);
  equal(places(tab, 7), [7, 14.1, 6, 14.9], "the other component");
});

testPlanner("alternatives replace each other", {}, async (tab) => {
  const fixture = () => tab.json.fixtures[8];
  await tab.click(11, 14.4);
  await tab.choose("field/labels/alternative", "Count");
  await tab.steps(1);
  equal([fixture().labels.count, fixture().labels.spacing], [1, undefined]);
  await tab.choose("field/alternative", "Against");
  await tab.steps(2);
  equal([fixture().against, fixture().at], [{ wall: 0, from: 0 }, undefined]);
  await tab.choose("field/alternative", "Position");
  await tab.steps(3);
  check(Array.isArray(fixture().at) && fixture().against === undefined, "back at a place");
});

testPlanner("several elements: common fields, mixed values, one step", {}, async (tab) => {
  await tab.drag([5.6, 16.2], [16.6, 13.9]);
  equal(await tab.text(".properties h2"), "2 fixtures");
  const field = (key) => tab.until((of) => document.querySelector(`[data-key="${of}"]`)?.outerHTML, key);
  check(!(await tab.has('[data-key="field/id"]')), "no id");
  says(await field("field/at/1"), "mixed");
  await tab.fill("field/height", "1.1");
  await tab.steps(1);
  equal([...tab.json.fixtures.slice(8, 10).map(({ height }) => height)], [1.1, 1.1]);
  equal(await tab.labels(), ["Height of 2 fixtures"]);
  await tab.fill("field/at/0", "7");
  await tab.steps(2);
  equal(places(tab, 8), [7, 14.2, 7, 15]);
  await tab.fill("place/1", "14");
  await tab.steps(3);
  equal(places(tab, 8), [7, 14, 7, 14.8]);
});

testPlanner("types: edited, duplicated, assigned by number keys", {}, async (tab) => {
  await tab.push("#tab-types");
  await tab.use("/label_types/standard");
  equal(await tab.text(".properties .subtitle"), "Label type");
  await tab.fill("field/safety_factor", "1.4");
  await tab.steps(1);
  equal(tab.json.label_types.standard.safety_factor, 1.4);
  await tab.use("duplicate-type");
  await tab.steps(2);
  equal(tab.json.label_types["standard 2"].safety_factor, 1.4);
  await tab.click(10, 9.85);
  equal(await tab.text(".types kbd"), "1");
  await tab.press("3");
  await tab.steps(3);
  equal([tab.json.fixtures[2].preset, (await tab.labels())[2]], ["wall", "wall for A3"]);
  await tab.press("Control+z");
  await tab.steps(2);
  await tab.evaluate(() => {
    const key = { key: '"', code: "Digit3", bubbles: true, cancelable: true };
    document.body.dispatchEvent(new KeyboardEvent("keydown", key)); // of a French keyboard
  });
  await tab.steps(3);
  equal(tab.json.fixtures[2].preset, "wall");
  await tab.use("/presets/wall");
  await tab.fill("field/depth", "0.6");
  await tab.steps(4);
  equal(tab.json.presets.wall.depth, 0.6);
  await tab.use("/materials/steel");
  await tab.choose("field/variant", "metal");
  await tab.steps(5);
  equal(Object.keys(tab.json.materials.steel).sort(), ["eta", "k", "type"]);
});

testPlanner("the history goes to any of its named steps, also after the page is loaded again", {}, async (tab) => {
  await tab.click(10, 9.85);
  for (const [k, key] of ["Shift+ArrowUp", "r", "Delete"].entries()) {
    await tab.press(key);
    await tab.steps(k + 1);
  }
  const { text } = tab.server;
  await tab.push("#tab-history");
  equal(await tab.texts(".history button"), ["Delete A3", "Rotate A3", "Move A3", "Store as first opened"]);
  await tab.use("step1");
  await tab.steps(1);
  equal(await tab.text(".history [aria-current]"), "Move A3");
  await tab.reload();
  await tab.press("Control+z");
  await tab.steps(0);
  check(await tab.isUntouched(), "the first store");
  await tab.reload();
  await tab.press("Control+y", "Control+y", "Control+y");
  await tab.steps(3);
  check(tab.server.text === text, "the last store");
  await tab.push("#tab-history");
  await tab.use("step0");
  await tab.steps(0);
});

testPlanner("lists and maps: openings of a wall, materials of a mesh", { store: "market-hall" }, async (tab) => {
  await tab.click(6, 11);
  equal(await tab.selected(), ["/room/inner_walls/0"]);
  await tab.use("field/openings/fold");
  await tab.use("field/openings/more");
  await tab.steps(1);
  equal(tab.json.room.inner_walls[0].openings[1], { at: 0, width: 1, top: 1 });
  await tab.fill("field/openings/1/width", "90cm");
  await tab.steps(2);
  equal(tab.json.room.inner_walls[0].openings[1].width, 0.9);
  await tab.use("field/openings/1/remove");
  await tab.steps(3);
  await tab.list("room");
  await tab.use("field/wall_materials/fold");
  await tab.fill("field/wall_materials/new", "2");
  await tab.steps(4);
  check(Object.keys(tab.json.room.wall_materials).includes("2"), JSON.stringify(tab.json.room.wall_materials));
  await tab.fill("field/wall_materials/new", "1");
  equal(await tab.focused(), "field/wall_materials/1");
  equal(tab.json.room.wall_materials[1], "glass", "an existing name keeps its value");
  await tab.page.focus('[data-key="field/wall_materials/new"]');
  await tab.page.keyboard.insertText("1");
  await tab.state(({ planner }) => planner.changes.note("status"));
  await tab.settle();
  equal(await tab.evaluate(() => document.activeElement.value), "1", "what is being typed stays");
  await tab.page.keyboard.press("Backspace");
  await tab.press("Tab");
});
