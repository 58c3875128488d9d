// node unit_tests.mjs PACKAGES OUT [FILTER]: bundles the tests of `unit`, or those with a text in their names, with the
// modules that they import, and runs them. With MANY in the environment, it tries more that is random or damaged.

import { spawnSync } from "node:child_process";
import { mkdirSync, readdirSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const [packages, out, filter = ""] = process.argv.slice(2);
const folder = fileURLToPath(new URL("unit", import.meta.url));
const tests = readdirSync(folder).filter((name) => name.endsWith("_test.mjs") && name.includes(filter));
rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
await createRequire(`${packages}/`)("esbuild").build({
  entryPoints: tests.map((name) => join(folder, name)),
  bundle: true,
  platform: "node",
  format: "esm",
  target: "node18",
  nodePaths: [packages],
  outdir: out,
  outExtension: { ".js": ".mjs" },
  logLevel: "warning",
  sourcemap: "inline",
});
const files = tests.map((name) => join(out, name));
const env = { ...process.env, EXAMPLES: fileURLToPath(new URL("../../../examples", import.meta.url)) };
const { status } = spawnSync(process.execPath, ["--enable-source-maps", "--test", ...files], { stdio: "inherit", env });
process.exit(status ?? 1);
