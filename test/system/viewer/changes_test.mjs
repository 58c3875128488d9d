// Tests the recount in the page when units are switched and thresholds edited, and the link to this state.

import { check, equal, near, says } from "./check.mjs";
import { columnsOf, metBy, received } from "./files.mjs";
import { factorOf, idsOf, pressButton, reached, testReport } from "./report.mjs";

for (const name of ["grocery", "spare-alone"])
  testReport(`switching units in ${name} recounts the labels`, { of: name }, async (page, plan, { picture }) => {
    const { units } = await idsOf(page);
    const on = new Set(columnsOf(plan, units));
    const recounted = async (what) => {
      const expected = metBy(plan, received(plan, on));
      equal(await reached(page), expected, what);
      return expected;
    };
    const [first] = on;
    await page.clickOn(`[data-key="on${first}"]`);
    on.delete(first);
    check((await recounted("one unit off")) < plan.labels.length, "the unit is not needed, so the test shows nothing");
    await picture(page, `off-${name}`);
    // The list begins with the units of the plan, which have numbers; a unit that is switched off has a dot.
    const added = await page.evaluate(() => {
      const rows = [...document.querySelectorAll(".v3-search li")];
      return Number(rows.find((row) => row.querySelector("span").textContent === "·").dataset.unit);
    });
    await page.clickOn(`[data-key="on${added}"]`);
    on.add(added);
    await recounted("another one on");
    says(await page.text(".v3-head"), `switched on: ${units[added]}; switched off: ${units[first]}`);
    // Select many candidates one by one with the keyboard.
    for (let unit = 0; unit < units.length; unit += 29) {
      if (!on.delete(unit)) on.add(unit);
      await page.run((view, unit, on) => view.model.switchUnit(unit, on), unit, on.has(unit));
      await recounted(`unit ${units[unit]}`);
    }
    await pressButton(page, "Reset");
    equal(await reached(page), plan.labels.length, "after reset");
    equal(await page.text(".v3-head .v3-note"), "This is the original plan.", "after reset");
  });

testReport("options of a mounting point exclude one another", { of: "options" }, async (page) => {
  const [mount, states] = await page.run(({ model }) => {
    const [units] = model.store.units.mounts;
    const afterSwitching = (unit) => {
      model.switchUnit(unit, true);
      return units.filter((other) => model.state.on[other]);
    };
    return [units, units.map(afterSwitching)];
  });
  const alone = mount.map((unit) => [unit]);
  equal(states, alone, "options that are on");
});

testReport("thresholds are edited, and the shares follow", { of: "grocery" }, async (page, plan, { picture }) => {
  const kinds = await page.run((view) => view.model.store.labels.kinds);
  const factor = await factorOf(page);
  for (const [kind, { type, requirement }] of kinds.entries()) {
    const wanted = Number(((2.2 * requirement) / factor).toPrecision(4));
    await page.evaluate((of) => document.querySelectorAll(".v3-need input[type=number]")[of].select(), kind);
    await page.type(String(wanted));
    await page.press("Enter");
    const labels = plan.labels.filter((label) => label.type === type);
    const met = labels.filter(({ signal }) => Number(signal) >= wanted * factor).length;
    const share = `${((100 * met) / labels.length).toFixed(1)}\u00a0%`;
    const shown = await page.text(`output[data-kind="${kind}"]`);
    check(shown.startsWith(share), `${type}: ${shown} instead of ${share}`);
    says(shown, `(${met} of ${labels.length})`);
  }
  says(await page.text(".v3-head"), "changed requirements");
  await picture(page, "thresholds");
  // Move the slider with the keyboard.
  await page.focus(".v3-need input[type=range]");
  const threshold = () => page.run((view) => view.model.state.requirements[0]);
  const before = await threshold();
  await page.press("ArrowRight");
  near(await threshold(), before * 10 ** 0.01, 0.012, "slider");
});

/** The state in the link, without the camera. */
const stateOf = (page) =>
  page.run((view) => [{ ...view.model.state, camera: null }, view.model.coverage.reached, view.link()]);

testReport("a link restores the view", { of: "grocery" }, async (page, plan, { open, picture }) => {
  await page.run(({ model, stage }) => {
    model.switchUnit(model.store.units.selected[1], false);
    model.switchUnit(17, true);
    model.state.requirements[0] *= 1.37;
    model.state.mode = "serving";
    model.state.levels[1] = false;
    model.state.selection = { kind: "label", index: 41 };
    stage.turn(3, 1);
    stage.zoom(1.7);
    model.recount();
  });
  await pressButton(page, "Copy link");
  const hash = await page.evaluate("location.hash");
  check(hash.startsWith("#view=1&") && hash.includes("need0"), hash);
  const again = await open(plan, { hash });
  equal(await stateOf(again), await stateOf(page), "state");
  for (const colour of ["signal", "margin"]) {
    const restored = await again.run((view, colour) => {
      view.restore(view.link().replace(/colour=[a-z]+/, `colour=${colour}`));
      return view.model.state.mode;
    }, colour);
    equal(restored, colour);
  }
  // The plan view has its own camera.
  await page.run((view) => {
    view.setPlan(true);
    view.stage.zoom(2);
    view.stage.shift(1, 1);
  });
  const flat = await open(plan, { hash: await page.run((view) => view.link()) });
  equal(await stateOf(flat), await stateOf(page), "state of the plan view");
  await picture(flat, "plan");
});

const odd = { of: "grocery", hash: "#view=1&on=99999,x&need0=-3&colour=red&camera=1,2&label=1e9&hide=77" };
testReport("invalid values in a link are ignored", odd, async (page, plan) => {
  equal(page.errors, [], "errors");
  equal(await reached(page), plan.labels.length, "reached labels");
});
