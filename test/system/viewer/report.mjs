// Reports in the browser, and what many tests ask of their 3-D view.

import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

import { test } from "./check.mjs";

export const urlOf = ({ folder }) => pathToFileURL(join(folder, "report.html")).href;

export const reportsIn = (browser, pictures) => ({
  /** The report of a plan; with a hash, the view of that link. */
  open: (plan, { hash = "", ...options } = {}) => browser.page(urlOf(plan) + hash, options),

  /** Keeps a picture of the 3-D view and its controls. */
  async picture(page, name) {
    const clip = await page.evaluate(() => {
      const { y, height } = document.querySelector("#viewer").getBoundingClientRect();
      return { x: 0, y: y + scrollY, width: innerWidth, height };
    });
    writeFileSync(join(pictures, `${name}.png`), await page.screenshot(clip));
  },
});

/** A test of the report of one of the plans: its name and how it is opened, then what to do with both. */
export const testReport = (what, { of, ...options }, run) =>
  test(what, async (given) => run(await given.open(given.plans[of], options), given.plans[of], given));

export const idsOf = (page) =>
  page.run(({ model: { store } }) => ({ labels: store.labels.ids, units: store.units.ids }));

export const factorOf = (page) => page.run((view) => view.model.store.unit.factor);

/** How many labels are reached, as the page says. */
export const reached = async (page) =>
  Number((await page.text("[data-fact=reached]")).split(" of ")[0].replace(/,/g, ""));

/** What the canvas tells of what it has drawn. */
export const drawn = (page) => page.evaluate(() => ({ ...document.querySelector(".v3-canvas").dataset }));

export const pressButton = (page, name) =>
  page.evaluate((of) => [...document.querySelectorAll(".v3 button")].find((e) => e.textContent === of).click(), name);
