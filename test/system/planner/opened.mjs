// A test of the planner with one of the example stores. No test may leave an error in the console, a request without an
// answer, or a store that undoing does not bring back.

import { check, equal, test } from "../viewer/check.mjs";

/** The options of a test that begins without a store file and leaves one. */
export const inEmptyShop = { store: null, keeps: true };

/**
 * `run` gets the tab, and what makes more tabs and servers. `keeps`: it leaves the store changed. `alone`: it uses what
 * all pages share, such as the clipboard.
 */
export const testPlanner = (
  what,
  { store = "grocery", prepare, keeps = false, smoke = false, alone = false, light = false, ...options },
  run,
) =>
  test(
    what,
    async (given) => {
      const server = await given.serve(store, prepare, light);
      const tab = await given.tab(server, options);
      await run(tab, given);
      equal(tab.errors, [], "errors in the console");
      if (keeps) return;
      for (let { length } = await tab.labels(); length > 0; --length) {
        await tab.evaluate(() => document.activeElement?.blur());
        await tab.press("Escape", "Escape", "Control+z");
        await tab.steps(length - 1);
      }
      check(server.text === server.first, "undoing everything does not bring the store back");
    },
    { isSmoke: smoke, isAlone: alone },
  );

/**
 * Tests an area of the planner in light and dark colours. `run` gets the tab, and a function that expects no findings of
 * axe-core. `smoke`: the colours of the smoke test.
 */
export function testAxe(area, { smoke = null, ...options }, run) {
  for (const colours of ["light", "dark"])
    testPlanner(
      `${area}: axe has no findings, ${colours}`,
      { ...options, dark: colours === "dark", smoke: colours === smoke },
      async (tab, { axe }) => {
        const clean = async (what) => {
          await tab.page.evaluate(axe); // by the driver, past the content security policy
          const findings = await tab.evaluate(async () => {
            const { violations } = await window.axe.run(document, { resultTypes: ["violations"] });
            return violations.map(
              ({ id, nodes }) =>
                `${id}: ${nodes.map(({ target, failureSummary }) => `${target} ${failureSummary}`).join("; ")}`,
            );
          });
          equal(findings, [], what);
        };
        await run(tab, clean, colours);
      },
    );
}

/** Places that a drag by whole pixels can reach: within 5 cm, in whole centimetres. */
export function placed(found, expected, what = "place") {
  const isNear = (a, b) =>
    Array.isArray(b)
      ? Array.isArray(a) && a.length === b.length && b.every((value, k) => isNear(a[k], value))
      : Math.abs(a - b) <= 0.05 && Math.abs(100 * a - Math.round(100 * a)) < 1e-6;
  check(isNear(found, expected), `${what}: found ${JSON.stringify(found)}, expected about ${JSON.stringify(expected)}`);
}
