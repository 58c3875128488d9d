// Shops that are quick to simulate, as `prepare` of a test wants them.

import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { rectangle } from "./shapes.mjs";

/** A gondola with some labels, and 12 candidates. `variation`: as in a store file. */
export const smallShop = (variation) => (folder) => {
  const list = [0, 1, 2, 3].flatMap((x) =>
    [0, 1, 2].map((y) => ({ id: `T${x}-${y}`, position: [1.1 + 1.25 * x, 0.8 + 1.7 * y, 2.98], type: "wide" })),
  );
  const gondola = {
    ...{ type: "gondola", id: "A1", at: [1.2, 2.1], length: 3, depth: 0.8, height: 1.6, material: "paper" },
    ...{ shelves: [0.5, 1.1], stocking: 0.7, labels: { type: "standard", spacing: 0.7 } },
  };
  const store = {
    room: { size: [6, 5, 3], floor: "paper", ceiling: "paper", walls: "paper" },
    materials: { paper: { type: "lambertian", reflectance: 0.6 } },
    label_types: { standard: { threshold: 0.02 } },
    transceiver_types: { wide: { emission: { type: "sin2theta", peak: 1 } } },
    fixtures: [gondola],
    transceivers: { list },
    ...(variation ? { variation } : {}),
  };
  writeFileSync(join(folder, "store.json"), JSON.stringify(store, null, 2));
};

/** Selects four candidates of the first grid in the middle of the shop. */
export function withFourUnits(folder) {
  const file = join(folder, "store.json");
  const text = readFileSync(file, "utf8");
  const selected = rectangle(2, 2, 5, 5).map(([x, y]) => `G1-${x}-${y}`);
  writeFileSync(file, text.replace(/"transceivers":\s*\{/, `$& "selected": ${JSON.stringify(selected)},`));
}
