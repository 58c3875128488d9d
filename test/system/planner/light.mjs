// What tests of light share.

import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const limit = 8 * 60_000; // ms, for plans beside other tests on a loaded machine

/** As `Tab.until`, for what takes a simulation. */
export async function wait(tab, condition, ...values) {
  for (const end = Date.now() + limit; ; await new Promise((done) => setTimeout(done, 100))) {
    if (await tab.page.evaluate(condition, ...values)) return;
    if (Date.now() > end) throw new Error(`did not happen: ${condition}`);
  }
}

export const isDone = () => window.shelfbeamPlanner.planner.light.event?.phase === "done";

/** Selects candidates of the first grid in the middle of the shop. */
function select(ids) {
  return (folder) => {
    const file = join(folder, "store.json");
    const text = readFileSync(file, "utf8");
    const at = text.indexOf("{", text.indexOf('"transceivers"')) + 1;
    writeFileSync(file, `${text.slice(0, at)} "selected": ${JSON.stringify(ids)}, ${text.slice(at)}`);
  };
}
export const four = select(["G1-2-2", "G1-5-2", "G1-2-5", "G1-5-5"]);
