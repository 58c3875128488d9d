// Tests plans of the planner: from the question to the report, which is that of `shelfbeam plan`.

import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";

import { check, equal } from "../viewer/check.mjs";
import { findings } from "./findings.mjs";
import { wait } from "./light.mjs";
import { testPlanner } from "./opened.mjs";
import { smallShop } from "./small_shop.mjs";

const hasEnded = () => {
  const { runs } = window.shelfbeamPlanner.planner.plans;
  return runs.length > 0 && runs.every(({ state }) => state === "done" || state === "stopped" || state === "failed");
};

async function openPlans({ page }) {
  await page.click("#tab-plans");
}

const textOf = ({ page }, selector) =>
  page.evaluate((query) => document.querySelector(query)?.innerText ?? "", selector);

testPlanner(
  "plans: units are planned, certified, selected and handed over",
  { store: "thesis", prepare: smallShop(), smoke: true },
  async (tab, { tools }) => {
    await openPlans(tab);
    await tab.page.click("#panel-plans .primary");
    await wait(tab, () => window.shelfbeamPlanner.planner.plans.active?.first);
    await tab.until(() =>
      document.querySelector(".plan-running .since").innerText.startsWith("First answer, from a preview:"),
    );
    await wait(tab, hasEnded);
    const { folder } = tab.server;
    const placement = JSON.parse(readFileSync(join(folder, "plan", "placement.json"), "utf8"));
    await tab.until(() => window.shelfbeamPlanner.planner.plans.runs[0].entered);
    equal(tab.server.json.transceivers.selected, placement.selected);
    check((await textOf(tab, ".plan-result .answer")).includes("with 99 % confidence"), "no answer");
    await tab.until(() => document.querySelector(".plan-result dl")?.innerText.includes("One unit fewer?"));
    await tab.page.click('[data-key="enter-one_more"]');
    await tab.steps(2);
    equal(tab.server.json.transceivers.selected, placement.alternatives.one_more.selected);
    // The same command on the shop as it was writes the same files.
    await tab.press("Control+z", "Control+z");
    await tab.steps(0);
    equal(tab.server.text, tab.server.first);
    const again = join(folder, "again");
    const { status, stderr } = spawnSync(
      tools.shelfbeam,
      ["plan", join(folder, "store.json"), "-o", again, "--quiet"],
      { encoding: "utf8" },
    );
    equal([status, stderr], [0, ""]);
    for (const file of ["report.html", "placement.json", "mounting.csv", "mounting.dxf", "labels.csv", "signal.h5"])
      check(readFileSync(join(again, file)).equals(readFileSync(join(folder, "plan", file))), `${file} differs`);
    // The links give these files, and the report runs on its own.
    const links = await tab.page.$$eval(".plan-result .files a", (list) =>
      list.map(({ href, download }) => ({ href, download })),
    );
    equal(links.length, 6);
    const report = await tab.page.context().newPage();
    const errors = [];
    report.on("pageerror", (error) => errors.push(error.message));
    report.on("console", (message) => message.type() === "error" && errors.push(message.text()));
    await report.goto(links[0].href);
    await report.waitForSelector("h1");
    equal(errors, []);
    await report.close();
    // Plans of the command line are in the list, and two plans can be compared.
    await tab.until(() => window.shelfbeamPlanner.planner.plans.runs.length === 2);
    for (const row of [0, 1]) await tab.page.locator(".plan-list input").nth(row).click();
    await tab.page.click("text=Compare the two");
    await tab.page.waitForSelector("dialog >> text=The plans are the same.");
    await tab.press("Escape");
    // The archive has the shop and both plans, and leaves nothing behind.
    const [download] = await Promise.all([
      tab.page.waitForEvent("download"),
      tab.page.click("text=Save the project as a zip file"),
    ]);
    const list = spawnSync("python3", ["-m", "zipfile", "--list", await download.path()], { encoding: "utf8" }).stdout;
    for (const file of ["store.json", "plan/report.html", "plan/signal.h5", "again/placement.json"])
      check(list.includes(`/${file} `), `${file} is not in the archive:\n${list}`);
    check(!list.includes(".shelfbeam"), "the archive has hidden files");
  },
);

testPlanner(
  "plans: a plan that is cancelled keeps its best units",
  { store: "thesis", prepare: smallShop() },
  async (tab) => {
    await openPlans(tab);
    await tab.page.evaluate(() =>
      window.shelfbeamPlanner.planner.plans.start({ simulation: { samples: 10_000_000 } }, "a long plan"),
    );
    await wait(tab, () => {
      const { state, progress } = window.shelfbeamPlanner.planner.plans.active ?? {};
      return state === "running" && progress?.task === "simulating" && progress.share > 0.02;
    });
    await tab.page.click("text=End, and keep the best");
    await wait(tab, hasEnded);
    await tab.until(() => document.querySelector(".plan-result").innerText.includes("ended early"));
    await tab.until(() => window.shelfbeamPlanner.planner.plans.runs[0].entered);
  },
);

testPlanner("plans: a shop that cannot be planned says why", { store: null, keeps: true }, async (tab) => {
  await openPlans(tab);
  await tab.until(() => document.querySelector("#panel-plans").innerText.includes("Give fixtures labels first."));
  equal(await tab.page.$eval("#panel-plans .primary", ({ disabled }) => disabled), true);
});

const changing = {
  people: [{ area: "room", number: { uniform: [2, 3] }, size: [0.5, 0.3, 1.75], material: "paper" }],
  stocking: { uniform: [0.4, 1] },
};

for (const dark of [false, true])
  testPlanner(
    `plans: axe has no findings, ${dark ? "dark" : "light"}`,
    { store: "thesis", prepare: smallShop(changing), dark, smoke: dark },
    async (tab, { axe }) => {
      const { page } = tab;
      const clean = async (when) => equal(await findings(tab, axe), [], when);
      await openPlans(tab);
      await page.evaluate(() => {
        for (const details of document.querySelectorAll("#panel-plans details")) details.open = true;
      });
      await clean("the question");
      await page.click('#panel-plans [value="at_most"]', { force: true });
      await clean("the question for at most K units");
      await page.click('#panel-plans [value="all"]', { force: true });
      await page.evaluate(() =>
        window.shelfbeamPlanner.planner.plans.start({ states: 20, confidence: 0.9, budget: 3 }, "a short plan"),
      );
      await wait(tab, () => window.shelfbeamPlanner.planner.plans.active?.progress);
      await clean("a plan runs");
      await wait(tab, hasEnded);
      await tab.until(() => document.querySelector('[data-key="state-next"]') !== null);
      await clean("the result");
      await page.click('[data-key="state-next"]');
      await tab.until(() => document.querySelector(".plan-result").innerText.includes("State 1 of"));
      await clean("a state");
      await tab.picture(`plans-${dark ? "dark" : "light"}`);
    },
  );
