// Tests the tools that draw rails, and candidates on faces.

import { check, equal, says } from "../viewer/check.mjs";
import { placed, testPlanner } from "./opened.mjs";

const last = (list) => list[list.length - 1];
const count = (tab) => tab.page.evaluate(() => window.shelfbeamPlanner.planner.document.units.count);
const notice = (tab, words) =>
  tab.until((wanted) => document.querySelector(".notice").textContent.includes(wanted), words);

/** Clicks on places that nothing attracts. */
async function freely(tab, ...places) {
  await tab.page.keyboard.down("Alt");
  for (const [x, y] of places) await tab.click(x, y);
  await tab.page.keyboard.up("Alt");
}

testPlanner("mounts: a rail with a corner, below the ceiling", { smoke: true }, async (tab) => {
  const before = await count(tab);
  await tab.press("t");
  await tab.fill("tool/below", "20cm");
  await tab.fill("tool/railId", "track");
  await tab.page.focus(".surface");
  await freely(tab, [5, 8.6], [9, 8.6], [9, 8.2]);
  await tab.press("Backspace");
  equal(await tab.page.evaluate(() => window.shelfbeamPlanner.page.gestures.scope.stroke.points.length), 2);
  await tab.press("Enter");
  await tab.steps(1);
  equal(await tab.labels(), ["Draw a rail"]);
  const [rail] = tab.json.transceivers.rails;
  equal([rail.id, rail.type, rail.spacing], ["track", "ceiling", 0.5]);
  placed(rail.points, [
    [5, 8.6, 3.4],
    [9, 8.6, 3.4],
  ]); // prettier-ignore
  check((await count(tab)) > before, "it has candidates");
  await freely(tab, [5, 6.2], [9, 6.2]);
  await tab.press("Escape");
  check((await tab.json.transceivers.rails).length === 1, "Esc draws nothing");
  await freely(tab, [5, 6.2]);
  await tab.page.keyboard.type("4");
  await tab.press("Tab");
  await tab.page.keyboard.type("0");
  await tab.press("Enter", "Enter");
  await tab.steps(2);
  equal(last(tab.json.transceivers.rails).id, "R1");
  await tab.press("Escape");
});

testPlanner("mounts: candidates around a column, on one face, and along a wall", { smoke: true }, async (tab) => {
  await tab.press("c");
  await tab.point(2.7, 3.7);
  equal(await tab.page.evaluate(() => document.querySelectorAll(".overlay .trace.face").length), 4);
  await tab.click(2.7, 3.7);
  await tab.steps(1);
  equal(await tab.labels(), ["Draw candidates on faces"]);
  equal(tab.json.transceivers.on, [{ type: "ceiling", fixture: "C1", z: 2.4, spacing: 1, tilt_deg: 30 }]);
  await tab.choose("tool/Faces", "the face at the pointer");
  await tab.fill("tool/faceHeight", "2");
  await tab.page.focus(".surface");
  await tab.click(10, 7.05);
  await tab.steps(2);
  equal(last(tab.json.transceivers.on), {
    type: "ceiling",
    fixture: "A2",
    face: "south",
    z: 1.9,
    spacing: 1,
    tilt_deg: 30,
  });
  await tab.click(24.95, 9);
  await tab.steps(3);
  equal([last(tab.json.transceivers.on).wall, last(tab.json.transceivers.on).face], [1, undefined]);
  await tab.click(12, 8.65);
  await notice(tab, "There is no fixture or wall with a name here");
  equal(await tab.page.evaluate(() => window.shelfbeamPlanner.planner.document.problems), []);
  says(await tab.text(".properties"), "Spacing");
  await tab.picture("mounts");
  await tab.press("Escape");
});

testPlanner("mounts: by keys alone", {}, async (tab) => {
  await tab.page.focus(".surface");
  await tab.press("t");
  for (let k = 0; k < 3; ++k) await tab.press("Shift+ArrowUp");
  await tab.press("Enter");
  for (let k = 0; k < 3; ++k) await tab.press("Shift+ArrowRight");
  await tab.press("Enter", "Enter");
  await tab.steps(1);
  equal(tab.json.transceivers.rails[0].points.length, 2);
  await tab.press("Escape");
});
