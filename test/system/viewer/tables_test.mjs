// Tests the result, the tables and the facts of the page without its 3-D view.

import { check, equal, fails, says } from "./check.mjs";
import { metBy, verdictOf } from "./files.mjs";
import { factorOf, testReport } from "./report.mjs";

const tablesOf = (page) =>
  page.evaluate(() => {
    const words = (of) => of.textContent.replace(/\u00a0/g, " ");
    const all = (selector, of = document) => [...of.querySelectorAll(selector)];
    const table = (id) => all(`#${id} tbody tr`).map((row) => [...row.cells].map(words));
    const list = (of) => Object.fromEntries(all("dt", of).map((dt) => [words(dt), words(dt.nextElementSibling)]));
    const facts = all("#facts .facts > div").map((part) => [words(part.querySelector("h3")), list(part)]);
    return {
      summary: words(document.querySelector(".first-page")),
      answer: words(document.querySelector("#facts")),
      units: table("units"),
      weakest: table("weakest"),
      sensitivity: table("sensitivity"),
      curve: table("curve"),
      facts: Object.fromEntries(facts),
    };
  });

/** Half a unit of the last displayed digit: "12.50" stands for 12.495 to 12.505. */
function shows(cell, value, what) {
  const digits = cell.replace(/[,+]/g, "").replace("−", "-").replace(/ .*/, "");
  const half = 0.5001 * 10 ** -(digits.split(".")[1] ?? "").length;
  check(digits !== "" && Math.abs(digits - value) <= half, `${what}: the page has '${cell}', the files ${value}`);
}

/** Compares cells, in order or by name, with the files; numbers to the last displayed digit. */
function cellsAre(cells, expected, what) {
  for (const [name, value] of Object.entries(expected))
    if (typeof value === "function") check(value(cells[name]), `${what}, ${name}: ${cells[name]}`);
    else if (typeof value === "number") shows(cells[name], value, `${what}, ${name}`);
    else equal(cells[name], value, `${what}, ${name}`);
}

/** Whether a name is that of a label without an article: its place, and the distance along the edge. */
const namesPlace =
  ({ fixture, face, board }) =>
  (name) =>
    new RegExp(
      `^${fixture}( ${face}( end)?)?(, board ${board}, at [0-9.]+ m| at [-0-9.]+, [-0-9.]+ m, .+ m high)$`,
    ).test(name);

const place = ({ x, y, z }) => [x, y, z].map(Number);

/** Expects that the page has the numbers of none of these changed plans. */
function noneIs(compare, found, plan, changes) {
  for (const change of changes)
    fails(() => compare(found, { ...plan, placement: { ...plan.placement, ...change } }), JSON.stringify(change));
}

function answerIs({ summary, facts, factor, units, weakest }, plan) {
  const { placement, chosen, labels } = plan;
  const { certificate, count, solver } = placement;
  const needed = Math.ceil(placement.count_lower_bound - 1e-6);
  const byMargin = [...labels].sort((a, b) => a.margin_db - b.margin_db);
  const signals = labels.map(({ signal }) => Number(signal));
  const reached = certificate?.reached ?? metBy(plan, signals);
  const share = reached === labels.length ? `all ${reached}` : `${reached} of ${labels.length}`;
  const receive = certificate && reached < labels.length ? "are confirmed to receive" : "receive";
  const isAssumed = placement.values.some(({ value, state }) => value === "threshold" && state === "assumed");
  says(
    summary,
    `Mount ${count} new transceivers: ${share} labels ${receive} enough signal`,
    isAssumed
      ? "because a threshold is assumed"
      : `The weakest label, ${weakest[0][0]}, receives ${(10 ** (byMargin[0].margin_db / 10)).toPrecision(3)} times`,
  );
  equal(units.length, chosen.length, "rows of units");
  chosen.forEach((row, k) => {
    const counts = [row.reaches_alone, row.strongest_for, row.needed_by];
    cellsAre(units[k], [String(k + 1), row.id, row.place, ...place(row), ...counts], row.id);
  });
  equal(weakest.length, 20, "labels with the smallest margin");
  weakest.forEach((cells, k) => {
    const row = labels.find(({ id }) => id === cells[10]);
    const [margin, signal, needs] = [row.margin_db, row.signal / factor, row.requirement / factor];
    const verdict = certificate && verdictOf(certificate, row.id);
    shows(cells[1], Number(byMargin[k].margin_db), `margin ${k}`);
    equal(cells[4].replace(/^[0-9]+: /, ""), row.strongest, `strongest for ${row.id}`);
    cellsAre(
      cells,
      [namesPlace(row), Number(margin), signal, needs, , , ...place(row), row.type, row.id, verdict],
      row.id,
    );
  });
  const { Placement: found, "Certificate from independent samples": fresh } = facts;
  const gap = (100 * (count - needed)) / count;
  const expected = { Transceivers: count, "Lower bound on the count": needed, "Gap of the count": gap, Solver: solver };
  cellsAre(found, expected, "facts");
  const [, redundant] = /\(([\d.]+)/.exec(found["Labels that at least two units each reach alone (redundant)"]);
  shows(redundant, 100 * placement.redundant_share, "redundant share");
  equal(fresh === undefined, certificate === undefined, "certificate");
}

function certificateIs({ answer, facts: { "Certificate from independent samples": fresh } }, { placement, labels }) {
  const { confidence, reached, missed, undecided, count_lower_bound, open, ...of } = placement.certificate;
  equal(open.code, "interrupted", "reason");
  const ended = "it was interrupted";
  const expected = {
    ...{ "Joint confidence": 100 * confidence, "Labels reached": reached, Rounds: of.rounds },
    ...{ "Lower bound on the count": count_lower_bound, "Proven from": of.bound_labels },
    "Verification ended because": ended,
  };
  cellsAre(fresh, expected, "certificate");
  for (const [name, ids] of Object.entries({ Missed: missed, Undecided: undecided })) {
    const [count, parts] = fresh[name].split(": ");
    shows(count, ids.length, name);
    // More than four labels are counted by fixture.
    for (const part of parts.replace(" and others", "").split(ids.length > 4 ? ", " : "; ")) {
      const [, number, fixture] = /^(\d+) on (.+)$/.exec(part) ?? [];
      if (number)
        equal(labels.filter((row) => row.fixture === fixture && ids.includes(row.id)).length, Number(number), part);
      else check(ids.includes(part), part);
    }
  }
  says(
    answer,
    `${placement.count} transceivers reach ${reached} of ${labels.length} labels`,
    `at least ${count_lower_bound} `,
    `with ${100 * confidence} % confidence`,
    `${missed.length} labels are missed`,
    `${undecided.length} labels are undecided`,
    `Verification ended because ${ended}.`,
  );
}

for (const name of ["grocery", "certified"])
  testReport(`numbers of the page of ${name} are those of the files`, { of: name }, async (page, plan) => {
    const found = { ...(await tablesOf(page)), factor: await factorOf(page) };
    const { count, redundant_share, certificate } = plan.placement;
    answerIs(found, plan);
    noneIs(answerIs, found, plan, [{ count: count + 1 }, { redundant_share: redundant_share + 0.01 }]);
    if (!certificate) return;
    certificateIs(found, plan);
    const keys = ["confidence", "reached", "count_lower_bound", "bound_labels", "rounds"];
    const changed = keys.map((key) => ({ ...certificate, [key]: 1.5 * certificate[key] }));
    noneIs(
      certificateIs,
      found,
      plan,
      changed.map((other) => ({ certificate: other })),
    );
  });

const decibelsOf = (ratio) => 10 * Math.log10(ratio);

function sectionsAre({ answer, sensitivity, curve }, { placement, labels }) {
  const of = placement.sensitivity;
  const named = (label) => namesPlace(labels.find(({ id }) => id === label));
  equal(sensitivity.length, of.materials.length, "materials");
  of.materials.forEach(({ name, reflectance, range: [least, most], assumed, low, high }, k) => {
    const cells = sensitivity[k];
    const ofLow = [named(low.label), low.label, 100 * low.change, String(low.labels_short), 100 * low.mean_change];
    const ofHigh = [decibelsOf(high.smallest_margin), 100 * high.mean_change];
    cellsAre(cells, [name, , decibelsOf(low.smallest_margin), ...ofLow, ...ofHigh], name);
    shows(/± ([\d.]+)\)/.exec(cells[5])[1], 100 * low.change_standard_error, `error with ${name}`);
    const [, ...given] = /^([\d.]+) \(([\d.]+) to ([\d.]+)\)( \*)?$/.exec(cells[1]);
    for (const [at, value] of [reflectance, least, most].entries())
      check(Math.abs(Number(given[at]) - value) <= 0.00051, `${name}: '${given[at]}' of ${value}`);
    equal(given[3] !== undefined, assumed, "assumed");
  });
  const { missed, undecided, smallest_margin } = of.low;
  const met = labels.length - missed.length - undecided.length;
  says(
    answer,
    `${met} of ${labels.length} labels are reached with all reflectances at the low end`,
    `${missed.length} missed, ${undecided.length} undecided), with ${100 * of.confidence} % confidence`,
    `${smallest_margin} to ${of.high.smallest_margin.toPrecision(3)} times the requirement`,
    `'${of.materials[0].name}'`,
  );
  equal(curve.length, placement.curve.length, "points of the curve");
  placement.curve.forEach(({ units, at_least, at_most }, k) => {
    const tenths = (met, round) => round((1000 * met) / labels.length) / 10; // to the safe side
    const ends = [tenths(at_least, Math.floor), String(at_least), tenths(at_most, Math.ceil), String(at_most)];
    cellsAre(curve[k], [String(units), ...ends], "point of the curve");
  });
}

testReport("numbers on materials and fewer units are those of the files", { of: "certified" }, async (page, plan) => {
  const found = await tablesOf(page);
  sectionsAre(found, plan);
  const { sensitivity, curve } = plan.placement;
  const [first, ...rest] = sensitivity.materials;
  const ofFirst = [
    { reflectance: 0.6 },
    { low: { ...first.low, change: -0.43 } },
    { low: { ...first.low, smallest_margin: 0.72 } },
    { high: { ...first.high, mean_change: 0.24 } },
  ];
  noneIs(sectionsAre, found, plan, [
    ...ofFirst.map((change) => ({ sensitivity: { ...sensitivity, materials: [{ ...first, ...change }, ...rest] } })),
    { sensitivity: { ...sensitivity, confidence: 0.99 } },
    { curve: curve.map((point) => ({ ...point, at_least: point.at_least - 1 })) },
  ]);
});
