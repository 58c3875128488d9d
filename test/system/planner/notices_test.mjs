// Tests what the page says about others: outside changes, another project, and the end of the program.

import { readFileSync } from "node:fs";

import { check, equal, says } from "../viewer/check.mjs";
import { testPlanner } from "./opened.mjs";

const { hints } = JSON.parse(readFileSync(new URL("../../../src/page/planner/english.json", import.meta.url), "utf8"));

testPlanner("a change outside is said, and can be undone", {}, async (tab) => {
  tab.server.write(tab.server.text.replace("[11, 14.2]", "[11, 14.3]").replace("[6, 14.2]", "[6, 14.3]"));
  await tab.steps(1);
  await tab.notice("Changed outside: F1");
});

testPlanner("undone steps are named after the answer", {}, async (tab) => {
  await tab.click(10, 9.85);
  await tab.press("Shift+ArrowUp");
  await tab.press("r");
  await tab.steps(2);
  await tab.state(({ planner }) => {
    window.said = [];
    planner.say = (words) => window.said.push(words);
  });
  const release = tab.server.wire.hold();
  await tab.press("Control+z", "Control+z");
  release();
  await tab.steps(0);
  await tab.press("Control+y");
  await tab.steps(1);
  equal(await tab.evaluate("window.said"), ["Undone: Rotate A3", "Undone: Move A3", "Redone: Move A3"]);
});

testPlanner("a tool of the plan says so in 3-D", {}, async (tab) => {
  await tab.click(10, 9.85);
  await tab.press("d");
  for (const key of ["g", "n", "m"]) {
    await tab.hush();
    await tab.press(key);
    await tab.notice("Press D to leave 3-D");
  }
  check(await tab.isUntouched(), "nothing is drawn");
});

testPlanner("the end of the program is said, with what is not saved", { keeps: true }, async (tab) => {
  await tab.server.end();
  await tab.until(() => document.querySelector(".saving").dataset.state === "lost");
  await tab.click(10, 9.85);
  await tab.press("Shift+ArrowUp");
  await tab.until(() => document.querySelector(".banner").textContent.includes("1 change is not saved"));
  says(await tab.text(".banner"), "The planner has ended. Start shelfbeam serve again");
  tab.errors.length = 0; // of the attempts to connect again
});

testPlanner("no hint of the status line is cut off at 1280 pixels", {}, async (tab) => {
  const isCut = (words) => {
    const hint = document.querySelector(".status .hint");
    hint.textContent = words;
    return hint.scrollWidth > hint.clientWidth;
  };
  for (const words of Object.values(hints)) equal(await tab.evaluate(isCut, words), false, words);
});
