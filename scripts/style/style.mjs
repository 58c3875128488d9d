// Usage: node style.mjs format|check|check-and-lint FILE...
//
// Formats Python (ruff) and TypeScript, JavaScript and JSON (biome), checks their format, or also lints them and CSS.
// Prints one problem per line. PACKAGES is the folder of the npm packages.

import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";

const require = createRequire(`${process.env.PACKAGES}/`);

function ruff() {
  const { PositionEncoding, Workspace } = require("@astral-sh/ruff-wasm-nodejs");
  const workspace = new Workspace(
    {
      "line-length": 120,
      "target-version": "py311", // Debian 12
      format: { "skip-magic-trailing-comma": true },
      lint: {
        select: ["B", "C4", "E", "F", "PLE", "UP", "W"],
        // Calls in defaults, functions in loops, caches of methods, zip() without strict=, imports after a change of
        // the path: all deliberate here.
        ignore: ["B008", "B019", "B023", "B905", "E402"],
      },
    },
    PositionEncoding.Utf32,
  );
  return {
    format: (text) => workspace.format(text),
    lint: (text) => workspace.check(text).map(({ code, message, start_location: { row } }) => ({ row, code, message })),
  };
}

function biome() {
  const { Biome } = require("@biomejs/js-api/nodejs");
  const workspace = new Biome();
  const { projectKey } = workspace.openProject();
  workspace.applyConfiguration(projectKey, {
    formatter: { indentStyle: "space", lineWidth: 120 },
    linter: {
      rules: {
        recommended: true,
        complexity: { noImportantStyles: "off" },
        correctness: { noInvalidGridAreas: "off" }, // refuses areas of several rows
        style: { noDescendingSpecificity: "off", useTemplate: "off" },
        suspicious: { noSparseArray: "off", useIterableCallbackReturn: "off" },
      },
    },
  });
  const rowOf = (text, offset) => Buffer.from(text).subarray(0, offset).toString().split("\n").length;
  return {
    format(text, filePath) {
      const { content, diagnostics } = workspace.formatContent(projectKey, text, { filePath });
      if (diagnostics.some(({ severity }) => severity === "error" || severity === "fatal"))
        throw new Error(`${filePath}: ${diagnostics[0].description}`);
      return content;
    },
    lint: (text, filePath) =>
      workspace
        .lintContent(projectKey, text, { filePath })
        .diagnostics.filter(({ category }) => !category.startsWith("assist/"))
        .map(({ category, description, location: { span } }) => ({
          row: span ? rowOf(text, span[0]) : 1,
          code: category,
          message: description,
        })),
  };
}

const [mode, ...files] = process.argv.slice(2);
const tools = {};
for (const file of files) {
  const text = readFileSync(file, "utf8");
  const name = /\.(ts|mjs|css|json)$/.test(file) ? "biome" : "ruff";
  if (!tools[name]) tools[name] = name === "biome" ? biome() : ruff();
  const tool = tools[name];
  const problems = [];
  // Style sheets stay compact, because reports contain them as they are.
  const formatted = file.endsWith(".css") ? text : tool.format(text, file);
  if (formatted !== text && mode === "format") writeFileSync(file, formatted);
  else if (formatted !== text) problems.push(`${file}: not formatted`);
  if (mode === "check-and-lint")
    for (const { row, code, message } of tool.lint(text, file)) problems.push(`${file}:${row}: ${message} [${code}]`);
  for (const problem of problems) console.log(problem);
  if (problems.length) process.exitCode = 1;
}
