// Tests the numbers that the 3-D view has read from the page and counted, for up to 40,000 labels.

import { statSync } from "node:fs";
import { join } from "node:path";

import { check, equal, fails, near, test } from "./check.mjs";
import { drawn, reached, testReport, urlOf } from "./report.mjs";

testReport("a report is one file that asks for nothing", { of: "grocery" }, async (page, plan, { picture }) => {
  check(statSync(join(plan.folder, "report.html")).size < 10e6, "it is larger");
  const asksForNothing = () => equal(page.requests, [urlOf(plan)], "requests");
  asksForNothing();
  equal(page.errors, [], "errors");
  await picture(page, "grocery");
  await page.evaluate("fetch('http://127.0.0.1:9/x').catch(() => 0)");
  fails(asksForNothing, "a request");
});

/** The counts of labels and units in the 3-D view. */
const coverageOf = (page) =>
  page.run(({ model: { coverage, store } }) => {
    const labels = [...store.labels.ids.keys()];
    return {
      labels: store.labels.ids,
      signal: [...coverage.signal],
      need: labels.map((label) => coverage.requirement(label)),
      margin: labels.map((label) => coverage.margin(label)),
      serving: [...coverage.serving],
      chosen: store.units.selected.map((unit) => ({
        id: store.units.ids[unit],
        reach: coverage.reach[unit],
        decides: coverage.decides[unit],
      })),
    };
  });

/** Compares the counts with the files of the plan. */
function coverageIs(shown, { labels, chosen, placement }) {
  const idsIn = (rows) => rows.map(({ id }) => id);
  equal(shown.labels, idsIn(labels), "ids of labels");
  labels.forEach((row, label) => {
    near(shown.signal[label], Number(row.signal), 1e-8, `signal of ${row.id}`);
    near(shown.need[label], Number(row.requirement), 1e-8, `requirement of ${row.id}`);
    check(Math.abs(shown.margin[label] - Number(row.margin_db)) < 1e-6, `margin of ${row.id}`);
    equal(shown.serving[label], row.serving.split(";").filter(Boolean).length, `serving units of ${row.id}`);
  });
  equal(idsIn(shown.chosen), idsIn(chosen), "chosen units");
  if (placement) equal(idsIn(chosen).sort(), [...placement.selected].sort(), "selected units");
  chosen.forEach((row, k) => {
    const { reach, decides } = shown.chosen[k];
    equal(reach, Number(row.reaches_alone), `labels that ${row.id} reaches alone`);
    if (placement?.survives_failure) return;
    equal(decides, Number(row.needed_by), `labels that need ${row.id}`);
    const critical = placement?.critical.find(({ unit }) => unit === row.id);
    if (placement) equal(decides, critical.count, `critical count of ${row.id}`);
  });
}

/** Every entry of signal.h5, by label. */
const entriesOf = (page) =>
  page.run(({ model: { signals, store } }) => ({
    units: store.units.ids,
    begin: [...signals.begin],
    column: [...signals.column],
    mean: [...signals.mean],
    error: [...signals.error],
    direct: [...signals.directShare],
  }));

function entriesAre(shown, { labels, mean, error, direct }, rounding) {
  let entries = 0;
  labels.forEach(({ id }, label) => {
    for (let at = shown.begin[label]; at < shown.begin[label + 1]; ++at, ++entries) {
      const place = label * shown.units.length + shown.column[at];
      const signal = mean.values[place];
      check(shown.mean[at] === signal, `mean of ${id}`);
      near(shown.error[at], error.values[place], 1.1 * rounding, `standard error of ${id}`);
      // Noise of weak entries may move the share outside of 0 to 1.
      const share = Math.min(Math.max(direct.values[place] / signal, 0), 1);
      check(Math.abs(shown.direct[at] - share) < 0.6 / 65535, `direct share of ${id}`);
    }
  });
  equal(entries, mean.values.filter((signal) => signal > 0).length, "entries");
}

for (const name of ["grocery", "spare-alone", "options"])
  testReport(`numbers of ${name} are those of the files`, { of: name }, async (page, plan) => {
    equal(await reached(page), plan.labels.length, "reached labels");
    coverageIs(await coverageOf(page), plan);
    const rounding = Number(/rounded by up to ([\d.]+)/.exec(await page.text("#viewer > .note"))[1]) / 100;
    entriesAre(await entriesOf(page), plan, rounding);
  });

test("40,000 labels", async ({ makeLarge, open, picture }) => {
  const plan = makeLarge();
  equal(plan.made.labels, 40000, "labels");
  const page = await open(plan);
  equal(page.errors, [], "errors");
  equal(await reached(page), plan.made.reached, "reached labels");
  coverageIs(await coverageOf(page), plan);
  const told = await page.text("#viewer > .note");
  const rounding =
    "are rounded to N % of a label's requirement(, and the N smallest of N are omitted)?: " +
    "each switched unit causes an error of at most N % ";
  const pattern = new RegExp(rounding.replaceAll("N", "[\\d,.]+").replaceAll(" %", "\u00a0%"));
  check(pattern.test(told), `the rounding is not described: ${told}`);
  const signals = await page.evaluate("document.querySelector('#viewer-signals').textContent.length");
  check(signals <= 20e6, "signals exceed 20 MB");
  equal((await drawn(page)).labels, "40000", "labels drawn");
  await picture(page, "large");
  await page.run((view) => {
    view.setPlan(true);
    view.model.state.levels = view.model.state.levels.map((_, level) => level === 0);
    view.model.changed();
  });
  await page.settle();
  await picture(page, "large-plan");
});
