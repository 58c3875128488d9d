// node bundle.mjs PACKAGES OUT: bundles both pages with the packages of a node_modules folder.
//
//   OUT/viewer.js       the script of the report's 3-D view
//   OUT/planner/NAME    the files of the planner, and NAME.gz with the same bytes for the same input

import { copyFileSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, extname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const home = fileURLToPath(new URL(".", import.meta.url));
const [packages, out] = process.argv.slice(2);
const { build } = createRequire(`${packages}/`)("esbuild");

const common = {
  bundle: true,
  minify: true,
  target: "es2022",
  charset: "utf8",
  legalComments: "inline",
  logLevel: "warning",
  nodePaths: [packages],
};

await build({
  ...common,
  entryPoints: [join(home, "report/main.ts")],
  format: "iife",
  loader: { ".css": "text" },
  outfile: join(out, "viewer.js"),
});

const folder = join(out, "planner");
mkdirSync(folder, { recursive: true });
await build({
  ...common,
  entryPoints: { planner: join(home, "planner/main.ts"), style: join(home, "planner/style/planner.css") },
  format: "esm",
  entryNames: "[name]",
  outdir: folder,
});
for (const name of ["index.html", "icon.svg"]) copyFileSync(join(home, "planner", name), join(folder, name));

// Readers of formats are loaded with the first file that needs them.
await build({
  ...common,
  entryPoints: {
    "pdf/pdf": join(home, "planner/pdf/pdf.ts"),
    "dxf/worker": join(home, "planner/dxf/show/worker.ts"),
    "table/table": join(home, "planner/importing/module.ts"),
  },
  format: "esm",
  outdir: folder,
});
const reader = dirname(createRequire(`${packages}/`).resolve("pdfjs-dist/package.json"));
copyFileSync(join(reader, "legacy/build/pdf.worker.min.mjs"), join(folder, "pdf/worker.js"));
for (const [from, kind] of [
  ["wasm", /^(jbig2|openjpeg|qcms_bg)\.wasm$/],
  ["standard_fonts", /\.(pfb|ttf)$/],
  ["cmaps", /^(?!.*UTF(8|32)).*\.bcmap$/], // PDF does not know encodings in UTF-8 and UTF-32
])
  for (const name of readdirSync(join(reader, from)).filter((name) => kind.test(name)))
    copyFileSync(join(reader, from, name), join(folder, "pdf", name));

const names = readdirSync(folder, { recursive: true }).filter((name) => extname(name) !== "" && !name.endsWith(".gz"));
for (const name of names)
  writeFileSync(join(folder, `${name}.gz`), gzipSync(readFileSync(join(folder, name)), { level: 9 }));
