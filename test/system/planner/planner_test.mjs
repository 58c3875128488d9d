// node planner_test.mjs SHELFBEAM PACKAGES EXAMPLES WORK_FOLDER [smoke | FILTER [nowebgl | firefox]]
//
// Tests the planner in Chromium, in Chromium without WebGL, or in Firefox by pointer and keys: all tests, one for each
// area (smoke), or those with a text in their names. Without the browser, exits with 77, or with an error in continuous
// integration (CI is set).

import { spawnSync } from "node:child_process";
import { mkdirSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

import { runAll } from "../viewer/check.mjs";
import { Workshop } from "./workshop.mjs";

import "./select_test.mjs";
import "./change_test.mjs";
import "./copy_test.mjs";
import "./kinds_test.mjs";
import "./every_kind_test.mjs";
import "./panel_test.mjs";
import "./fields_test.mjs";
import "./notices_test.mjs";
import "./checks_test.mjs";
import "./sources_test.mjs";
import "./names_test.mjs";
import "./view_test.mjs";
import "./backdrop_test.mjs";
import "./device_test.mjs";
import "./pdf_test.mjs";
import "./dxf_test.mjs";
import "./table_test.mjs";
import "./draw_test.mjs";
import "./units_test.mjs";
import "./unit_drag_test.mjs";
import "./mounts_test.mjs";
import "./light_test.mjs";
import "./light_axe_test.mjs";
import "./plans_test.mjs";
import "./trace_test.mjs";
import "./tabs_test.mjs";
import "./random_test.mjs";
import "./access_test.mjs";
import "./keyboard_test.mjs";
import "./layout_test.mjs";
import "./elsewhere_test.mjs";

const [shelfbeam, packages, examples, work, filter = "", kind = "chromium"] = process.argv.slice(2);
const isFirefox = kind === "firefox";
const program = (isFirefox ? ["firefox-esr", "firefox"] : ["chromium", "chromium-browser", "google-chrome"])
  .map((name) => spawnSync("which", [name], { encoding: "utf8" }).stdout.trim())
  .find((path) => path !== "");
function cannotRun(why) {
  console.log(`skipped: ${why}`);
  process.exit(process.env.CI ? 1 : 77);
}
if (!program) cannotRun(`the browser is missing (package ${isFirefox ? "firefox-esr" : "chromium"})`);
const pictures = join(work, "pictures");
rmSync(pictures, { recursive: true, force: true });
mkdirSync(pictures, { recursive: true });

const require = createRequire(`${packages}/`);
const { chromium, firefox } = require("playwright-core");
const browser = isFirefox
  ? await firefox.launch({ executablePath: program, channel: "moz-firefox" }).catch((error) => {
      // It is driven by WebDriver BiDi, whose newer commands Firefox has since version 143.
      if (error.message.includes("unknown command")) cannotRun("Firefox is too old");
      throw error;
    })
  : await chromium.launch({
      executablePath: program,
      args: [
        "--no-sandbox",
        "--disable-dev-shm-usage",
        ...(kind === "nowebgl" ? ["--disable-3d-apis"] : ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]),
        // Without a graphics card, the browser paints the page several times faster by itself.
        "--disable-gpu-rasterization",
        "--disable-gpu-compositing",
      ],
    });
const axe = require("axe-core").source;
const passed = await runAll(() => new Workshop({ shelfbeam, packages, examples, work, browser, kind, pictures, axe }), {
  chosen: ({ name, isSmoke }) => (filter === "smoke" ? isSmoke : name.includes(filter)),
  lanes: 3, // most of the time, a page waits for the next frame
});
await browser.close();
process.exit(passed ? 0 : 1);
