// A test of the planner with one of the example stores. No test may leave an error in the console, or a store that
// undoing does not bring back.

import { equal, test } from "../viewer/check.mjs";

/** `run` gets the tab, and what makes more tabs and servers. */
export const testPlanner = (what, { store = "grocery", keeps = false, ...options }, run) =>
  test(what, async (given) => {
    const server = await given.serve(store);
    const tab = await given.tab(server, options);
    await run(tab, given);
    equal(tab.errors, [], "errors in the console");
    if (keeps) return;
    while (server.position > 0) {
      const { position } = server;
      await tab.page.evaluate(() => document.activeElement?.blur());
      await tab.press("Escape", "Escape", "Control+z");
      await tab.steps(position - 1);
    }
    equal(server.json, server.first, "store after undoing everything");
  });
