// Tests clicks on labels and transceivers in the picture.

import { check, equal, near, says } from "./check.mjs";
import { columnsOf } from "./files.mjs";
import { factorOf, idsOf, testReport } from "./report.mjs";

/** Skips some marks of labels or units, clicks the next one that is clickable, and returns its index. */
async function clickMark(page, kind, skip = 0) {
  await page.evaluate(() => document.querySelector(".v3-stage").scrollIntoView({ block: "center" }));
  await page.settle();
  const find = ({ model, picture, stage }, kind, skip) => {
    const box = stage.canvas.getBoundingClientRect();
    const marks = kind === "label" ? model.store.labels.ids.keys() : model.unitsOn();
    for (const index of marks) {
      const { x, y } = stage.project(picture.place(kind, index));
      if (x < 20 || y < 20 || x > box.width - 20 || y > box.height - 20) continue;
      const found = picture.named(stage.pick(x, y));
      if (found?.kind === kind && found.index === index && skip-- === 0)
        return { index, x: box.left + x, y: box.top + y };
    }
    return null;
  };
  const hit = await page.run(find, kind, skip);
  check(hit, `no ${kind} can be clicked`);
  await page.click(hit.x, hit.y);
  return hit.index;
}

testReport("a click on a label shows what its transceivers give it", { of: "grocery" }, async (page, plan, given) => {
  const { labels, units } = await idsOf(page);
  const label = await clickMark(page, "label", 12);
  says(await page.text(".v3-card"), labels[label]);
  const rows = await page.evaluate(() => {
    const numbers = (row) =>
      ["mean", "error", "direct"].map((fact) =>
        parseFloat(row.querySelector(`[data-fact=${fact}]`).textContent.replace(/[^\d.e-]/g, "")),
      );
    const rows = [...document.querySelectorAll(".v3-card tbody tr")];
    return rows.map((row) => [Number(row.dataset.unit), ...numbers(row)]);
  });
  const columns = columnsOf(plan, units);
  const shown = rows.map(([unit]) => unit).sort((a, b) => a - b);
  equal(shown, columns, "units");
  const factor = await factorOf(page);
  for (const [unit, mean, error, direct] of rows) {
    const place = label * units.length + unit;
    near(mean * factor, plan.mean.values[place], 0.006, "signal in the table");
    near(error * factor, plan.error.values[place], 0.06, "error in the table");
    const share = (100 * plan.direct.values[place]) / plan.mean.values[place];
    check(Math.abs(direct - share) < 0.6, "direct share");
  }
  const signals = rows.map(([, mean]) => mean);
  const sorted = [...signals].sort((a, b) => b - a);
  equal(signals, sorted, "order of signals");
  says(await page.text(".v3-card [data-fact=margin]"), "dB");
  const lines = await page.run((view) => {
    const { mesh } = view.stage.links;
    return mesh.visible && mesh.geometry.instanceCount;
  });
  equal(lines, columns.length, "lines");
  await given.picture(page, "label");
  await page.press("Escape");
  equal(await page.evaluate(() => document.querySelector(".v3-card").hidden), true, "card after Escape");
});

testReport("a click on a transceiver shows its reach", { of: "grocery" }, async (page, plan, { picture }) => {
  const { units } = await idsOf(page);
  const id = units[await clickMark(page, "unit")];
  equal(await page.text(".v3-card h3"), id, "selected unit");
  const row = plan.chosen.find((unit) => unit.id === id);
  const fact = async (name) => Number.parseInt(await page.text(`.v3-card [data-fact=${name}]`), 10);
  equal(await fact("alone"), Number(row.reaches_alone), "labels reached alone");
  equal(await fact("decides"), Number(row.needed_by), "labels lost");
  says(await page.text(".v3-legend"), `reached alone: ${row.reaches_alone}`);
  await picture(page, "unit");
});
