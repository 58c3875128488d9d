// Tests what is shown: zoom, pan, fit, layers, measurement, 3-D, and pictures of all examples.

import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { check, equal, near, says } from "../viewer/check.mjs";
import { testPlanner } from "./opened.mjs";

testPlanner("the wheel zooms at the pointer, within limits", {}, async (tab) => {
  const at = await tab.at(20, 5);
  const before = await tab.view();
  await tab.wheel(20, 5, -300);
  check((await tab.view()).scale > 1.5 * before.scale, "larger");
  const now = await tab.at(20, 5);
  check(Math.hypot(now[0] - at[0], now[1] - at[1]) <= 1, "the place under the pointer stays");
  await tab.wheel(20, 5, -1000, 40);
  equal((await tab.view()).scale, 6000, "1 cm is 60 pixels at most");
  await tab.press("0");
  near((await tab.view()).scale, before.scale, 1e-9, "scale after 0");
  await tab.click(10, 9.85);
  await tab.press("Shift+2");
  const { centre } = await tab.view();
  equal(
    centre.map((value) => Number(value.toFixed(3))),
    [11, 9.85],
    "middle of the selection",
  );
});

testPlanner("middle and right drags move the plan, Space also without a button, and in a drag", {}, async (tab) => {
  const moves = async (what, run) => {
    const before = (await tab.view()).centre;
    await run();
    const after = (await tab.view()).centre;
    check(
      Math.abs(before[0] - 2 - after[0]) < 0.06 && Math.abs(before[1] - 1 - after[1]) < 0.06,
      `${what}: ${before} ${after}`,
    );
  };
  for (const button of ["middle", "right"]) {
    await moves(button, () => tab.drag([10, 2], [12, 3], { button }));
    check(!(await tab.has(".menu")), "no menu");
  }
  await tab.point(10, 2);
  await moves("Space", () => tab.point(12, 3, "Space"));
  check(await tab.isUntouched(), "the store is untouched");
  await tab.press("0");
  const before = (await tab.view()).centre;
  await tab.drag([10, 9.85], [11, 9.85], {
    during: async () => {
      const [x, y] = await tab.at(11, 9.85);
      await tab.holding(["Space"], () => tab.page.mouse.move(x + 60, y, { steps: 3 }));
      await tab.page.mouse.move(x + 61, y);
      await tab.settle();
    },
  });
  await tab.steps(1);
  check((await tab.view()).centre[0] < before[0] - 1, "the plan has moved");
  const { at } = tab.json.fixtures[2];
  check(Math.abs(at[0] - 6) < 0.1, `the fixture stays under the pointer: ${at}`);
});

testPlanner("layers hide kinds and levels", {}, async (tab) => {
  await tab.push("#tab-layers");
  const shows = (kind) =>
    tab.evaluate((of) => getComputedStyle(document.querySelector(`.kind-${of}`)).display !== "none", kind);
  const levels = () => tab.count("[data-key^='level-'][aria-pressed='true']");
  check(await shows("fixture"), "shown");
  await tab.use("show-fixture");
  check(!(await shows("fixture")), "hidden");
  const before = await levels();
  await tab.use("level-3");
  equal(await levels(), before - 1);
  await tab.reload();
  check(!(await shows("fixture")), "hidden after a reload");
});

testPlanner("measurements hold on to edges, and stay until Esc", {}, async (tab) => {
  const count = () => tab.count(".overlay .measure");
  await tab.press("m");
  await tab.point(5.05, 4.65);
  says(await tab.text(".overlay .word"), "corner");
  await tab.holding(["Alt"], async () => {
    await tab.point(5.1, 4.65);
    check(!(await tab.has(".overlay .word")), "Alt holds on to nothing");
  });
  // The aisle between A1 and A2: from the back of one to the front of the other.
  await tab.click(10, 5.55);
  await tab.click(10, 6.95);
  says(await tab.text(".overlay .reading"), "1.50 m");
  await tab.click(2.5, 2);
  for (const button of ["middle", "right"]) {
    await tab.drag([10, 8], [10.5, 8.5], { button });
    await tab.drag([10, 8], [9.5, 7.5], { button });
  }
  await tab.point(5, 2.1);
  equal(await count(), 2);
  await tab.press("Escape");
  equal(await count(), 1, "the gesture first");
  await tab.press("Escape");
  equal(await count(), 0, "then the tool");
  equal(await tab.tool(), "select");
});

/** Puts a label far above the shelves. */
function withHighLabel(folder) {
  const file = join(folder, "store.json");
  const label = { id: "high", position: [12, 1.5, 30], normal: [0, -1, 0], type: "standard" };
  const text = readFileSync(file, "utf8").replace("{", `{ "labels": [${JSON.stringify(label)}],`);
  writeFileSync(file, text);
}

testPlanner("marks high above the floor are in the plan", { prepare: withHighLabel }, async (tab) => {
  await tab.reaches(({ planner }) => planner.document.labels.withPath("/labels/0") !== undefined);
  await tab.settle();
  const picked = await tab.state(({ planner, page }) => page.stage.pick(...planner.viewport.toScreen([12, 1.5])));
  check(picked !== 0, "the mark is drawn");
});

testPlanner("D shows the same selection in 3-D, where clicks select, too", {}, async (tab) => {
  await tab.click(10, 9.85);
  await tab.press("d");
  await tab.until(() => document.querySelector(".plan").classList.contains("space"));
  equal(await tab.selected(), ["/fixtures/2"]);
  await tab.hasSpace();
  // From near, the top of the shelving is wider than the reach of its labels.
  await tab.press("+", "+", "+");
  const place = await tab.state(({ page: { stage } }) => {
    const box = stage.canvas.getBoundingClientRect();
    const { x, y } = stage.project([11, 5.05, 2]);
    return [box.left + x, box.top + y];
  });
  await tab.page.mouse.click(...place);
  await tab.settle();
  equal(await tab.selected(), ["/fixtures/0"]);
  await tab.press("Shift+ArrowUp");
  await tab.steps(1);
  await tab.picture("grocery-space");
  await tab.press("d");
  equal(await tab.selected(), ["/fixtures/0"]);
});

testPlanner("fingers move the plan, and never change the store", { hasTouch: true }, async (tab) => {
  const session = await tab.page.context().newCDPSession(tab.page);
  const touch = (type, ...points) =>
    session.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  const slide = async (ways, fingersAt) => {
    await touch("touchStart", ...fingersAt(0));
    for (const way of ways) await touch("touchMove", ...fingersAt(way));
    await touch("touchEnd");
    await tab.settle();
    return tab.view();
  };
  const [x, y] = await tab.at(10, 9.85);
  const before = await tab.view();
  const panned = await slide([10, 20, 40, 60], (way) => [[x + way, y]]);
  check(panned.centre[0] < before.centre[0] - 1, "panned");
  const pinched = await slide([10, 30, 60], (way) => [600 - way, 660 + way].map((place) => [place, 300]));
  check(pinched.scale > 2 * panned.scale, "pinched");
  await tab.press("0");
  await tab.page.touchscreen.tap(...(await tab.at(10, 9.85)));
  await tab.settle();
  equal(await tab.selected(), ["/fixtures/2"], "tapped");
  check(await tab.isUntouched(), "the store is untouched");
});

for (const store of ["thesis", "grocery", "chiller", "market-hall", "supermarket", "hypermarket"])
  for (const [width, height, dark] of [
    [1280, 720, false],
    [1920, 1080, true],
  ])
    testPlanner(`a picture of ${store} at ${width} x ${height}`, { store, width, height, dark }, async (tab) => {
      const corners = await tab.state(({ planner: { viewport, wholeBounds } }) =>
        [wholeBounds.lower, wholeBounds.upper].map((corner) => viewport.toScreen(corner)),
      );
      const fits = corners.every(([x, y]) => x > 0 && y > 0 && x < width && y < height);
      check(fits, `everything is shown at first: ${corners}`);
      await tab.picture(`${store}-${width}`);
    });

testPlanner("view: the plan outlives the loss of WebGL", { smoke: true }, async (tab) => {
  // The page keeps what it showed before. The result: the pixels of marks, and those that differ.
  const compare = (selector) =>
    tab.state(({ page: { stage } }, of) => {
      const canvas = document.querySelector(of);
      const copy = document.createElement("canvas");
      [copy.width, copy.height] = [canvas.width, canvas.height];
      stage.draw();
      stage.drawPending();
      const context = copy.getContext("2d");
      context.drawImage(canvas, 0, 0);
      const alphas = context.getImageData(0, 0, copy.width, copy.height).data.filter((_, k) => k % 4 === 3);
      window.alphasBefore ??= alphas;
      const differ = alphas.filter((alpha, k) => alpha > 128 !== window.alphasBefore[k] > 128).length;
      return { drawn: alphas.filter((alpha) => alpha > 128).length, differ };
    }, selector);
  const { drawn } = await compare("canvas.marks");
  check(drawn > 1000, `${drawn} pixels`);
  await tab.evaluate(() => {
    window.gl = document.querySelector("canvas.marks").getContext("webgl2").getExtension("WEBGL_lose_context");
    window.gl.loseContext();
  });
  await tab.until(() => document.querySelector("canvas.marks + canvas:not([hidden])") !== null);
  const flat = await compare("canvas.marks + canvas");
  check(flat.differ < 0.3 * drawn, `${flat.differ} of ${drawn} pixels differ`);
  await tab.press("d");
  says(await tab.text(".plan > .absent"), "WebGL");
  await tab.press("d");
  await tab.drag([10, 9.85], [11, 9.85]);
  await tab.steps(1);
  check((await compare("canvas.marks + canvas")).differ > flat.differ, "negative control: marks that have moved");
  await tab.evaluate("window.gl.restoreContext()");
  await tab.until(() => document.querySelector("canvas.marks + canvas:not([hidden])") === null);
  await tab.press("Control+z", "Escape");
  await tab.steps(0);
  equal(await compare("canvas.marks"), { drawn, differ: 0 }, "marks after WebGL has come back");
});
