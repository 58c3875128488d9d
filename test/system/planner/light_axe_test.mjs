// Tests that axe has no findings in the states of light: from previews to simulated values, by gestures, in both palettes.

import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { check, equal, says } from "../viewer/check.mjs";
import { findings } from "./findings.mjs";
import { four, isDone, wait } from "./light.mjs";
import { testPlanner } from "./opened.mjs";
import { unitAt } from "./units.mjs";

/** Four selected units, and a finished plan that reaches one label and misses another. */
function withPlan(folder) {
  four(folder);
  const plan = join(folder, "plan");
  mkdirSync(plan);
  writeFileSync(join(plan, "placement.json"), '{ "model": "cooperative", "survives_failure": false }');
  writeFileSync(join(plan, "signal.h5"), "");
  writeFileSync(join(plan, "labels.csv"), "id,requirement,signal\nA1-front-1-8,0.01,0.02\nA1-front-1-9,0.01,0.001\n");
}

for (const dark of [false, true])
  testPlanner(
    `light: axe has no findings, ${dark ? "dark" : "light"}`,
    { store: "thesis", prepare: withPlan, light: true, dark, smoke: dark },
    async (tab, { axe }) => {
      const { page } = tab;
      const clean = async (what) => equal(await findings(tab, axe), [], what);
      const light = (read) => page.evaluate(read);
      const isStale = () => {
        const { light: now } = window.shelfbeamPlanner.planner;
        now.refresh();
        return now.isStale;
      };
      await page.click("#tab-light");
      await wait(tab, () => window.shelfbeamPlanner.planner.light.isPreview);
      says(await tab.text("#panel-light"), "Hollow marks");
      await clean("direct light, or a preview");
      await wait(tab, isDone);
      await tab.until(() => document.querySelector(".margins") !== null);
      says(await tab.text("#panel-light"), "Weakest labels", "Compared with plan “plan”");
      await clean("simulated, with a plan");
      await tab.picture(`light-${dark ? "dark" : "light"}`);
      await page.check('[name="palette"][value="clear"]', { force: true });
      await clean("the second palette");

      await page.click('#panel-light [data-key^="weak-"]');
      await tab.until(() => document.querySelector(".label-light dd") !== null);
      const [x, y] = await light(() => {
        const { document: shop, fan, selection } = window.shelfbeamPlanner.planner;
        return fan.place(shop.labels, selection.items[0].index);
      });
      await tab.point(x + 0.01, y);
      await tab.until(() => !document.querySelector(".label-card").hidden);
      await clean("a label with lines and the card");
      await page.focus(".surface");
      await tab.press("d");
      await tab.until(() => window.shelfbeamPlanner.page.stage.fixtures.group.children.length > 0);
      await clean("3-D");
      await tab.press("d", "Escape", "0");

      const { at } = await unitAt(
        tab,
        ...(await light(() => {
          const { document: shop, light: now } = window.shelfbeamPlanner.planner;
          return shop.units.at(now.units[0].index).slice(0, 2);
        })),
      );
      await tab.click(at[0], at[1]);
      await tab.drag([at[0], at[1]], [at[0] + 1, at[1] + 0.5], {
        during: async () => {
          await tab.until(() => window.shelfbeamPlanner.planner.light.dragged !== null);
          await clean("a unit is dragged");
          await tab.press("Escape");
        },
      });
      await tab.press("Escape", "Control+a");
      await tab.drag([8, 2.5], [8.3, 2.5], {
        during: async () => {
          check(await light(isStale), "the values are old");
          await tab.until(() => document.querySelector("#panel-light").textContent.includes("Pale marks"));
          await clean("old values, while fixtures are dragged");
        },
      });
      await tab.steps(1);
      await tab.push("#tab-layers");
      await tab.push('[data-key="level-0"]');
      await clean("a hidden level");
    },
  );
