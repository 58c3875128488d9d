// Tests the light of the shop: from previews to simulated signals, by gestures, in both palettes.

import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { check, says } from "../viewer/check.mjs";
import { testAxe, testPlanner } from "./opened.mjs";
import { withFourUnits } from "./shops.mjs";
import { unitAt } from "./units.mjs";

const total = (tab) =>
  tab.state(({ planner: { light } }) => {
    light.refresh();
    return [...light.field.total];
  });

const inThesis = { store: "thesis", prepare: withFourUnits, light: true };

/** The candidate that has the first light. */
const litUnit = async (tab) =>
  unitAt(tab, ...(await tab.state(({ planner }) => planner.document.units.at(planner.light.units[0].index))));

testPlanner("light: labels are recoloured, faded and hatched in time", { ...inThesis, smoke: true }, async (tab) => {
  await tab.push("#tab-light");
  await tab.computes(({ planner }) => ["coarse", "fine"].includes(planner.light.stage));
  const legend = () => tab.text("#panel-light");
  says(await legend(), "preview");
  await tab.lit();
  // The panel is drawn a few times per second.
  await tab.until(() => document.querySelector("#panel-light").textContent.includes("Simulated"));
  check(!(await legend()).includes("preview"), "simulated values are not marked as previews");
  await tab.picture("light-done");

  // A gondola that moves makes the values old at once, and new ones follow.
  const generation = () => tab.state(({ planner }) => planner.light.event.generation);
  const before = await generation();
  await tab.page.focus(".surface");
  await tab.press("Control+a");
  // In the same task, so that no answer can come between.
  const isStale = ({ planner: { light } }) => {
    const key = { key: "ArrowRight", code: "ArrowRight", shiftKey: true, bubbles: true };
    document.activeElement.dispatchEvent(new KeyboardEvent("keydown", key));
    light.refresh();
    return light.isStale;
  };
  check(await tab.state(isStale), "the values are old");
  await tab.picture("light-stale");
  await tab.steps(1);
  check((await generation()) > before, "a generation of its own");
  await tab.lit();

  // A unit that is switched off takes its light with it, and undo brings it back.
  const all = await total(tab);
  const { at } = await litUnit(tab);
  await tab.click(at[0], at[1]);
  await tab.press("q");
  await tab.steps(2);
  const without = await total(tab);
  check(
    without.every((signal, label) => signal < all[label]),
    "less light everywhere",
  );
  await tab.press("Control+z");
  await tab.steps(1);
  const again = await total(tab);
  check(
    again.every((signal, label) => Math.abs(signal - all[label]) <= 1e-6 * all[label]),
    "undo brings it back",
  );
});

/** Four selected units, and a finished plan that reaches one label and misses another. */
function withPlan(folder) {
  withFourUnits(folder);
  const plan = join(folder, "plan");
  mkdirSync(plan);
  writeFileSync(join(plan, "placement.json"), '{ "model": "cooperative", "survives_failure": false }');
  writeFileSync(join(plan, "signal.h5"), "");
  writeFileSync(join(plan, "labels.csv"), "id,requirement,signal\nA1-front-1-8,0.01,0.02\nA1-front-1-9,0.01,0.001\n");
}

testAxe("light", { ...inThesis, prepare: withPlan, smoke: "dark" }, async (tab, clean, colours) => {
  const { page } = tab;
  await page.click("#tab-light");
  await tab.computes(({ planner }) => planner.light.isPreview);
  await tab.until(() => document.querySelector("#panel-light").textContent.includes("Hollow marks"));
  await clean("direct light, or a preview");
  await tab.lit();
  await tab.until(() => document.querySelector(".margins") !== null);
  says(await tab.text("#panel-light"), "Weakest labels", "Compared with plan “plan”");
  await clean("simulated, with a plan");
  await tab.picture(`light-${colours}`);
  await page.check('[name="palette"][value="clear"]', { force: true });
  await clean("the second palette");

  await page.click('#panel-light [data-key^="weak-"]');
  await tab.until(() => document.querySelector(".label-light dd") !== null);
  const [x, y] = await tab.state(({ planner: { document: shop, fan, selection } }) =>
    fan.place(shop.labels, selection.items[0].index),
  );
  await tab.point(x + 0.01, y);
  await tab.until(() => !document.querySelector(".label-card").hidden);
  await clean("a label with lines and the card");
  await page.focus(".surface");
  await tab.press("d");
  await tab.reaches(({ page: { stage } }) => stage.fixtures.group.children.length > 0);
  await clean("3-D");
  await tab.press("d", "Escape", "0");

  const { at } = await litUnit(tab);
  await tab.click(at[0], at[1]);
  await tab.drag([at[0], at[1]], [at[0] + 1, at[1] + 0.5], {
    during: async () => {
      await tab.reaches(({ planner }) => planner.light.dragged !== null);
      await clean("a unit is dragged");
      await tab.press("Escape");
    },
  });
  await tab.press("Escape", "Control+a");
  await tab.drag([8, 2.5], [8.3, 2.5], {
    during: async () => {
      const isStale = ({ planner: { light } }) => {
        light.refresh();
        return light.isStale;
      };
      check(await tab.state(isStale), "the values are old");
      await tab.until(() => document.querySelector("#panel-light").textContent.includes("Pale marks"));
      await clean("old values, while fixtures are dragged");
    },
  });
  await tab.steps(1);
  await tab.push("#tab-layers");
  await tab.use("level-0");
  await clean("a hidden level");
});
