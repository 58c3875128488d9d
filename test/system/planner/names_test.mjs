// Tests names of all kinds with markup: they stay texts everywhere, and nothing in them runs.

import { writeFileSync } from "node:fs";
import { join } from "node:path";

import { check, equal, says } from "../viewer/check.mjs";
import { testPlanner } from "./opened.mjs";
import { rectangle } from "./shapes.mjs";

/** A name that shows whatever reads it as markup, as a selector, or as a pointer. */
const marked = (what) => `${what} </b><img src=x onerror="hit=1"><script>hit=1</script> &lt; '~1\`\${hit=1}`;

const material = marked("material");
const store = {
  name: marked("shop"),
  room: {
    size: [12, 9, 3],
    ...{ floor: material, ceiling: material, walls: material },
    zones: [{ id: marked("zone"), height: 2.8, polygon: rectangle(0, 0, 4, 4) }],
    inner_walls: [{ id: marked("wall"), from: [8, 5], to: [8, 9] }],
  },
  materials: {
    [material]: { type: "lambertian", reflectance: 0.5 },
    [marked("unused")]: { type: "lambertian", reflectance: 0.4 },
  },
  label_types: { [marked("tag")]: { threshold: 0.05 } },
  transceiver_types: { [marked("lamp")]: { emission: { type: "lambertian", flux: 3 } } },
  presets: {
    [marked("preset")]: {
      ...{ type: "gondola", length: 3, depth: 0.9, height: 1.8, material, shelves: [0.4, 1] },
      labels: { type: marked("tag"), spacing: 1 },
    },
  },
  fixtures: [
    { preset: marked("preset"), id: marked("shelf"), at: [1, 6] },
    { type: "box", id: marked("box"), at: [10, 1, 0], size: [1, 1, 1], material },
    { type: "box", id: marked("other"), at: [10.5, 1, 0], size: [1, 1, 1], material },
  ],
  labels: [{ id: marked("label"), position: [10.5, 0.98, 0.8], normal: [0, -1, 0], type: marked("tag") }],
  transceivers: {
    list: [{ id: marked("unit"), position: [6, 2, 2.9], type: marked("lamp") }],
    rails: [{ id: marked("rail"), type: marked("lamp"), points: [5, 8].map((y) => [5, y, 2.9]), spacing: 1 }],
  },
};
const prepare = (folder) => writeFileSync(join(folder, "store.json"), `${JSON.stringify(store, null, 2)}\n`);

async function shows(tab, selector, ...names) {
  await tab.settle();
  const found = await tab.texts(selector);
  for (const name of names)
    check(
      found.some((one) => one.includes(marked(name))),
      `${selector} does not show ${name}: ${JSON.stringify(found)}`,
    );
  await isHarmless(tab, selector);
}

/** Nothing has run, and no name has become an element. */
async function isHarmless(tab, where) {
  const found = await tab.evaluate(() => ({
    hit: typeof globalThis.hit,
    images: document.querySelectorAll("img, b").length,
    scripts: [...document.scripts].filter(({ src }) => src === "").length,
    handlers: document.querySelectorAll("[onerror], [onload]").length,
  }));
  equal(found, { hit: "undefined", images: 0, scripts: 0, handlers: 0 }, where);
}

testPlanner("markup in every name stays text", { prepare }, async (tab) => {
  await shows(tab, ".toolbar h1", "shop");
  says(await tab.page.title(), marked("shop"));
  await shows(tab, ".object .name", "zone", "wall", "shelf", "box", "other", "label", "rail", "unit");
  await shows(tab, ".object small", "preset", "tag", "lamp");
  await shows(tab, ".names span", "shelf", "zone", "box");
  await tab.push("#tab-types");
  await shows(tab, ".type-list button", "preset", "material", "unused", "tag", "lamp");
  await tab.push("#tab-problems");
  await tab.until(() => document.querySelectorAll(".problem-list li").length > 1);
  await shows(tab, ".problem-list", "box", "unused");
  await tab.push("#tab-objects");
});

testPlanner("markup in names stays text where names are changed and found", { prepare }, async (tab) => {
  for (const name of ["shelf", "box", "zone", "wall", "label", "rail", "unit"]) {
    await tab.list(`${name} </b>`);
    await shows(tab, ".properties h2", name);
    equal(await tab.page.inputValue('[data-key="field/id"]'), marked(name));
    await shows(tab, ".status .hint", name);
  }
  await tab.push("#tab-types");
  let steps = 0;
  for (const [list, name, field, typed] of [
    ["presets", "preset", "length", "3.5"],
    ["materials", "material", "reflectance", "0.6"],
    ["label_types", "tag", "safety_factor", "1.5"],
  ]) {
    const key = `/${list}/${marked(name).replaceAll("~", "~0").replaceAll("/", "~1")}`;
    await tab.evaluate((of) => document.querySelector(`[data-key="${CSS.escape(of)}"]`).click(), key);
    await shows(tab, ".properties h2", name);
    await tab.fill(`field/${field}`, typed);
    await tab.steps(++steps);
    equal(Object.keys(tab.json[list]), Object.keys(store[list]), "no other name");
  }
  equal(tab.json.presets[marked("preset")].length, 3.5);
  await tab.click(2.5, 6.45);
  await shows(tab, ".properties h2", "shelf");
  await shows(tab, '[data-key="field/preset"] option', "preset");
  await tab.press("Shift+ArrowUp");
  await tab.steps(++steps);
  await tab.press("r");
  await tab.steps(++steps);
  await tab.push("#tab-history");
  await shows(tab, ".history button", "preset", "material", "tag", "shelf");
  await tab.press("Control+c");
  await tab.notice("Copied");
  await shows(tab, ".notice", "shelf");
  await tab.press("Shift+F10", "Escape", "Control+f");
  await tab.page.keyboard.type("</b>");
  await tab.until(() => document.querySelectorAll(".results li").length > 3);
  await shows(tab, ".results li", "shelf", "box");
  await tab.press("Escape", "d");
  await tab.hasSpace();
  await isHarmless(tab, "3-D");
  await tab.press("d");
});
