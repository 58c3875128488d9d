// Tests what other people's browsers must do, too: open a shop, draw, import and plan. Chromium without WebGL and Firefox
// run these tests alone.

import { check, equal, says } from "../viewer/check.mjs";
import { drop } from "./floor_plan.mjs";
import { testPlanner } from "./opened.mjs";
import { smallShop } from "./shops.mjs";

const opened = { store: "thesis", prepare: smallShop(), light: true };

/** How many pixels of the marks have a colour, in the plan without WebGL. */
const drawnPixels = (tab) =>
  tab.evaluate(() => {
    const canvas = document.querySelector("canvas.marks + canvas:not([hidden])");
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return data.reduce((sum, value, k) => sum + (k % 4 === 3 && value > 200 ? 1 : 0), 0);
  });

testPlanner("elsewhere: a shop is opened, drawn, imported and planned", opened, async (tab, { tools }) => {
  const hasPicture = await tab.state(({ page }) => page.stage.hasPicture);
  const show = async (kind, isShown) => {
    await tab.state(({ planner }, ...of) => planner.layers.show(...of), kind, isShown);
    await tab.settle();
  };
  if (tools.kind === "nowebgl") equal(hasPicture, false, "WebGL, which this suite must not have");
  await tab.press("w");
  await tab.click(1, 4.5);
  await tab.click(3, 4.5);
  await tab.press("Enter");
  await tab.steps(1);
  await tab.press("Escape", "Escape");
  equal(tab.json.room.inner_walls.length, 1);

  const labels = ["id,x,y,z,nx,ny,nz,type", "P1,3,0.01,1.5,0,1,0,standard", "P2,4,0.01,1.5,0,1,0,standard"];
  await drop(tab, "posters.csv", Buffer.from(labels.join("\n")));
  await tab.use("add-list");
  await tab.steps(2);
  equal(tab.json.labels, { csv: "posters.csv" });

  await tab.page.click("#tab-plans");
  await tab.page.click("#panel-plans .primary");
  await tab.computes(({ planner }) => planner.plans.runs[0]?.entered);
  await tab.until(() => document.querySelector(".plan-result .files a") !== null);
  await tab.steps(3);
  check(tab.json.transceivers.selected.length > 0, "no unit is selected");
  await tab.lit();

  await tab.settle();
  if (!hasPicture) {
    const all = await drawnPixels(tab);
    await show("label", false);
    const units = await drawnPixels(tab);
    await show("unit", false);
    check(all > units && units > 0, `${all} pixels of labels and units, ${units} of units`);
    equal(await drawnPixels(tab), 0, "negative control: pixels without marks");
    for (const kind of ["label", "unit"]) await show(kind, true);
  }
  await tab.press("d");
  await tab.settle();
  const said = await tab.text(".plan > .absent");
  if (hasPicture) equal(said, "");
  else says(said, "WebGL");
  await tab.press("d");
  equal(await tab.text(".plan > .absent"), "");
});
