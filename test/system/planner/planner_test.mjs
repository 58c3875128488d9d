// node planner_test.mjs SHELFBEAM PACKAGES EXAMPLES WORK_FOLDER [smoke | FILTER [nowebgl | firefox]]
//
// Tests the planner in Chromium, in Chromium without WebGL, or in Firefox by pointer and keys: all tests, one for each
// area (smoke), or those with a text in their names.

import { mkdirSync, readdirSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

import { startBrowser } from "../viewer/browser.mjs";
import { runAll } from "../viewer/check.mjs";
import { Workshop } from "./workshop.mjs";

const [shelfbeam, packages, examples, work, filter = "", kind = "chromium"] = process.argv.slice(2);
const browser = await startBrowser(packages, kind);
const pictures = join(work, "pictures");
rmSync(pictures, { recursive: true, force: true });
mkdirSync(pictures, { recursive: true });

for (const name of readdirSync(new URL(".", import.meta.url)))
  if (name.endsWith("_test.mjs") && name !== "planner_test.mjs") await import(`./${name}`);

const axe = createRequire(`${packages}/`)("axe-core").source;
const passed = await runAll(() => new Workshop({ shelfbeam, packages, examples, work, browser, kind, pictures, axe }), {
  chosen: ({ name, isSmoke }) => (filter === "smoke" ? isSmoke : name.includes(filter)),
  lanes: 3, // most of the time, a page waits for the next frame
});
await browser.close();
process.exit(passed ? 0 : 1);
