// Tests the states of a shop that changes in the 3-D view.

import { check, equal, says } from "./check.mjs";
import { testReport } from "./report.mjs";

const statesOf = (page) => page.run(({ model }) => model.store.states);

/** Chooses an option of the shop as a reader does. */
const choose = async (page, option) => {
  await page.evaluate((k) => {
    const choice = document.querySelector("select[name=v3-shop]");
    choice.selectedIndex = k;
    choice.dispatchEvent(new Event("change"));
  }, option);
  await page.settle();
};

/** The number of pixels whose colour is that of people and objects, up to the brightness of a face. */
const peopleDrawn = (page) =>
  page.run(({ stage }) => {
    stage.measure(1);
    const gl = stage.canvas.getContext("webgl2");
    const { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
    const pixels = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    const hex = getComputedStyle(stage.canvas).getPropertyValue("--people").trim();
    const wanted = [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
    let count = 0;
    for (let at = 0; at < pixels.length; at += 4) {
      const tone = pixels[at] / wanted[0];
      if (tone > 0.6 && wanted.every((value, k) => Math.abs(pixels[at + k] - tone * value) < 3)) ++count;
    }
    return count;
  });

testReport("states of the shop are shown", { of: "changing" }, async (page, plan, { open, picture }) => {
  const { shown_states: expected } = plan.placement.states;
  const states = await statesOf(page);
  const { ids } = await page.run(({ model }) => model.store.labels);
  equal(
    states.map(({ number }) => number),
    expected.map(({ state }) => state),
    "numbers of the states",
  );
  equal(
    states.map(({ missed }) => missed.map((label) => ids[label])),
    expected.map(({ missed }) => missed),
    "missed labels",
  );
  const options = await page.texts("select[name=v3-shop] option");
  const [, some] = expected.map(({ state, missed }) => `state ${state}: ${missed.length} labels out of reach`);
  equal(options, ["as in the store file", `state ${expected[0].state}: all labels reached`, some], "options");
  equal(await peopleDrawn(page), 0, "people in the shop as in the file");

  await choose(page, 2);
  check((await peopleDrawn(page)) > 100, "no people are drawn");
  const { blocks, open: doors, missed } = states[1];
  check(blocks > 0 && doors.length > 0 && missed.length > 1, "the example is too small");
  const opened = `${doors.length} fixture${doors.length > 1 ? "s" : ""} with open doors`;
  says(
    await page.text(".v3-shop [role=status]"),
    `${blocks} people and objects; ${opened}; ${missed.length} labels out of reach.`,
  );
  says(await page.text(".v3-legend"), `out of reach in this state: ${missed.length}`, "people and objects");
  await picture(page, "state");
  await page.run((view, label) => view.model.select({ kind: "label", index: label }), missed[0]);
  equal(await page.text(".v3-card [data-fact=in-state]"), "out of reach", "in the card");
  const reached = ids.findIndex((_, k) => !missed.includes(k));
  await page.run((view, label) => view.model.select({ kind: "label", index: label }), reached);
  equal(await page.text(".v3-card [data-fact=in-state]"), "reached", "in the card");

  const again = await open(plan, { hash: await page.run((view) => view.link()), dark: true });
  equal(await again.run((view) => view.model.state.shop), 1, "state in the link");
  check((await peopleDrawn(again)) > 100, "no people are drawn in the dark");
  await picture(again, "state-dark");

  await page.run(({ model }) => model.switchUnit(model.store.units.selected[0], false));
  says(await page.text(".v3-shop [role=status]"), "Only the original plan was examined in this state.");
  check(!(await page.text(".v3-legend")).includes("out of reach"), "a changed plan has verdicts in a state");
  await page.run((view) => view.restore(null));
  equal(await page.evaluate(() => document.querySelector("select[name=v3-shop]").selectedIndex), 0, "after reset");
});

testReport("it fits 390 px in a state", { of: "changing", width: 390, height: 800 }, async (page, _, { picture }) => {
  await choose(page, 2);
  equal(await page.evaluate("document.documentElement.scrollWidth"), 390, "width");
  await picture(page, "state-narrow");
});

testReport("the state is chosen by keyboard", { of: "changing" }, async (page) => {
  await page.focus("select[name=v3-shop]");
  for (const state of [0, 1]) {
    await page.press("ArrowRight");
    equal(await page.run((view) => view.model.state.shop), state, "state");
  }
  equal(await page.evaluate(() => document.activeElement.name), "v3-shop", "focus");
});

testReport("a shop that does not change has no states", { of: "grocery" }, async (page) => {
  equal(await statesOf(page), [], "states");
  equal(await page.texts("select[name=v3-shop]"), [], "choices");
});
