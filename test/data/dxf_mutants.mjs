// Damaged versions of a DXF file: the same one for the same key.

import { randomFrom } from "../system/planner/random.mjs";

const values = ["0", "-1", "7", "32767", "-32768", "1e308", "-1e308", "1e-308", "1e20", "nan", "", "A", "EOF", "ENDSEC"];
const isNumber = (line) => /^\s*-?\d+(\.\d*)?\s*$/.test(line);

const edits = {
  bytes(bytes, random) {
    const changed = Buffer.from(bytes);
    for (let k = 1 + Math.floor(3 * random()); k > 0; --k)
      changed[Math.floor(random() * bytes.length)] = Math.floor(256 * random());
    return changed;
  },
  /** Runs of pairs of a code and a value are left out, repeated, or stand elsewhere. */
  groups(bytes, random) {
    const lines = bytes.toString("latin1").split("\n");
    const place = () => 2 * Math.floor((random() * lines.length) / 2);
    for (let k = 1 + Math.floor(5 * random()); k > 0; --k) {
      const count = 2 * (1 + Math.floor(20 * random() ** 3));
      const from = place();
      const part = random() < 0.3 ? lines.slice(from, from + count) : lines.splice(from, count);
      if (random() < 0.6) lines.splice(place(), 0, ...part);
    }
    return Buffer.from(lines.join("\n"), "latin1");
  },
  /** Lines become equal to others: mostly codes to codes, and values to values. */
  lines(bytes, random) {
    const lines = bytes.toString("latin1").split("\n");
    const place = () => Math.floor(random() * lines.length);
    for (let k = 1 + Math.floor(5 * random()); k > 0; --k) {
      const from = place();
      const to = place();
      lines[random() < 0.9 ? to - ((to - from) % 2) : to] = lines[from];
    }
    return Buffer.from(lines.join("\n"), "latin1");
  },
  numbers(bytes, random) {
    const lines = bytes.toString("latin1").split("\n");
    for (let k = 1 + Math.floor(5 * random()); k > 0; --k) {
      let at = Math.floor(random() * lines.length);
      while (at < lines.length && !(at % 2 === 1 && isNumber(lines[at]))) ++at;
      const scaled = String(Number(lines[at] ?? 0) * 10 ** Math.floor(24 * random() - 12));
      lines[at] = random() < 0.5 ? scaled : values[Math.floor(random() * values.length)];
    }
    return Buffer.from(lines.join("\n"), "latin1");
  },
  truncated: (bytes, random) => bytes.subarray(0, Math.floor(random() * bytes.length)),
};

/** `key`: 0, 1, ..., of which each fifth is damaged in the same way. */
export function mutantOf(bytes, key) {
  const random = randomFrom(key);
  const kinds = Object.values(edits);
  return kinds[key % kinds.length](bytes, random);
}
