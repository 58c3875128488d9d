// Tests how warnings and problems are shown: on the shape, in the lists, and in the panel.

import { check, equal, says } from "../viewer/check.mjs";
import { testPlanner } from "./opened.mjs";

const warned = (tab, least, most = Infinity) =>
  tab.reaches(
    ({ planner }, low, high) => {
      const { length } = planner.document.warnings;
      return length >= low && (high === null || length <= high);
    },
    least,
    most,
  );

/** Of a shape in the plan. */
const look = (tab, key) =>
  tab.evaluate((of) => {
    const shape = document.querySelector(`.shapes [data-key="${of}"]`);
    const { strokeDasharray, stroke } = getComputedStyle(shape);
    return { isMarked: shape.classList.contains("doubtful"), isDotted: strokeDasharray !== "none", stroke };
  }, key);

const stateInList = async (tab, name) => {
  await tab.page.fill(".objects input[type=search]", name);
  await tab.settle();
  return tab.text(".object .state");
};

/** Selects the problem with these words in the list. */
async function select(tab, words) {
  await tab.page.click(`.problem-list li:has-text("${words}") button`);
  await tab.settle();
}

testPlanner("a warning is on its shape, in both lists, and in the panel", {}, async (tab) => {
  await warned(tab, 0, 0);
  await tab.push("#tab-problems");
  says(await tab.text(".problem-list"), "No problems and no warnings.");
  await tab.push("#tab-objects");
  equal(await stateInList(tab, "F1"), null);
  const before = await look(tab, "fixtures/8");
  check(!before.isMarked && !before.isDotted, JSON.stringify(before));
  await tab.click(11, 14.4);
  await tab.fill("field/at/1", "17.5");
  await tab.steps(1);
  await warned(tab, 1);
  await tab.press("Escape", "Escape");
  await tab.settle();
  const after = await look(tab, "fixtures/8");
  check(after.isMarked && after.isDotted && after.stroke !== before.stroke, JSON.stringify(after));
  equal(await stateInList(tab, "F1"), "warning");
  check(await tab.has(".object.doubtful"), "the row is marked");
  await tab.push("#tab-problems");
  says(await tab.text(".problem-list"), "Warnings", "fixtures[8]", "outside the room");
  equal(await tab.text(".problem-list h3"), "Warnings");
  equal(await tab.text(".rail .badge"), String(await tab.count(".problem-list li.doubtful")), "the number of warnings");
  check(!(await tab.has(".rail .badge.wrong")), "warnings are not red");
  await select(tab, "outside the room");
  equal(await tab.selected(), ["/fixtures/8"]);
  says(await tab.text(".properties .problem"), "F1");
  await tab.press("Escape", "Control+z");
  await tab.steps(0);
  await warned(tab, 0, 0);
  await tab.settle();
  check(!(await look(tab, "fixtures/8")).isMarked, "the mark goes with the warning");
  check(await tab.has(".rail .badge[hidden]"), "the number goes, too");
});

testPlanner("a warning about a listed label is on its mark, and leads to it", { store: "chiller" }, async (tab) => {
  const before = await tab.state(({ planner }) => planner.document.warnings.length);
  const rings = () =>
    tab.evaluate(() => {
      const { left, top } = document.querySelector(".plan .surface").getBoundingClientRect();
      return [...document.querySelectorAll(".overlay .doubtful")].map((ring) => [
        Number(ring.getAttribute("cx")) + left,
        Number(ring.getAttribute("cy")) + top,
      ]);
    });
  equal(await rings(), []);
  await tab.click(0.9, 8.27);
  equal(await tab.selected(), ["/labels/0"]);
  await tab.fill("field/position/1", "8.6"); // into the counter
  await tab.steps(1);
  await warned(tab, before + 1);
  await tab.press("Escape", "Escape");
  await tab.click(5, 1);
  const [ring, ...others] = await rings();
  const place = await tab.at(0.9, 8.6);
  // Places of the pointer are whole pixels.
  check(Math.hypot(ring[0] - place[0], ring[1] - place[1]) < 2 && others.length === 0, `${ring} around ${place}`);
  equal(await stateInList(tab, "coffee-cup"), "warning");
  await tab.push("#tab-problems");
  await select(tab, "labels[0]");
  equal(await tab.selected(), ["/labels/0"]);
});

testPlanner("a problem stands beside its field, on its shape and in the list", {}, async (tab) => {
  await tab.click(11, 14.4);
  await tab.fill("field/height", "2000");
  await tab.steps(1);
  says(await tab.text('[data-field="/height"] .problem'), "is 2000 m, which is outside 0.001 to 1000 m");
  check(await tab.has('.shapes .wrong[data-key="fixtures/8"]'), "the shape is marked");
  await tab.press("Escape");
  equal(await tab.text(".rail .badge"), "1");
  await tab.push("#tab-problems");
  await select(tab, "fixtures[8].height");
  equal(await tab.selected(), ["/fixtures/8"]);
});
