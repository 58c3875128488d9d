// Tests gestures that change the store: one gesture is one step, with Esc and Ctrl+Z in the middle of it.

import { check, equal } from "../viewer/check.mjs";
import { placed, testPlanner } from "./opened.mjs";

const placeOf = ({ at, rotation_deg }) => [at, rotation_deg];

testPlanner("a drag moves, whole centimetres, one step", { smoke: true }, async (tab) => {
  await tab.press("+", "+", "+"); // so that neighbours attract from 14 cm only
  await tab.drag([10, 9.85], [11, 10.35]);
  await tab.steps(1);
  placed(tab.json.fixtures[2].at, [6, 9.9]);
  equal(await tab.labels(), ["Move A3"]);
  await tab.click(10, 7.45);
  await tab.click(10, 5.05, { keys: ["Shift"] });
  await tab.drag([10, 7.45], [10, 8]);
  await tab.steps(2);
  placed([tab.json.fixtures[0].at, tab.json.fixtures[1].at].flat(), [5, 5.15, 5, 7.55]);
  equal((await tab.labels())[1], "Move 2 fixtures");
});

testPlanner("a dragged element holds on to its neighbour, with Shift on one axis", {}, async (tab) => {
  // F1 touches F2.
  const [, y] = tab.json.fixtures[8].at;
  const during = async () => check(await tab.has(".overlay .guide.line"), "no guide");
  await tab.drag([11, 14.6], [11.3, 14.4], { during });
  await tab.steps(1);
  equal(tab.json.fixtures[8].at[1], y);
  await tab.click(10, 9.85);
  await tab.drag([10, 9.85], [11, 10.1], { keys: ["Shift"] });
  await tab.steps(2);
  placed(tab.json.fixtures[2].at, [6, 9.4]);
  equal(tab.json.fixtures[2].at[1], 9.4);
});

for (const key of ["Escape", "Control+z"])
  testPlanner(`${key} in the middle of a gesture cancels it`, {}, async (tab) => {
    const outline = () => tab.evaluate(() => document.querySelector('[data-key="fixtures/8"]').getAttribute("d"));
    const before = await outline();
    const during = async () => {
      check((await outline()) !== before, "the outline follows the pointer");
      await tab.press(key);
      equal(await outline(), before);
    };
    await tab.drag([11, 14.4], [12, 13], { during });
    equal(await tab.selected(), ["/fixtures/8"], "selection");
    await tab.dragPixels(await tab.grip("x1"), await tab.at(18, 15), { during });
    const turn = await tab.grip("turn");
    await tab.dragPixels(turn, [turn[0] + 80, turn[1] + 20], { during });
    await tab.drag([11, 14.4], [12, 13], { keys: ["Alt"], during: () => tab.press(key) });
    check(await tab.isUntouched(), "the store is untouched");
  });

testPlanner("no key changes the store in the middle of a gesture", { alone: true }, async (tab) => {
  await tab.click(11, 14.4);
  await tab.press("Control+c");
  const during = () => tab.press("Delete", "Control+x", "Control+v", "Control+d", "r", "ArrowRight", "Control+y", "-");
  const { scale } = await tab.view();
  await tab.drag([10, 9.85], [11, 10.35], { during });
  await tab.steps(1);
  equal([await tab.labels(), await tab.selected()], [["Move A3"], ["/fixtures/2"]]);
  check((await tab.view()).scale < scale, "the view may change");
});

testPlanner("undo and redo in quick succession lose no step, and no nudge joins a drag", {}, async (tab) => {
  await tab.drag([10, 9.85], [11, 10.35]);
  await tab.press("Shift+ArrowRight");
  await tab.steps(2);
  const after = tab.server.text;
  for (const count of [3, 4, 5]) {
    await tab.press("r");
    await tab.steps(count);
  }
  await tab.press(...Array(5).fill("Control+z"));
  await tab.steps(0);
  await tab.press("Control+y", "Control+y");
  await tab.steps(2);
  equal(tab.server.text, after);
});

testPlanner("arrows move by 1 cm, with Shift by 10, and nudges join", {}, async (tab) => {
  await tab.click(10, 9.85);
  // In one task, so that they join.
  await tab.evaluate(() => {
    const key = { key: "ArrowRight", code: "ArrowRight", bubbles: true, cancelable: true };
    for (let k = 0; k < 3; ++k) document.activeElement.dispatchEvent(new KeyboardEvent("keydown", key));
  });
  await tab.steps(1);
  equal(tab.json.fixtures[2].at, [5.03, 9.4]);
  await tab.press("Shift+ArrowUp");
  await tab.steps(2);
  equal(tab.json.fixtures[2].at, [5.03, 9.5]);
});

testPlanner("R turns about the middle, the handle by 15 degrees, Alt by one", {}, async (tab) => {
  await tab.click(11, 14.4);
  await tab.press("r");
  await tab.steps(1);
  equal(placeOf(tab.json.fixtures[8]), [[11.4, 9.6], 90]);
  const undo = async () => {
    await tab.press("Control+z");
    await tab.steps(0);
  };
  await undo();
  const turn = await tab.grip("turn");
  const middle = await tab.at(11, 14.6);
  const radius = middle[1] - turn[1];
  const angle = (50 * Math.PI) / 180;
  const to = [middle[0] - radius * Math.sin(angle), middle[1] - radius * Math.cos(angle)];
  for (const [keys, expected, slack] of [
    [[], 45, 0],
    [["Alt"], 50, 2],
  ]) {
    await tab.dragPixels(await tab.grip("turn"), to, { keys });
    await tab.steps(1);
    const { rotation_deg } = tab.json.fixtures[8];
    check(Math.abs(rotation_deg - expected) <= slack, `${rotation_deg} instead of ${expected}`);
    await undo();
  }
  await tab.drag([5.6, 16.2], [16.6, 13.9]);
  equal(await tab.selected(), ["/fixtures/8", "/fixtures/9"]);
  await tab.press("r");
  await tab.steps(1);
  const group = [
    [[11.8, 10], 90],
    [[11, 10], 90],
  ];
  equal(tab.json.fixtures.slice(8, 10).map(placeOf), group, "a group turns about its middle");
});

testPlanner("a handle moves one side, the opposite one stays, also when turned", {}, async (tab) => {
  await tab.click(11, 14.4);
  await tab.dragPixels(await tab.grip("x1"), await tab.at(17, 14.6));
  await tab.steps(1);
  placed([tab.json.fixtures[8].length, tab.json.fixtures[8].at], [11, [6, 14.2]]);
  await tab.press("r");
  await tab.steps(2);
  // The fixture now stands upright around (11.5, 14.6); its lower side is x0.
  const { at, length } = tab.json.fixtures[8];
  await tab.dragPixels(await tab.grip("x0"), await tab.at(11.5, at[1] + 2));
  await tab.steps(3);
  const after = tab.json.fixtures[8];
  check(Math.abs(after.at[1] + after.length - (at[1] + length)) < 1e-6, "the upper side stays");
  check(Math.abs(after.length - (length - 2)) < 0.1, `length ${after.length}`);
});

testPlanner("deleted elements leave the selection, and the others keep their places", {}, async (tab) => {
  await tab.click(10, 9.85);
  await tab.press("Delete");
  await tab.steps(1);
  equal([await tab.selected(), tab.json.fixtures.length, await tab.labels()], [[], 12, ["Delete A3"]]);
  await tab.click(11, 14.4);
  equal(await tab.selected(), ["/fixtures/7"]);
  await tab.press("Control+z");
  await tab.steps(0);
  equal(await tab.selected(), ["/fixtures/8"], "the same fixture after undo");
});

testPlanner("align, distribute and mirror", {}, async (tab) => {
  const axis = (k) => tab.json.fixtures.slice(0, 4).map(({ at }) => at[k]);
  await tab.click(10, 9.85);
  await tab.press("Shift+H");
  await tab.notice("This changes nothing.");
  check(await tab.isUntouched(), "the store is untouched");
  await tab.press("Shift+ArrowRight", "Shift+ArrowDown");
  await tab.steps(2);
  for (const y of [5.05, 7.45, 12.25]) await tab.click(10, y, { keys: ["Shift"] });
  await tab.use("tool-align_left");
  await tab.steps(3);
  equal([axis(0), (await tab.labels())[2]], [[5, 5, 5, 5], "Align 4 fixtures"]);
  await tab.use("tool-distribute_y");
  await tab.steps(4);
  equal([axis(1), (await tab.labels())[3]], [[4.6, 7, 9.4, 11.8], "Distribute 4 fixtures"]);
  await tab.click(11, 14.4);
  await tab.press("Shift+V");
  await tab.steps(5);
  equal([...placeOf(tab.json.fixtures[8]), (await tab.labels())[4]], [[16, 15], 180, "Mirror F1"]);
});
