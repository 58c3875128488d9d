// node planner_test.mjs SHELFBEAM PACKAGES PAGE EXAMPLES WORK_FOLDER [FILTER]
//
// Tests the planner in Chromium by pointer and keys. PAGE is the folder of the bundled page. A program without `serve` is
// replaced by a stand-in. Without a browser, exits with 77, or with an error in continuous integration (CI is set).

import { spawnSync } from "node:child_process";
import { mkdirSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

import { runAll } from "../viewer/check.mjs";
import { asset, FakeServer } from "./fake_server.mjs";
import { Served } from "./served.mjs";
import { Tab } from "./tab.mjs";

import "./select_test.mjs";
import "./change_test.mjs";
import "./kinds_test.mjs";
import "./panel_test.mjs";
import "./view_test.mjs";
import "./tabs_test.mjs";
import "./access_test.mjs";

const [shelfbeam, packages, page, examples, work, filter = ""] = process.argv.slice(2);
const hasServer = spawnSync(shelfbeam, ["serve", "--help"]).status === 0;
if (!hasServer) console.log(`${shelfbeam} has no server: tested with a stand-in`);
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
/** The page of the build, also if the program contains another one. */
function pageFiles(name) {
  const [, suffix] = /^[a-z]+\.(css|html|js|svg)$/.exec(name || "index.html") ?? [];
  return suffix ? asset(page, name || "index.html") : null;
}
let servers = [];
let contexts = [];
const given = {
  axe: createRequire(`${packages}/`)("axe-core").source,
  async serve(store) {
    if (hasServer) {
      const server = new Served(shelfbeam, join(examples, store), work);
      await server.start(packages, pageFiles);
      servers.push(server);
      return server;
    }
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
