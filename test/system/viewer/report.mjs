// Opens reports in the browser, with common queries of their 3-D view.

import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

import { test } from "./check.mjs";

export const urlOf = ({ folder }) => pathToFileURL(join(folder, "report.html")).href;

export const reportsIn = (browser, pictures) => ({
  /** Opens the report of a plan; with a hash, the view of that link. */
  open: (plan, { hash = "", ...options } = {}) => browser.page(urlOf(plan) + hash, options),

  /** Saves a picture of the 3-D view and its controls. */
  async picture(page, name) {
    const clip = await page.evaluate(() => {
      const { y, height } = document.querySelector("#viewer").getBoundingClientRect();
      return { x: 0, y: y + scrollY, width: innerWidth, height };
    });
    writeFileSync(join(pictures, `${name}.png`), await page.screenshot(clip));
  },
});

/** Defines a test of the report of a plan: the plan's name, the options of opening it, and the test function. */
export const testReport = (what, { of, ...options }, run) =>
  test(what, async (given) => run(await given.open(given.plans[of], options), given.plans[of], given));

export const idsOf = (page) =>
  page.run(({ model: { store } }) => ({ labels: store.labels.ids, units: store.units.ids }));

export const factorOf = (page) => page.run((view) => view.model.store.unit.factor);

/** The number of reached labels on the page. */
export const reached = async (page) =>
  Number((await page.text("[data-fact=reached]")).split(" of ")[0].replace(/,/g, ""));

/** The canvas's description of its picture. */
export const drawn = (page) => page.evaluate(() => ({ ...document.querySelector(".v3-canvas").dataset }));

export const pressButton = (page, name) =>
  page.evaluate((of) => [...document.querySelectorAll(".v3 button")].find((e) => e.textContent === of).click(), name);
