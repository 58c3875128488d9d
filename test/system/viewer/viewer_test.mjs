// node viewer_test.mjs SHELFBEAM LARGE_REPORT WORK_FOLDER [FILTER]
//
// Tests the 3-D view of reports in Chromium: compares its display with the files of the plan, and its recounts with an
// independent count. VIEWER_PACKAGES is the folder of the npm packages.

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

const [shelfbeam, largeReport, work, filter = ""] = process.argv.slice(2);
const browser = await startBrowser(process.env.VIEWER_PACKAGES);

// Only what an earlier run left is removed.
if (existsSync(work) && readdirSync(work).length > 0 && !existsSync(join(work, "pictures")))
  throw new Error(`${work} contains other files; give an empty folder`);
rmSync(work, { recursive: true, force: true });
const pictures = join(work, "pictures");
mkdirSync(pictures, { recursive: true });
const plans = makePlans(shelfbeam, work);
const makeLarge = () => makeLargePlan(shelfbeam, largeReport, work);
const passed = await runAll(() => ({ plans, makeLarge, ...reportsIn(browser, pictures) }), {
  chosen: ({ name }) => name.includes(filter),
});
await browser.close();
process.exit(passed ? 0 : 1);
