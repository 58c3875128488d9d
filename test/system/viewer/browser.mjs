// Starts a browser without a window. Without one, the test ends as skipped (77), or with an error in continuous
// integration (CI is set).

import { spawnSync } from "node:child_process";
import { createRequire } from "node:module";

function cannotRun(why) {
  console.log(`skipped: ${why}`);
  process.exit(process.env.CI ? 1 : 77);
}

/** `kind`: chromium, nowebgl (Chromium without WebGL), or firefox. */
export async function startBrowser(packages, kind = "chromium") {
  const isFirefox = kind === "firefox";
  const executablePath = (isFirefox ? ["firefox-esr", "firefox"] : ["chromium", "chromium-browser", "google-chrome"])
    .map((name) => spawnSync("which", [name], { encoding: "utf8" }).stdout.trim())
    .find((path) => path !== "");
  if (!executablePath) cannotRun(`the browser is missing (package ${isFirefox ? "firefox-esr" : "chromium"})`);
  const { chromium, firefox } = createRequire(`${packages}/`)("playwright-core");
  if (isFirefox)
    return firefox.launch({ executablePath, channel: "moz-firefox" }).catch((error) => {
      // It is driven by WebDriver BiDi, whose newer commands Firefox has since version 143.
      if (error.message.includes("unknown command")) cannotRun("Firefox is too old");
      throw error;
    });
  const args = ["--no-sandbox", "--disable-dev-shm-usage"];
  if (kind === "nowebgl") args.push("--disable-3d-apis");
  else args.push("--use-angle=swiftshader", "--enable-unsafe-swiftshader");
  // Without a graphics card, the browser paints the page several times faster by itself.
  args.push("--disable-gpu-rasterization", "--disable-gpu-compositing");
  return chromium.launch({ executablePath, args });
}

/** A context of its own for one page or more. `options`: those of Playwright. */
export async function newContext(browser, { width = 1280, height = 720, dark = false, ...options } = {}) {
  const context = await browser.newContext({
    viewport: { width, height },
    colorScheme: dark ? "dark" : "light",
    ...options,
  });
  // Two cores without a graphics card need more than Playwright's 30 s for a picture of a large shop.
  context.setDefaultTimeout(180_000);
  return context;
}
