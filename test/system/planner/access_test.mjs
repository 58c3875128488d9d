// Tests the keyboard, menus, dialogs, and accessibility.

import { check, equal, says } from "../viewer/check.mjs";
import { findings } from "./findings.mjs";
import { testPlanner } from "./opened.mjs";

testPlanner("the menu opens by right click and by Shift+F10", {}, async (tab) => {
  await tab.click(10, 9.85, { button: "right" });
  equal(await tab.selected(), ["/fixtures/2"]);
  const items = () =>
    tab.page.evaluate(() =>
      [...document.querySelectorAll(".menu [role=menuitem] span")].map(({ textContent }) => textContent),
    );
  check((await items()).includes("Rotate by 90°"), `${await items()}`);
  await tab.press("ArrowDown", "ArrowDown", "ArrowUp", "Escape");
  equal(await tab.page.$(".menu"), null);
  equal(await tab.selected(), ["/fixtures/2"], "Esc closes only the menu");
  await tab.press("Shift+F10");
  await tab.page.click('.menu [data-command="duplicate"]');
  await tab.steps(1);
  equal(tab.json.fixtures.length, 14);
  await tab.click(17.2, 5, { button: "right" });
  check((await items()).includes("Dissolve"), `${await items()}`);
  await tab.press("Escape");
});

testPlanner("the list of commands finds and runs", {}, async (tab) => {
  await tab.click(10, 9.85);
  await tab.press("Control+k");
  await tab.page.keyboard.type("mirror front");
  await tab.until(() => document.querySelectorAll(".results li").length === 1);
  await tab.press("Enter");
  await tab.steps(1);
  equal(await tab.labels(), ["Mirror A3"]);
  await tab.press("/");
  await tab.until(() => document.querySelector("dialog[open]"));
  await tab.press("Escape");
  await tab.press("?");
  says(await tab.text("dialog[open]"), "Ctrl+Shift+Z", "Assign a type", "Middle or right drag");
  await tab.press("Escape");
  equal(await tab.page.$("dialog[open]"), null);
});

testPlanner("fixtures are numbered by a pattern", {}, async (tab) => {
  await tab.drag([4, 4], [18.2, 13]);
  await tab.press("Control+k");
  await tab.page.keyboard.type("number");
  await tab.until(() => document.querySelector(".results li span")?.textContent.startsWith("Number the fixtures"));
  await tab.press("Enter");
  await tab.page.keyboard.type("Aisle {n}");
  await tab.until(() => document.querySelector(".results li span")?.textContent.startsWith("Aisle 1"));
  await tab.press("Enter");
  await tab.steps(1);
  const ids = tab.json.fixtures.map(({ id }) => id).filter((id) => id.startsWith("Aisle"));
  equal(ids.filter((id) => id.includes("{n}")).length, 2, "rows");
  equal(new Set(ids.filter((id) => !id.includes("{n}"))).size, 4, `${ids}`);
  equal(tab.json.fixtures[4].repeat, { first: 4 }, "the row of end caps on the left");
});

testPlanner("Ctrl+F finds fixtures, labels and units", {}, async (tab) => {
  const find = async (typed) => {
    await tab.press("Control+f");
    await tab.page.keyboard.type(typed);
    await tab.until(() => document.querySelectorAll(".results li").length > 0);
    await tab.press("Enter");
  };
  await find("F2");
  equal(await tab.selected(), ["/fixtures/9"]);
  equal(await tab.page.evaluate(() => document.activeElement.className), "surface");
  await find("A2-front-3-4");
  await tab.until(() => document.querySelector(".properties h2").textContent === "A2-front-3-4");
  await find("G1-3-2");
  equal(await tab.selected(), ["/transceivers/grids/0"]);
});

testPlanner("Ctrl+F finds articles by their descriptions", { store: "market-hall" }, async (tab) => {
  await tab.press("Control+f");
  await tab.page.keyboard.type("rye BREAD");
  await tab.until(() => document.querySelectorAll(".results li").length === 2);
  check((await tab.text(".results")).includes("Rye bread"), "the description");
  await tab.press("Enter");
  await tab.until(() => document.querySelector(".properties h2").textContent === "4001686301265");
});

testPlanner("keys are off in fields, and chords are no tools", {}, async (tab) => {
  await tab.click(10, 9.85);
  await tab.fill("field/id", "mvdr", "Tab");
  await tab.steps(1);
  equal(await tab.page.evaluate(() => document.querySelector(".plan").dataset.tool), "select");
  await tab.click(10, 9.85);
  await tab.press("Control+m", "Alt+m");
  equal(await tab.page.evaluate(() => document.querySelector(".plan").dataset.tool), "select");
  await tab.press("m");
  equal(await tab.page.evaluate(() => document.querySelector(".plan").dataset.tool), "measure");
});

testPlanner("everything can be done by keyboard", { smoke: true }, async (tab) => {
  const focused = () => tab.page.evaluate(() => document.activeElement.className || document.activeElement.tagName);
  for (let k = 0; k < 40 && !(await focused()).includes("object-list"); ++k) await tab.press("Tab");
  check((await focused()).includes("object-list"), "Tab reaches the list of elements");
  await tab.press("Home", "ArrowDown", "ArrowDown");
  equal(await tab.selected(), ["/fixtures/1"]);
  await tab.press("Shift+ArrowDown");
  equal(await tab.selected(), ["/fixtures/1", "/fixtures/2"]);
  await tab.press("F6");
  check((await focused()).includes("surface"), `F6 goes to the plan, not ${await focused()}`);
  await tab.press("Shift+ArrowRight");
  await tab.steps(1);
  equal(
    tab.json.fixtures.slice(1, 3).map(({ at }) => at[0]),
    [5.1, 5.1],
  );
  await tab.press("PageDown");
  equal((await tab.selected()).length, 1);
  await tab.press("F6");
  check((await focused()).includes("properties"), "F6 goes to the panel");
  for (let k = 0; k < 60; ++k) {
    if (await tab.page.evaluate(() => document.activeElement.dataset.key === "field/height")) break;
    await tab.press("Tab");
  }
  await tab.page.keyboard.type("1.9");
  await tab.press("Enter");
  await tab.steps(2);
  await tab.press("F6", "F6", "m", "Enter", "Shift+ArrowRight", "Enter");
  equal(
    await tab.page.evaluate(() => document.querySelectorAll(".overlay .measure").length > 0),
    true,
    "a measurement by keys",
  );
});

testPlanner("the page speaks what happens", {}, async (tab) => {
  await tab.click(10, 9.85);
  await tab.press("Delete");
  await tab.steps(1);
  await tab.press("Control+z");
  await tab.steps(0);
  await tab.until(() => document.querySelector('.notice[role="status"]').textContent === "Undone: Delete A3");
});

for (const dark of [false, true])
  testPlanner(`axe has no findings, ${dark ? "dark" : "light"}`, { dark, smoke: !dark }, async (tab, { axe }) => {
    const clean = async (what) => equal(await findings(tab, axe), [], what);
    await clean("at first");
    for (const name of ["layers", "light", "types", "problems", "history", "objects"]) {
      await tab.push(`#tab-${name}`);
      await clean(name);
    }
    await tab.click(11, 14.4);
    await tab.fill("field/length", "2000");
    await tab.steps(1);
    await clean("a fixture with a problem");
    await tab.push("#tab-problems");
    await clean("problems");
    await tab.press("Control+a");
    await clean("everything selected");
    await tab.press("Shift+F10");
    await tab.press("ContextMenu");
    await clean("menu");
    await tab.press("Escape");
    for (const key of ["Control+k", "?", "Control+f"]) {
      await tab.press(key);
      await clean(key);
      await tab.press("Escape");
    }
    await tab.press("Escape");
    await tab.click(17.2, 5);
    await clean("a locked copy");
    await tab.press("m");
    await tab.click(10, 5.55);
    await clean("measurement");
    await tab.press("Escape", "Escape", "g");
    await tab.choose("tool/Preset", "end");
    await tab.click(20, 14);
    await tab.point(20.3, 16);
    await tab.page.keyboard.type("2");
    await clean("a fixture is drawn");
    await tab.press("Escape");
    await tab.press("Escape", "o");
    await clean("doors and windows");
    await tab.press("Escape", "Escape", "d");
    await clean("3-D");
    await tab.press("d");
    await tab.picture(`grocery-problem-${dark ? "dark" : "light"}`);
  });
