// Tests copies, also in another shop, and what mirror images write.

import { check, equal } from "../viewer/check.mjs";
import { placed, testPlanner } from "./opened.mjs";

testPlanner("copies: Ctrl+C and V at the pointer, Ctrl+D, Alt and drag", { alone: true }, async (tab) => {
  await tab.click(10, 9.85);
  await tab.press("Control+c");
  await tab.point(12, 2);
  await tab.press("Control+v");
  await tab.steps(1);
  const pasted = tab.json.fixtures[13];
  equal([pasted.id, pasted.preset], ["A5", "row"]);
  check(Math.abs(pasted.at[0] + 6 - 12) < 0.05 && Math.abs(pasted.at[1] + 0.45 - 2) < 0.05, `${pasted.at}`);
  equal(await tab.selected(), ["/fixtures/13"]);
  await tab.press("Control+d");
  await tab.steps(2);
  equal(tab.json.fixtures[14].id, "A6");
  await tab.drag([11, 14.4], [11, 16.4], { keys: ["Alt"] });
  await tab.steps(3);
  placed(
    [tab.json.fixtures[15].at, tab.json.fixtures[8].at],
    [
      [6, 16.2],
      [6, 14.2],
    ],
  );
  equal(tab.json.fixtures[15].id, "F3");
  await tab.press("Control+x");
  await tab.steps(4);
  equal(tab.json.fixtures.length, 15);
  await tab.press("Control+v");
  await tab.steps(5);
});

testPlanner("a copy in another shop brings its types along", {}, async (tab, given) => {
  const server = await given.serve("thesis");
  const other = await given.tab(server);
  const index = tab.json.fixtures.findIndex(({ preset, at }) => preset && at);
  const source = tab.json.fixtures[index];
  await tab.page.evaluate((k) => window.shelfbeamPlanner.planner.selection.setPaths([`/fixtures/${k}`]), index);
  await tab.page.focus(".surface");
  await tab.press("Control+c");
  const clip = await tab.page.evaluate(() => window.shelfbeamPlanner.planner.clip);
  await other.page.evaluate(({ copied, ...rest }) => {
    const clipboardData = new DataTransfer();
    clipboardData.setData("text/plain", JSON.stringify({ shelfbeam: copied, ...rest }));
    document.dispatchEvent(new ClipboardEvent("paste", { clipboardData }));
  }, clip);
  await other.steps(1);
  equal(Object.keys(clip.types.presets), [source.preset]);
  equal(other.json.presets[source.preset], tab.json.presets[source.preset]);
  check(other.json.materials !== undefined, "materials");
  equal(await other.page.evaluate(() => window.shelfbeamPlanner.planner.document.problems), []);
  await other.press("Control+z");
  await other.steps(0);
  check(server.text === server.first, "one step");
});

testPlanner("a mirror image writes only what changes", {}, async (tab) => {
  await tab.click(10, 9.85);
  await tab.press("Shift+H");
  await tab.until(() => document.querySelector(".notice").textContent === "This changes nothing.");
  check(await tab.isUntouched(), "the store is untouched");
  await tab.press("Shift+V");
  await tab.steps(1);
  equal(tab.json.fixtures[2].rotation_deg, 180);
});
