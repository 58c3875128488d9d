// node unused_texts.mjs viewer|planner: a page uses all its texts. The type check finds missing ones.

import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

import { equal, fails } from "./check.mjs";
import { readJson } from "./files.mjs";

const source = fileURLToPath(new URL("../../../src", import.meta.url));

const isText = (value) => typeof value === "string" || Array.isArray(value) || Object.keys(value).join() === "one,many";

/** The keys of all texts in a group: ["lists.none", "lists.units.search", ...]. A plural and a list are one text. */
const keysIn = (group, path = "") =>
  Object.entries(group).flatMap(([name, value]) => (isText(value) ? [path + name] : keysIn(value, `${path}${name}.`)));

/** A use of a group, such as `text.tools.colours[mode]`, is one of each of its texts, but not of its inner groups. */
function unusedTexts(texts, code) {
  const used = new Set([...code.matchAll(/(?:(?<![\w.])|(?<=\.\.\.))text\.([\w.]+)/g)].map(([, path]) => path));
  // A method of a text or list follows its key.
  const isUsed = (key) => used.has(key) || [...used].some((path) => path.startsWith(`${key}.`));
  return keysIn(texts).filter((key) => !isUsed(key) && !used.has(key.replace(/\.\w+$/, "")));
}

const [page] = process.argv.slice(2);
const catalogues = {
  viewer: () => readJson(join(source, "shelfbeam/report/text/english.json")).viewer,
  planner: () => readJson(join(source, "page/planner/english.json")),
};
const texts = catalogues[page]();
const folder = join(source, "page", page === "viewer" ? "report" : page);
const files = readdirSync(folder, { recursive: true }).filter((name) => name.endsWith(".ts"));
const codeOf = (names) => names.map((name) => readFileSync(join(folder, name), "utf8")).join("\n");

const allUsed = (of, code) => equal(unusedTexts(of, code), [], "unused texts");
allUsed(texts, codeOf(files));
const [first] = Object.keys(texts);
const more = { ...texts, [first]: { ...texts[first], inner: { extra: { one: "{0} more", many: "{0} more" } } } };
fails(() => allUsed(more, codeOf(files)), "a text that is not used");
const spared = { viewer: join("panel", "card.ts"), planner: join("side", "properties.ts") }[page];
fails(() => allUsed(texts, codeOf(files.filter((name) => name !== spared))), "a removed use");
console.log(`${keysIn(texts).length} texts are used`);
