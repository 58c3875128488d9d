// Makes the plans whose reports are tested with the program.

import { execFileSync } from "node:child_process";
import { cpSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";

import { readChosen, readCsv, readJson, readPlan } from "./files.mjs";

const run = (program, ...words) => execFileSync(program, words, { stdio: ["ignore", "pipe", "inherit"] }).toString();

function makeStore(shelfbeam, work, name) {
  run(shelfbeam, "new", name, join(work, `${name}-store`));
  return join(work, `${name}-store`, "store.json");
}

/** Its thresholds are confirmed. */
function confirmed(store) {
  const types =
    '"standard": { "threshold": 0.007 }, "freezer": { "threshold": 0.007 }, "large": { "threshold": 0.006 }';
  const marks = `"confirmed": { "label_types": { ${types} } },`;
  writeFileSync(store, readFileSync(store, "utf8").replace('"source": "example",', marks));
  return store;
}

function makePlan(shelfbeam, folder, store, ...options) {
  const quick = ["--no-certificate", "--samples", "200", "--quiet"];
  run(shelfbeam, "plan", store, "-o", folder, ...quick, ...options);
  for (const what of ["mean", "standard-error", "direct"])
    run(shelfbeam, "export", join(folder, "signal.h5"), "-o", join(folder, `${what}.npy`), "--what", what, "--quiet");
  return readPlan(folder);
}

/** All plans by name. */
export function makePlans(shelfbeam, work) {
  const [thesis, chiller] = ["thesis", "chiller"].map((name) => makeStore(shelfbeam, work, name));
  const options = {
    grocery: [confirmed(makeStore(shelfbeam, work, "grocery"))],
    "spare-alone": [thesis, "--model", "non-cooperative", "--survive-failure"],
    options: [chiller],
  };
  const plans = {};
  for (const [name, words] of Object.entries(options)) plans[name] = makePlan(shelfbeam, join(work, name), ...words);
  return {
    ...plans,
    certified: certify(shelfbeam, plans.grocery, join(work, "certified")),
    changing: planChanging(shelfbeam, work, chiller),
  };
}

/** Replaces results in the file of a plan, and rebuilds the report. */
function rebuild(shelfbeam, folder, more) {
  const path = join(folder, "placement.json");
  // Without the record of the files, the plan counts as one of an earlier version, which `report` does not check.
  const { complete, files, ...answer } = readJson(path);
  writeFileSync(path, JSON.stringify({ ...answer, ...more }));
  run(shelfbeam, "report", folder, "--quiet");
}

/** The plan of a shop that changes, with made-up results in two states. */
function planChanging(shelfbeam, work, store) {
  const people = { area: "room", number: { uniform: [4, 9] }, size: [0.5, 0.3, 1.75], material: "cabinet" };
  const variation = JSON.stringify({ people: [people], doors: [{ fixtures: "*", open: 0.5 }] });
  const changing = join(dirname(store), "changing.json");
  writeFileSync(changing, readFileSync(store, "utf8").replace('"name":', `"variation": ${variation}, "name":`));
  const folder = join(work, "changing");
  const { labels, placement } = makePlan(shelfbeam, folder, changing, "--states", "0");
  const missed = labels.map(({ id }) => id).filter((_, k) => k % 11 === 5);
  const { count, selected } = placement;
  const outcome = {
    ...{ units: count, states: 300, labels_below: 0, worst_availability: 0.99 },
    ...{ all_reached: 0.99, mean_missed: 0.01, states_with_miss: 3, missed: { [missed[0]]: 3 } },
  };
  const states = {
    ...{ count: 300, rule: "labels", goal: null, availability: 0.95, other_availabilities: {}, confidence: 0.99 },
    ...{ covers: "states and sampling error", assumes: "changes as in the store file", certified: true },
    ...{ labels_below: 0, sample_count: count, sample_value: count, sample_lower_bound: 1, sample_selected: selected },
    ...{ certified_count: count, lower_bound: 1, unreachable: [], nominal: outcome, sample: outcome },
    examined: [outcome],
    shown_states: [
      { state: 1000000, missed: [] },
      { state: 1000217, missed },
    ],
    ...{ responsible: [], at_risk: [], addition: null, assumed: {}, open: null },
  };
  rebuild(shelfbeam, folder, { states });
  return readPlan(folder);
}

/** A plan with a certificate that has every verdict, as if from independent samples. */
function certify(shelfbeam, { folder: original, labels, placement }, folder) {
  cpSync(original, folder, { recursive: true });
  const ids = labels.map(({ id }) => id);
  const missed = ids.filter((_, k) => k % 40 === 7);
  const undecided = ids.filter((_, k) => k % 40 === 21);
  const { count } = placement;
  const reached = ids.length - missed.length - undecided.length;
  const certificate = {
    ...{ confidence: 0.975, reached, missed, undecided },
    ...{ count_lower_bound: count - 1, bound_labels: 41, rounds: 3, open: { code: "interrupted" } },
  };
  const curve = Array.from({ length: count }, (_, k) => ({
    units: k + 1,
    at_least: ids.length - 97 * (count - 1 - k),
    at_most: ids.length - 61 * (count - 1 - k),
  }));
  rebuild(shelfbeam, folder, { certificate, curve, curve_complete: true, sensitivity: madeUpSensitivity(ids) });
  return readPlan(folder);
}

/** A made-up effect of reflectances on a plan, with a different number at every position of the page. */
function madeUpSensitivity(ids) {
  const least = (margin, label) => ({ smallest_margin: margin, standard_error: 0.01, label: ids[label] });
  const step = (margin, label, change, mean_change, labels_short) => ({
    ...least(margin, label),
    ...{ change, change_standard_error: Math.abs(change) / 90, mean_change, labels_short },
  });
  const material = (name, k) => ({
    ...{ name, reflectance: 0.5 + 0.013 * k, range: [0.3 + 0.011 * k, 0.7 + 0.017 * k], assumed: k % 2 === 1 },
    low: step(0.713 + 0.041 * k, 3 + k, -0.431 + 0.0371 * k, -0.183 + 0.0151 * k, 9 - k),
    high: step(1.633 - 0.027 * k, 30 + k, 0.3, 0.231 - 0.0173 * k, 0),
  });
  return {
    ...{ confidence: 0.975, holds: "no", assumed_error: 0.15, as_given: least(1.293, 2) },
    low: { ...least(0.617, 5), missed: ids.slice(0, 23), undecided: ids.slice(40, 51) },
    high: { ...least(2.171, 6), missed: [], undecided: [] },
    materials: ["carton", "a floor", "plaster <white>", "steel", "foil"].map(material),
    ...{ kept: ["glass"], watched: 256, batches: 64 },
  };
}

/** A hypermarket, and the numbers that its report must show. */
export function makeLargePlan(shelfbeam, largeReport, work) {
  const folder = join(work, "large");
  mkdirSync(folder);
  const made = JSON.parse(run(largeReport, makeStore(shelfbeam, work, "hypermarket"), folder));
  return { folder, labels: readCsv(join(folder, "labels.csv")), chosen: readChosen(folder), made };
}
