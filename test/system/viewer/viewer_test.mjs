// node viewer_test.mjs SHELFBEAM LARGE_REPORT WORK_FOLDER
//
// Tests the 3-D view of reports in Chromium: compares its display with the files of the plan, and its recounts with an
// independent count. Without a browser, exits with 77, or with an error in continuous integration (CI is set).

import { spawnSync } from "node:child_process";
import { existsSync, mkdirSync, readdirSync, rmSync } from "node:fs";
import { join } from "node:path";

import { startBrowser } from "./browser.mjs";
import { runAll } from "./check.mjs";
import { makeLargePlan, makePlans } from "./plans.mjs";
import { reportsIn } from "./report.mjs";

import "./numbers_test.mjs";
import "./tables_test.mjs";
import "./verdicts_test.mjs";
import "./marks_test.mjs";
import "./changes_test.mjs";
import "./look_test.mjs";
import "./states_test.mjs";

const [shelfbeam, largeReport, work] = process.argv.slice(2);
const chromium = ["chromium", "chromium-browser", "google-chrome"].find(
  (name) => spawnSync(name, ["--version"]).status === 0,
);
if (!chromium) {
  console.log("skipped: Chromium is missing (package chromium)");
  process.exit(process.env.CI ? 1 : 77);
}

// Only what an earlier run left is removed.
if (existsSync(work) && readdirSync(work).length > 0 && !existsSync(join(work, "pictures")))
  throw new Error(`${work} contains other files; give an empty folder`);
rmSync(work, { recursive: true, force: true });
mkdirSync(join(work, "pictures"), { recursive: true });
const plans = makePlans(shelfbeam, work);
const browser = await startBrowser(chromium);
const given = {
  plans,
  makeLargePlan: () => makeLargePlan(shelfbeam, largeReport, work),
  ...reportsIn(browser, join(work, "pictures")),
};
const passed = await runAll(() => ({ ...given, close: () => browser.closePages() }));
await browser.close();
process.exit(passed ? 0 : 1);
