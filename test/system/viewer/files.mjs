// Reads the files of a plan without shelfbeam's code.

import { readFileSync } from "node:fs";
import { join } from "node:path";

/** RFC 4180. */
export function readCsv(path) {
  const rows = [[""]];
  let quoted = false;
  const text = readFileSync(path, "utf8");
  for (let k = 0; k < text.length; ++k) {
    const row = rows[rows.length - 1];
    const c = text[k];
    if (quoted && c === '"' && text[k + 1] === '"') row[row.length - 1] += text[++k];
    else if (c === '"') quoted = !quoted;
    else if (quoted) row[row.length - 1] += c;
    else if (c === ",") row.push("");
    else if (c === "\n") rows.push([""]);
    else if (c !== "\r") row[row.length - 1] += c;
  }
  const [head, ...body] = rows.filter((row) => row.length > 1 || row[0] !== "");
  return body.map((row) => Object.fromEntries(head.map((name, k) => [name, row[k]])));
}

/** A matrix of float32, version 1 of NPY. */
export function readNpy(path) {
  const bytes = readFileSync(path);
  const size = bytes.readUInt16LE(8);
  const head = bytes.toString("latin1", 10, 10 + size);
  const [, rows, columns] = /'shape': \((\d+), (\d+)\)/.exec(head);
  if (!head.includes("<f4")) throw new Error(`${path}: ${head}`);
  const data = bytes.buffer.slice(bytes.byteOffset + 10 + size, bytes.byteOffset + bytes.length);
  return { rows: Number(rows), columns: Number(columns), values: new Float32Array(data) };
}

export const readJson = (path) => JSON.parse(readFileSync(path, "utf8"));

/** The rows of placement.csv by the number of the unit, which mounting.csv lists. */
export function readChosen(folder) {
  const rows = readCsv(join(folder, "placement.csv"));
  return readCsv(join(folder, "mounting.csv")).map(({ id }) => rows.find((row) => row.id === id));
}

/** The files of `plan` in a folder, and the matrices that `export` makes from its signal.h5. */
export function readPlan(folder) {
  return {
    folder,
    labels: readCsv(join(folder, "labels.csv")),
    chosen: readChosen(folder),
    placement: readJson(join(folder, "placement.json")),
    mean: readNpy(join(folder, "mean.npy")),
    error: readNpy(join(folder, "standard-error.npy")),
    direct: readNpy(join(folder, "direct.npy")),
  };
}

/** The columns of a plan's units in its matrix. */
export const columnsOf = ({ placement }, units) => placement.selected.map((id) => units.indexOf(id));

/** The number of reached labels. */
export const metBy = ({ labels }, signals) =>
  labels.filter(({ requirement }, k) => signals[k] >= Number(requirement) * (1 - 1e-9)).length;

export const verdictOf = ({ missed, undecided }, id) =>
  missed.includes(id) ? "missed" : undecided.includes(id) ? "undecided" : "reached";

/** The signal at every label from a set of columns: an independent implementation of docs/formats/placement.md. */
export function received({ mean, placement }, on) {
  const cooperative = placement.model === "cooperative";
  return Array.from({ length: mean.rows }, (_, label) => {
    const found = [...on].map((unit) => mean.values[label * mean.columns + unit]).sort((a, b) => b - a);
    if (placement.survives_failure) found.shift();
    return cooperative ? found.reduce((sum, signal) => sum + signal, 0) : Math.max(0, ...found.slice(0, 1));
  });
}
