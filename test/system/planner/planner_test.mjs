// node planner_test.mjs PACKAGES PAGE EXAMPLES WORK_FOLDER [FILTER]
//
// Tests the planner in Chromium by pointer and keys, with a stand-in for the server. Without a browser, exits with 77, or
// with an error in continuous integration (CI is set).

import { spawnSync } from "node:child_process";
import { mkdirSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

import { runAll } from "../viewer/check.mjs";
import { FakeServer } from "./fake_server.mjs";
import { Tab } from "./tab.mjs";

import "./select_test.mjs";
import "./change_test.mjs";
import "./kinds_test.mjs";
import "./panel_test.mjs";
import "./view_test.mjs";
import "./tabs_test.mjs";
import "./access_test.mjs";

const [packages, page, examples, work, filter = ""] = process.argv.slice(2);
const program = ["chromium", "chromium-browser", "google-chrome"]
  .map((name) => spawnSync("which", [name], { encoding: "utf8" }).stdout.trim())
  .find((path) => path !== "");
if (!program) {
  console.log("skipped: Chromium is missing (package chromium)");
  process.exit(process.env.CI ? 1 : 77);
}
const pictures = join(work, "pictures");
rmSync(pictures, { recursive: true, force: true });
mkdirSync(pictures, { recursive: true });

const { chromium } = createRequire(`${packages}/`)("playwright-core");
const browser = await chromium.launch({
  executablePath: program,
  args: ["--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
let servers = [];
let contexts = [];
const given = {
  axe: createRequire(`${packages}/`)("axe-core").source,
  async serve(store) {
    const server = new FakeServer(join(examples, store, "store.json"), page, packages);
    servers.push(server);
    await server.listen();
    return server;
  },
  async tab(server, { width = 1280, height = 720, dark = false, ...options } = {}) {
    const context = await browser.newContext({
      viewport: { width, height },
      colorScheme: dark ? "dark" : "light",
      ...options,
    });
    contexts.push(context);
    const tab = new Tab(await context.newPage(), server, pictures);
    await tab.open();
    return tab;
  },
};
const passed = await runAll(
  given,
  async () => {
    for (const context of contexts) await context.close();
    for (const server of servers) await server.close();
    [servers, contexts] = [[], []];
  },
  filter,
);
await browser.close();
process.exit(passed ? 0 : 1);
