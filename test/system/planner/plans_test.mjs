// Tests plans of the planner: from the question to the report, which is that of `shelfbeam plan`.

import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";

import { check, equal, says } from "../viewer/check.mjs";
import { testAxe, testPlanner } from "./opened.mjs";
import { smallShop } from "./shops.mjs";

const inSmallShop = { store: "thesis", prepare: smallShop() };
const hasEnded = ({ planner: { plans } }) =>
  plans.runs.length > 0 && plans.runs.every(({ state }) => ["done", "stopped", "failed"].includes(state));
const isEntered = ({ planner }) => planner.plans.runs[0].entered;
const start = (tab, options) => tab.state(({ planner }, given) => planner.plans.start(given, "a plan"), options);

testPlanner(
  "plans: units are planned, selected and handed over",
  { ...inSmallShop, smoke: true },
  async (tab, given) => {
    const { folder } = tab.server;
    await tab.push("#tab-plans");
    await tab.push("#panel-plans .primary");
    await tab.computes(({ planner }) => planner.plans.active?.first);
    await tab.until(() =>
      document.querySelector(".plan-running .since").innerText.startsWith("First answer, from a preview:"),
    );
    await tab.computes(hasEnded);
    const placement = JSON.parse(readFileSync(join(folder, "plan", "placement.json"), "utf8"));
    await tab.reaches(isEntered);
    equal(tab.json.transceivers.selected, placement.selected);
    says(await tab.text(".plan-result .answer"), "with 99 % confidence");
    await tab.until(() => document.querySelector(".plan-result dl")?.innerText.includes("One unit fewer?"));
    await tab.use("enter-one_more");
    await tab.steps(2);
    equal(tab.json.transceivers.selected, placement.alternatives.one_more.selected);
    // The same command on the shop as it was writes the same files.
    await tab.press("Control+z", "Control+z");
    await tab.steps(0);
    check(await tab.isUntouched(), "the shop is as it was");
    const again = join(folder, "again");
    await given.run("plan", join(folder, "store.json"), "-o", again, "--quiet");
    for (const file of ["report.html", "placement.json", "mounting.csv", "mounting.dxf", "labels.csv", "signal.h5"])
      check(readFileSync(join(again, file)).equals(readFileSync(join(folder, "plan", file))), `${file} differs`);
    // The links give these files, and the report runs on its own.
    const links = await tab.page.$$eval(".plan-result .files a", (list) => list.map(({ href }) => href));
    equal(links.length, 6);
    const report = await tab.page.context().newPage();
    const errors = [];
    report.on("pageerror", (error) => errors.push(error.message));
    report.on("console", (message) => message.type() === "error" && errors.push(message.text()));
    await report.goto(links[0]);
    await report.waitForSelector("h1");
    equal(errors, []);
    await report.close();
    // Plans of the command line are in the list, and two plans can be compared.
    await tab.reaches(({ planner }) => planner.plans.runs.length === 2);
    for (const row of [0, 1]) await tab.page.locator(".plan-list input").nth(row).click();
    await tab.page.click("text=Compare the two");
    await tab.page.waitForSelector("dialog >> text=The plans are the same.");
    await tab.press("Escape");
    // The archive has the shop and both plans, and leaves nothing behind.
    const downloaded = tab.page.waitForEvent("download");
    await tab.page.click("text=Save the project as a zip file");
    const archive = await (await downloaded).path();
    const list = spawnSync("python3", ["-m", "zipfile", "--list", archive], { encoding: "utf8" }).stdout;
    for (const file of ["store.json", "plan/report.html", "plan/signal.h5", "again/placement.json"])
      check(list.includes(`/${file} `), `${file} is not in the archive:\n${list}`);
    check(!list.includes(".shelfbeam"), "the archive has hidden files");
  },
);

testPlanner("plans: a plan that is cancelled keeps its best units", inSmallShop, async (tab) => {
  await tab.push("#tab-plans");
  await start(tab, { simulation: { samples: 10_000_000 } });
  await tab.computes(({ planner }) => {
    const { state, progress } = planner.plans.active ?? {};
    return state === "running" && progress?.task === "simulating" && progress.share > 0.02;
  });
  await tab.page.click("text=End, and keep the best");
  await tab.computes(hasEnded);
  await tab.until(() => document.querySelector(".plan-result").innerText.includes("ended early"));
  await tab.reaches(isEntered);
});

testPlanner("plans: a shop that cannot be planned says why", { store: null, keeps: true }, async (tab) => {
  await tab.push("#tab-plans");
  await tab.until(() => document.querySelector("#panel-plans").innerText.includes("Give fixtures labels first."));
  check(await tab.has("#panel-plans .primary:disabled"), "it cannot be pushed");
});

const changing = {
  people: [{ area: "room", number: { uniform: [2, 3] }, size: [0.5, 0.3, 1.75], material: "paper" }],
  stocking: { uniform: [0.4, 1] },
};

testAxe("plans", { store: "thesis", prepare: smallShop(changing), smoke: "dark" }, async (tab, clean, colours) => {
  const goal = (value) => tab.page.click(`#panel-plans [value="${value}"]`, { force: true });
  await tab.push("#tab-plans");
  await tab.evaluate(() => {
    for (const details of document.querySelectorAll("#panel-plans details")) details.open = true;
  });
  await clean("the question");
  await goal("at_most");
  await clean("the question for at most K units");
  await goal("all");
  await start(tab, { states: 20, confidence: 0.9, budget: 3 });
  await tab.computes(({ planner }) => planner.plans.active?.progress);
  await clean("a plan runs");
  await tab.computes(hasEnded);
  await tab.until(() => document.querySelector('[data-key="state-next"]') !== null);
  await clean("the result");
  await tab.use("state-next");
  await tab.until(() => document.querySelector(".plan-result").innerText.includes("State 1 of"));
  await clean("a state");
  await tab.picture(`plans-${colours}`);
});
