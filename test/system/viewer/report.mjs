// Opens reports in the browser, with common queries of their 3-D view.

import { join } from "node:path";
import { pathToFileURL } from "node:url";

import { newContext } from "./browser.mjs";
import { test } from "./check.mjs";
import { Page } from "./page.mjs";

export const urlOf = ({ folder }) => pathToFileURL(join(folder, "report.html")).href;

class Report extends Page {
  /** Calls a function in the page with the 3-D view (`view`) and JSON arguments. */
  run(call, ...values) {
    return this.evaluate(`window.shelfbeamViewer.then((view) => (${call})(view, ...${JSON.stringify(values)}))`);
  }

  focus(selector) {
    return this.evaluate((of) => document.querySelector(of).focus(), selector);
  }

  type(text) {
    return this.page.keyboard.insertText(text);
  }

  async click(x, y) {
    await this.page.mouse.click(x, y);
    await this.settle();
  }

  /** Clicks the upper left corner of an element. */
  async clickOn(selector) {
    await this.page.click(selector, { position: { x: 8, y: 8 } });
    await this.settle();
  }

  darken(dark) {
    return this.page.emulateMedia({ colorScheme: dark ? "dark" : "light" });
  }
}

/** Reports of one test, in tabs that `close` closes. */
export const reportsIn = (browser, pictures) => {
  const contexts = [];
  return {
    /**
     * Opens the report of a plan, with a hash the view of that link, and waits until the 3-D view is `ready`. `script`
     * runs before those of the page.
     */
    async open(plan, { hash = "", width = 1000, height = 600, ready = true, script, ...options } = {}) {
      const context = await newContext(browser, { width, height, ...options });
      contexts.push(context);
      if (script) await context.addInitScript(script);
      const report = new Report(await context.newPage());
      await report.page.goto(urlOf(plan) + hash);
      if (ready) await report.evaluate("window.shelfbeamViewer.then(() => true)");
      return report;
    },

    /** Saves a picture of the 3-D view and its controls. */
    picture: ({ page }, name) => page.locator("#viewer").screenshot({ path: join(pictures, `${name}.png`) }),

    close: () => Promise.all(contexts.map((context) => context.close())),
  };
};

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
