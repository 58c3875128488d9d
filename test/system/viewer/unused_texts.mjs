// node unused_texts.mjs: src/page/report uses all its texts of english.json. The type check finds missing ones.

import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

import { equal, fails } from "./check.mjs";
import { readJson } from "./files.mjs";

const source = fileURLToPath(new URL("../../../src", import.meta.url));

/** The keys of all texts in a group: ["lists.none", "lists.units.search", ...]. */
const keysIn = (group, path = "") =>
  Object.entries(group).flatMap(([name, value]) =>
    typeof value === "string" ? [path + name] : keysIn(value, `${path}${name}.`),
  );

/** A use of a group, such as `text.tools.colours[mode]`, is one of each of its texts, but not of its inner groups. */
function unusedTexts(texts, code) {
  const used = new Set([...code.matchAll(/(?<![\w.])text\.([\w.]+)/g)].map(([, path]) => path));
  return keysIn(texts).filter((key) => !used.has(key) && !used.has(key.replace(/\.\w+$/, "")));
}

const { viewer } = readJson(join(source, "shelfbeam/report/text/english.json"));
const files = readdirSync(join(source, "page/report"), { recursive: true }).filter((name) => name.endsWith(".ts"));
const codeOf = (names) => names.map((name) => readFileSync(join(source, "page/report", name), "utf8")).join("\n");

const allUsed = (texts, code) => equal(unusedTexts(texts, code), [], "unused texts");
allUsed(viewer, codeOf(files));
const more = { ...viewer, card: { ...viewer.card, extra: { one: "{0} more", many: "{0} more" } } };
fails(() => allUsed(more, codeOf(files)), "a text that is not used");
fails(() => allUsed(viewer, codeOf(files.filter((name) => name !== join("panel", "card.ts")))), "a removed use");
console.log(`${keysIn(viewer).length} texts are used`);
