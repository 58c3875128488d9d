// node planner-picture.mjs PACKAGES ADDRESS ELEMENT SCALE PNG: takes a picture of the planner with an element selected.

import { createRequire } from "node:module";

const [packages, address, element, scale, png] = process.argv.slice(2);
const { chromium } = createRequire(`${packages}/`)("playwright-core");

const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
try {
  const page = await browser.newPage({ viewport: { width: 1280, height: 720 }, deviceScaleFactor: Number(scale) });
  await page.goto(address);
  await page.locator("#panel-objects").getByText(element, { exact: true }).click();
  await page.locator("aside.properties").getByRole("heading", { name: element, exact: true }).waitFor();
  // The properties of presets, the labels and the names come some frames later.
  await page.waitForTimeout(3000);
  await page.screenshot({ path: png });
} finally {
  await browser.close();
}
