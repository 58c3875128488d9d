// Tests floor plans from PDF files.

import { spawnSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

import { pagesOf, pdfOf, pixelOf, shopPdf, streamOf } from "../../data/pdf_files.mjs";
import { check, equal, says } from "../viewer/check.mjs";
import { colourAt, drop, pixelAt, shown } from "./floor_plan.mjs";
import { inEmptyShop, testPlanner } from "./opened.mjs";
import { linesOf, traceRoom, traceScale } from "./traced_shop.mjs";
import { Tracer } from "./tracer.mjs";

testPlanner("pdf: an L-shaped shop with a slanted wall, by snapping", { ...inEmptyShop, smoke: true }, async (tab) => {
  await drop(tab, "Shop 1:100.pdf", shopPdf());
  await tab.until(() => document.querySelectorAll(".sheets canvas").length === 2);
  says(await tab.text(".dialog h2"), "Which page of Shop 1:100.pdf is the floor plan?");
  await tab.picture("pdf-pages");
  await tab.push('[data-page="2"]');
  await tab.steps(1);
  await shown(tab);
  await linesOf(tab);
  equal(tab.json.drawing, { file: "Shop-1-100.pdf", page: 2, size: [1190.55, 841.89], at: [0, 0] });
  const person = new Tracer(tab, pixelOf);
  await traceScale(person);
  await traceRoom(person);
  await tab.picture("pdf-traced");
  await tab.reload();
  await shown(tab);
});

/** A file on the plan, while `look` runs; undo removes it. */
async function showing(tab, name, body, look) {
  await drop(tab, name, body);
  await tab.steps(1);
  await shown(tab);
  await tab.press("Escape");
  await look();
  await tab.press("Escape", "Control+z");
  await tab.steps(0);
}

testPlanner("pdf: images of every codec", inEmptyShop, async (tab) => {
  const folder = mkdtempSync(join(tmpdir(), "pdf-"));
  const script = fileURLToPath(new URL("../../data/pdf_images.py", import.meta.url));
  const { status, stderr } = spawnSync("/usr/bin/python3", [script, folder], { encoding: "utf8" });
  if (status !== 0 && !process.env.CI) return console.log(`        skipped: ${stderr.trim().split("\n").at(-1)}`);
  equal(status, 0, stderr);
  const names = readdirSync(folder);
  equal(names.length, 11);
  for (const name of names)
    await showing(tab, name, readFileSync(join(folder, name)), async () => {
      const grey = async (x, y) => (await colourAt(tab, await pixelAt(tab, x, y)))[0];
      const [square, bar, paper] = [await grey(75, 50), await grey(150, 180), await grey(200, 60)];
      check(square < 60 && bar < 60 && paper > 230, `${name}: ${square}, ${bar}, ${paper}`);
    });
  rmSync(folder, { recursive: true });
});

const box = "1 w 50 50 200 100 re S";
const catalog = (entry, ...more) => pagesOf([box], { catalog: entry, more });
const field = (name) => readFileSync(new URL(`../../data/field4/${name}.pdf`, import.meta.url));

testPlanner("pdf: scripts, attachments, layers and other bytes do no harm", inEmptyShop, async (tab) => {
  let isAsked = false;
  tab.page.on("dialog", (dialog) => {
    isAsked = true;
    void dialog.dismiss();
  });
  // The numbers of lines and outlines.
  for (const [name, body, ...expected] of [
    [
      "script",
      catalog("/OpenAction << /S /JavaScript /JS (app.alert(1); window.location = 'http://example.com/';) >> "),
      ...[4, 1],
    ],
    [
      "attached",
      catalog(
        "/Names << /EmbeddedFiles << /Names [(a.exe) 5 0 R] >> >> ",
        "<< /Type /Filespec /F (a.exe) /EF << /F 6 0 R >> >>",
        streamOf("MZ"),
      ),
      ...[4, 1],
    ],
    [
      "hidden-layer",
      catalog(
        "/OCProperties << /OCGs [5 0 R] /D << /OFF [5 0 R] /Order [5 0 R] >> >> ",
        "<< /Type /OCG /Name (Furniture) >>",
      ),
      ...[4, 1],
    ],
    ["large", pagesOf([box], { size: [14400, 14400] }), 4, 1],
    ["clip", field("clip"), 6, 1], // four walls, and a line of two parts
    ["white_cover", field("white_cover"), 5, 1],
    ["junk_mark", field("junk_mark"), 5, 1],
    ["junk_head", field("junk_head"), 5, 1],
    ["junk_html", field("junk_html"), 5, 1],
    ["text_japan", field("text_japan"), 5, 1],
  ])
    await showing(tab, `${name}.pdf`, body, async () => {
      await linesOf(tab);
      const found = await tab.state(({ planner: { picture } }) => [
        picture.lines.count,
        picture.lines.lines.firsts.length - 1,
      ]);
      equal(found, expected, name);
      if (name !== "text_japan") return;
      const dark = await tab.state(({ planner }) => {
        const canvas = document.createElement("canvas");
        [canvas.width, canvas.height] = [120, 80];
        const [bitmap] = planner.picture.state.levels;
        const [x, y] = [bitmap.width / 1000, bitmap.height / 700];
        const context = canvas.getContext("2d");
        context.drawImage(bitmap, 195 * x, 425 * y, 120 * x, 80 * y, 0, 0, 120, 80);
        return context.getImageData(0, 0, 120, 80).data.filter((value, k) => k % 4 === 0 && value < 128).length;
      });
      check(dark > 50, `${dark} dark pixels of the text`);
    });
  check(!isAsked, "a script of a file has run");
});

testPlanner("pdf: far pages are drawn when they are seen", inEmptyShop, async (tab) => {
  await drop(tab, "many.pdf", pagesOf(Array(10_000).fill(box)));
  await tab.until(() => document.querySelectorAll(".sheets button").length === 10_000);
  await tab.until(() => document.querySelectorAll(".sheets canvas").length > 4);
  check((await tab.count(".sheets canvas")) < 200, "pages in view only");
  await tab.page.keyboard.type("9876");
  await tab.press("Enter");
  await tab.steps(1);
  equal(tab.json.drawing.page, 9876);
  await shown(tab);
});

testPlanner("pdf: broken, encrypted and endless files are refused by name", inEmptyShop, async (tab) => {
  const key = "<41".padEnd(65, "0") + ">";
  const encrypted = `/ID [<00> <00>] /Encrypt << /Filter /Standard /V 1 /R 2 /P -4 /O ${key} /U ${key} >> `;
  const itsOwnPages = ["<< /Type /Catalog /Pages 2 0 R >>", "<< /Type /Pages /Kids [2 0 R] /Count 1 >>"];
  for (const [words, body] of [
    ["The file is a form (XFA)", catalog("/AcroForm << /XFA 5 0 R /Fields [] >> ", streamOf("<xdp:xdp></xdp:xdp>"))],
    ["The file needs a password", pagesOf([box], { trailer: encrypted })],
    ["The file is damaged", Buffer.from("%PDF-1.7\nnothing of a PDF file")],
    ["The file is damaged", shopPdf().subarray(0, 300)],
    ["The file is damaged", pdfOf(itsOwnPages)],
  ]) {
    await drop(tab, "plan.pdf", body);
    await tab.notice(`plan.pdf: ${words}`);
    await tab.hush();
    await tab.press("m");
    equal(await tab.tool(), "measure", "the page is alive");
    await tab.press("Escape");
  }
  await tab.steps(0);
  equal(tab.json.drawing, undefined);
});
