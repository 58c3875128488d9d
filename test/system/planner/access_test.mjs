// Tests menus, dialogs, and accessibility.

import { check, equal, says } from "../viewer/check.mjs";
import { testAxe, testPlanner } from "./opened.mjs";

testPlanner("the menu opens by right click and by Shift+F10", {}, async (tab) => {
  const items = () => tab.texts(".menu [role=menuitem] span");
  await tab.click(10, 9.85, { button: "right" });
  equal(await tab.selected(), ["/fixtures/2"]);
  check((await items()).includes("Rotate by 90°"), `${await items()}`);
  await tab.press("ArrowDown", "ArrowDown", "ArrowUp", "Escape");
  check(!(await tab.has(".menu")), "Esc closes it");
  equal(await tab.selected(), ["/fixtures/2"], "Esc closes only the menu");
  await tab.press("Shift+F10");
  await tab.page.click('.menu [data-command="duplicate"]');
  await tab.steps(1);
  equal(tab.json.fixtures.length, 14);
  await tab.click(17.2, 5, { button: "right" });
  check((await items()).includes("Dissolve"), `${await items()}`);
  await tab.press("Escape");
});

testPlanner("the list of commands finds and runs, and the page speaks what happens", {}, async (tab) => {
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
  check(!(await tab.has("dialog[open]")), "Esc closes it");
  await tab.press("Control+z");
  await tab.until(() => document.querySelector('.notice[role="status"]').textContent === "Undone: Mirror A3");
});

testPlanner("fixtures are numbered by a typed pattern", {}, async (tab) => {
  await tab.drag([4, 4], [18.2, 13]);
  await tab.pick("Control+k", "Number the fixtures …", "number");
  await tab.page.keyboard.type("Aisle {n}");
  await tab.until(() => document.querySelector(".results li span")?.textContent.startsWith("Aisle 1"));
  await tab.press("Enter");
  await tab.steps(1);
  const ids = tab.json.fixtures.map(({ id }) => id).filter((id) => id.startsWith("Aisle"));
  equal(ids.filter((id) => id === "Aisle {n}").length, 2, "rows");
  equal(new Set(ids).size, 5, `${ids}`);
});

testPlanner("Ctrl+F finds fixtures, labels, articles and units", { store: "market-hall" }, async (tab) => {
  await tab.find("counter");
  equal(await tab.focused(), "surface");
  await tab.press("Control+f");
  await tab.page.keyboard.type("rye BREAD");
  await tab.until(() => document.querySelectorAll(".results li").length === 2);
  check((await tab.text(".results")).includes("Rye bread"), "the description");
  await tab.press("Enter");
  await tab.until(() => document.querySelector(".properties h2").textContent === "4001686301265");
  await tab.press("Control+f");
  await tab.page.keyboard.type("A1-1-1");
  await tab.until(() => document.querySelector(".results li span")?.textContent === "A1-1-1");
  await tab.press("Enter");
  equal(await tab.selected(), ["/transceivers/areas/0"]);
});

testPlanner("keys are off in fields, and chords are no tools", {}, async (tab) => {
  await tab.click(10, 9.85);
  await tab.fill("field/id", "mvdr", "Tab");
  await tab.steps(1);
  equal(await tab.tool(), "select");
  await tab.click(10, 9.85);
  await tab.press("Control+m", "Alt+m");
  equal(await tab.tool(), "select");
  await tab.press("m");
  equal(await tab.tool(), "measure");
});

testAxe("page", { smoke: "light" }, async (tab, clean, colours) => {
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
  for (const key of ["Shift+F10", "Control+k", "?", "Control+f"]) {
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
  await tab.picture(`grocery-problem-${colours}`);
});
