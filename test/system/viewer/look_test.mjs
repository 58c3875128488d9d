// Tests layers, keyboard, narrow and dark screens, and browsers without scripts or WebGL.

import { check, equal, says } from "./check.mjs";
import { drawn, reached, testReport } from "./report.mjs";

testReport("levels are layers, each drawn at once", { of: "grocery" }, async (page, plan) => {
  const levels = await page.run((view) => view.model.store.levels.map(({ labels }) => labels));
  let before = await drawn(page);
  equal(Number(before.labels), plan.labels.length, "labels drawn");
  for (let level = levels.length; level >= 1; --level) {
    const box = (of) => document.querySelector(`[data-level="${of}"]`).closest("label").querySelector("input").click();
    await page.evaluate(box, level);
    await page.settle();
    const after = await drawn(page);
    equal(before.labels - after.labels, levels[level - 1], `labels of level ${level}`);
    equal(before.drawCalls - after.drawCalls, 1, `draw calls of level ${level}`);
    before = after;
  }
});

/** The name of the control with the focus. */
const focused = (page) =>
  page.evaluate(() => {
    const { tagName, name, type, dataset, textContent } = document.activeElement;
    if (tagName === "CANVAS") return "canvas";
    return name || (["search", "range", "number"].includes(type) ? type : (dataset.key ?? textContent));
  });

testReport("every control is reached by Tab", { of: "grocery" }, async (page) => {
  await page.evaluate(() => document.querySelector("#viewer").setAttribute("tabindex", "-1"));
  await page.focus("#viewer");
  const choices = ["v3-dimension", "v3-colour", "v3-lists"];
  const buttons = ["Whole store", "Reset", "Copy link", "only", "All levels"];
  const missing = new Set([...choices, ...buttons, "canvas", "search", "number", "range"]);
  for (let k = 0; k < 190 && missing.size; ++k) {
    await page.press("Tab");
    missing.delete(await focused(page));
  }
  equal([...missing], [], "controls that Tab does not reach");
});

testReport("everything can be done by keyboard", { of: "grocery" }, async (page, plan) => {
  const place = async () => JSON.stringify(await page.run((view) => view.stage.cameraPlace().at));
  await page.focus(".v3-canvas");
  const before = await place();
  await page.press("ArrowLeft");
  check((await place()) !== before, "the arrow key does not turn the store");
  // Select a label by search.
  await page.focus("input[value=units][type=radio]");
  await page.press("ArrowRight");
  const wanted = plan.labels[123].id;
  await page.focus(".v3-search:not([hidden]) input");
  await page.type(wanted);
  await page.press("Tab");
  for (let k = 0; k < 5 && !(await focused(page)).startsWith("label"); ++k) await page.press("Tab");
  await page.press("Enter");
  says(await page.text(".v3-card"), wanted);
  // Space switches a unit off; the focus stays.
  await page.focus("input[value=labels][type=radio]");
  await page.press("ArrowLeft");
  await page.focus(".v3-search li input");
  const box = await focused(page);
  await page.press(" ");
  equal(await focused(page), box, "focus");
  check((await reached(page)) < plan.labels.length, "Space does not switch the unit");
});

for (const dark of [false, true]) {
  const name = dark ? "dark" : "light";
  const narrow = { of: "certified", width: 360, height: 740, dark };
  testReport(`it fits 360 px, ${name}`, narrow, async (page, _, { picture }) => {
    const fits = async (what) => equal(await page.evaluate("document.documentElement.scrollWidth"), 360, what);
    await page.run((view) => view.model.select({ kind: "label", index: 5 }));
    await page.settle();
    await fits("width with a label");
    const wide = await page.evaluate(() => {
      const isWide = (e) => !e.closest(".scroll") && e.getBoundingClientRect().right > 360.5;
      return [...document.querySelectorAll("body *")].filter(isWide).map((e) => e.className || e.tagName);
    });
    equal(wide, [], "too wide");
    await picture(page, `narrow-${name}`);
    await page.run(({ model }) => model.select({ kind: "unit", index: model.store.units.selected[0] }));
    await fits("width with a unit");
  });
}

testReport("it follows dark and light", { of: "grocery", dark: true }, async (page, _, { picture }) => {
  const background = () =>
    page.run(({ stage }) => {
      stage.measure(1);
      const gl = stage.canvas.getContext("webgl2");
      const pixel = new Uint8Array(4);
      gl.readPixels(3, 3, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      return [...pixel];
    });
  const dark = await background();
  await picture(page, "dark");
  await page.darken(false);
  await page.settle();
  const light = await background();
  check(light[0] > 200 && dark[0] < 60, `background ${dark} and ${light}`);
});

function withoutWebgl() {
  const { getContext } = HTMLCanvasElement.prototype;
  HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
    return kind.startsWith("webgl") ? null : getContext.call(this, kind, ...more);
  };
}

for (const [name, told, lacking] of [
  ["scripts", "requires JavaScript", { javaScriptEnabled: false }],
  ["WebGL", "needs WebGL 2", { script: withoutWebgl }],
]) {
  const without = { of: "grocery", ready: false, ...lacking };
  testReport(`without ${name} the page says so, and the static report stands`, without, async (page) => {
    await page.evaluate("window.shelfbeamViewer?.then(() => true, () => true)");
    says(await page.text("#viewer-root"), told);
    check((await page.texts("#plans svg")).length > 3, "no plans");
    if (name === "scripts") return;
    check((await page.texts(".v3-list li")).length > 3, "no list of units");
    equal(page.errors, [], "errors");
  });
}

testReport("the picture comes back after a loss of WebGL", { of: "grocery" }, async (page) => {
  const change = (call, isAbsent) =>
    page.run(
      async ({ stage }, name, wanted) => {
        window.lost ??= stage.canvas.getContext("webgl2").getExtension("WEBGL_lose_context");
        window.lost[name]();
        while (document.querySelector(".v3-absent").hidden === wanted)
          await new Promise((done) => setTimeout(done, 20));
      },
      call,
      isAbsent,
    );
  const draw = () =>
    page.run(({ stage }) => {
      stage.drawCalls = 0;
      stage.draw();
      stage.drawPending();
      return stage.drawCalls;
    });
  const before = await draw();
  await change("loseContext", true);
  says(await page.text(".v3-absent"), "needs WebGL 2");
  equal(await draw(), 0, "draw calls without WebGL");
  await change("restoreContext", false);
  equal(await draw(), before, "draw calls");
});
