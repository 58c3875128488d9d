// Tests how warnings are shown: on the shape, in the lists, and in the panel.

import { check, equal, says } from "../viewer/check.mjs";
import { testPlanner } from "./opened.mjs";

const warned = (tab, count) =>
  tab.until((of) => window.shelfbeamPlanner.planner.document.warnings.length === of, count);

/** Of a shape in the plan. */
const look = (tab, key) =>
  tab.page.evaluate((of) => {
    const shape = document.querySelector(`.shapes [data-key="${of}"]`);
    const { strokeDasharray, stroke } = getComputedStyle(shape);
    return { isMarked: shape.classList.contains("doubtful"), isDotted: strokeDasharray !== "none", stroke };
  }, key);

const stateInList = async (tab, name) => {
  await tab.page.fill(".objects input[type=search]", name);
  await tab.settle();
  return tab.text(".object .state");
};

testPlanner("a warning is on its shape, in both lists, and in the panel", {}, async (tab) => {
  await warned(tab, 0);
  await tab.push("#tab-problems");
  says(await tab.text(".problem-list"), "No problems and no warnings.");
  await tab.push("#tab-objects");
  equal(await stateInList(tab, "F1"), null);
  const before = await look(tab, "fixtures/8");
  check(!before.isMarked && !before.isDotted, JSON.stringify(before));
  await tab.click(11, 14.4);
  await tab.fill("field/at/1", "17.5");
  await tab.steps(1);
  await tab.until(() => window.shelfbeamPlanner.planner.document.warnings.length > 0);
  await tab.press("Escape", "Escape");
  await tab.settle();
  const after = await look(tab, "fixtures/8");
  check(after.isMarked && after.isDotted && after.stroke !== before.stroke, JSON.stringify(after));
  equal(await stateInList(tab, "F1"), "warning");
  equal(await tab.page.evaluate(() => document.querySelector(".object").classList.contains("doubtful")), true);
  await tab.push("#tab-problems");
  says(await tab.text(".problem-list"), "Warnings", "fixtures[8]", "outside the room");
  equal(await tab.page.evaluate(() => document.querySelector(".problem-list h3").textContent), "Warnings");
  const { badge, isRed, count } = await tab.page.evaluate(() => ({
    badge: document.querySelector(".rail .badge").textContent,
    isRed: document.querySelector(".rail .badge").classList.contains("wrong"),
    count: document.querySelectorAll(".problem-list li.doubtful").length,
  }));
  equal([badge, isRed], [String(count), false], "the number of warnings");
  await tab.page.click('.problem-list li:has-text("outside the room") button');
  await tab.settle();
  equal(await tab.selected(), ["/fixtures/8"]);
  says(await tab.text(".properties .problem"), "F1");
  await tab.press("Escape", "Control+z");
  await tab.steps(0);
  await warned(tab, 0);
  await tab.settle();
  check(!(await look(tab, "fixtures/8")).isMarked, "the mark goes with the warning");
  equal(await tab.page.evaluate(() => document.querySelector(".rail .badge").hidden), true);
});

testPlanner(
  "a warning about a listed label is on its mark, in both lists, and leads to it",
  { store: "chiller" },
  async (tab) => {
    const { length } = await tab.page.evaluate(() => window.shelfbeamPlanner.planner.document.warnings);
    await tab.click(0.9, 8.27);
    equal(await tab.selected(), ["/labels/0"]);
    // Into the counter.
    await tab.press("Escape", "Escape");
    const rings = () =>
      tab.page.evaluate(() => {
        const { left, top } = document.querySelector(".plan .surface").getBoundingClientRect();
        return [...document.querySelectorAll(".overlay .doubtful")].map((ring) => [
          Number(ring.getAttribute("cx")) + left,
          Number(ring.getAttribute("cy")) + top,
        ]);
      });
    equal(await rings(), []);
    await tab.click(0.9, 8.27);
    await tab.fill("field/position/1", "8.6");
    await tab.steps(1);
    await tab.until((before) => window.shelfbeamPlanner.planner.document.warnings.length > before, length);
    await tab.press("Escape", "Escape");
    await tab.click(5, 1);
    const [ring, ...others] = await rings();
    const place = await tab.at(0.9, 8.6);
    // Places of the pointer are whole pixels.
    check(Math.hypot(ring[0] - place[0], ring[1] - place[1]) < 2 && others.length === 0, `${ring} around ${place}`);
    equal(await stateInList(tab, "coffee-cup"), "warning");
    await tab.push("#tab-problems");
    says(await tab.text(".problem-list"), "labels[0]", "inside");
    await tab.page.click('.problem-list li:has-text("labels[0]") button');
    await tab.settle();
    equal(await tab.selected(), ["/labels/0"]);
  },
);
