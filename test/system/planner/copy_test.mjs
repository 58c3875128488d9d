// Tests copies, also in another shop.

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
  placed([...tab.json.fixtures[15].at, ...tab.json.fixtures[8].at], [6, 16.2, 6, 14.2]);
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
  await tab.click(10, 9.85);
  await tab.press("Control+c");
  const clip = await tab.state(({ planner }) => planner.clip);
  await other.evaluate(({ copied, ...rest }) => {
    const clipboardData = new DataTransfer();
    clipboardData.setData("text/plain", JSON.stringify({ shelfbeam: copied, ...rest }));
    document.dispatchEvent(new ClipboardEvent("paste", { clipboardData }));
  }, clip);
  await other.steps(1);
  equal(Object.keys(clip.types.presets), ["row"]);
  equal(other.json.presets.row, tab.json.presets.row);
  equal(await other.problems(), []);
  await other.press("Control+z");
  await other.steps(0);
  check(server.text === server.first, "one step");
});
