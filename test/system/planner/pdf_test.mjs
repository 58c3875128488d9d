// Tests floor plans from PDF files.

import { spawnSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

import { outline, zone } from "../../data/drawn_shop.mjs";
import { pagesOf, pdfOf, pixelOf, shopPdf, streamOf } from "../../data/pdf_files.mjs";
import { check, equal, says } from "../viewer/check.mjs";
import { colourAt, drop, pixelAt, shown } from "./floor_plan.mjs";
import { testPlanner } from "./opened.mjs";
import { Tracer } from "./tracer.mjs";

/** The largest distance between corners of two outlines that begin at any corner, m. */
export function farthest(found, expected) {
  if (found.length !== expected.length) return Infinity;
  const off = (shift) =>
    Math.max(
      ...expected.map(([x, y], k) => {
        const [u, v] = found[(k + shift) % found.length];
        return Math.hypot(u - x, v - y);
      }),
    );
  return Math.min(...expected.map((_, shift) => off(shift)));
}

const lines = (tab) => tab.until(() => window.shelfbeamPlanner.planner.picture.lines !== null);
const notice = (tab, words) =>
  tab.until((part) => document.querySelector(".notice").textContent.replaceAll("\u00a0", " ").includes(part), words);

/** The page is alive: it still measures. */
async function alive(tab) {
  await tab.press("m");
  equal(await tab.page.evaluate(() => document.querySelector(".plan").dataset.tool), "measure");
  await tab.press("Escape");
}

/** Traces the shop: the scale, its check, the room, and the zone with the lower ceiling. */
export async function traceShop(person) {
  const { tab } = person;
  await person.click(outline[0]);
  await person.click(outline[1]);
  await person.type("18", "Enter");
  await person.click(outline[0]);
  await person.click(outline[6]);
  await person.type("15", "Enter");
  await tab.until(() => document.querySelector(".scale-state").hidden);
  await traceRoom(person);
}

export async function traceRoom(person) {
  const { tab } = person;
  await person.take("r");
  for (const point of outline) await person.click(point);
  await person.click(outline[0]);
  await person.take("z");
  await person.take("f");
  await person.drag(zone[0], zone[2], { pixels: 1 });
  await person.fill("field/height", "2.6");
  await person.take("Escape");
  const { room } = tab.json;
  const off = farthest(room.outline, outline);
  check(off < 0.005, `the room is ${off} m off`);
  const [{ polygon, height }] = room.zones;
  check(farthest(polygon, zone) < 0.005 || farthest([...polygon].reverse(), zone) < 0.005, JSON.stringify(polygon));
  equal(height, 2.6);
}

testPlanner(
  "pdf: an L-shaped shop with a slanted wall from a page, by snapping",
  { store: null, smoke: true, keeps: true },
  async (tab) => {
    await drop(tab, "Shop 1:100.pdf", shopPdf());
    await tab.until(() => document.querySelectorAll(".sheets canvas").length === 2);
    says(await tab.text(".dialog h2"), "Which page of Shop 1:100.pdf is the floor plan?");
    await tab.picture("pdf-pages");
    await tab.push('[data-page="2"]');
    await tab.steps(1);
    await shown(tab);
    await lines(tab);
    equal(tab.json.drawing, { file: "Shop-1-100.pdf", page: 2, size: [1190.55, 841.89], at: [0, 0] });
    await traceShop(new Tracer(tab, pixelOf));
    await tab.picture("pdf-traced");
    await tab.page.reload();
    await tab.until(() => window.shelfbeamPlanner?.planner.picture.state.kind === "shown");
  },
);

/** A file on the plan; undo removes it. */
async function showsAndGoes(tab, name, body) {
  await drop(tab, name, body);
  await tab.steps(1);
  await shown(tab);
  await tab.press("Escape");
}

async function removed(tab) {
  await tab.press("Escape", "Control+z");
  await tab.steps(0);
}

testPlanner("pdf: images of every codec", { store: null, keeps: true }, async (tab) => {
  const folder = mkdtempSync(join(tmpdir(), "pdf-"));
  const script = fileURLToPath(new URL("../../data/pdf_images.py", import.meta.url));
  const { status, stderr } = spawnSync("/usr/bin/python3", [script, folder], { encoding: "utf8" });
  if (status !== 0 && !process.env.CI) return console.log(`        skipped: ${stderr.trim().split("\n").at(-1)}`);
  equal(status, 0, stderr);
  const names = readdirSync(folder);
  equal(names.length, 11);
  for (const name of names) {
    await showsAndGoes(tab, name, readFileSync(join(folder, name)));
    const grey = async (x, y) => (await colourAt(tab, await pixelAt(tab, x, y)))[0];
    const [square, bar, paper] = [await grey(75, 50), await grey(150, 180), await grey(200, 60)];
    check(square < 60 && bar < 60 && paper > 230, `${name}: ${square}, ${bar}, ${paper}`);
    await removed(tab);
  }
  rmSync(folder, { recursive: true });
});

const box = "1 w 50 50 200 100 re S";
const catalog = (entry, ...more) => pagesOf([box], { catalog: entry, more });

testPlanner("pdf: scripts, attachments, layers and far pages do no harm", { store: null, keeps: true }, async (tab) => {
  let isAsked = false;
  tab.page.on("dialog", (dialog) => {
    isAsked = true;
    void dialog.dismiss();
  });
  const harmless = {
    script: catalog("/OpenAction << /S /JavaScript /JS (app.alert(1); window.location = 'http://example.com/';) >> "),
    attached: catalog(
      "/Names << /EmbeddedFiles << /Names [(a.exe) 5 0 R] >> >> ",
      "<< /Type /Filespec /F (a.exe) /EF << /F 6 0 R >> >>",
      streamOf("MZ"),
    ),
    "hidden-layer": catalog(
      "/OCProperties << /OCGs [5 0 R] /D << /OFF [5 0 R] /Order [5 0 R] >> >> ",
      "<< /Type /OCG /Name (Furniture) >>",
    ),
    large: pagesOf([box], { size: [14400, 14400] }),
  };
  for (const [name, body] of Object.entries(harmless)) {
    await showsAndGoes(tab, `${name}.pdf`, body);
    await lines(tab);
    equal(await tab.page.evaluate(() => window.shelfbeamPlanner.planner.picture.lines.count), 4, `lines of ${name}`);
    await removed(tab);
  }
  check(!isAsked, "a script of a file has run");

  await drop(tab, "many.pdf", pagesOf(Array(10_000).fill(box)));
  await tab.until(() => document.querySelectorAll(".sheets button").length === 10_000);
  await tab.until(() => document.querySelectorAll(".sheets canvas").length > 4);
  check(
    (await tab.page.evaluate(() => document.querySelectorAll(".sheets canvas").length)) < 200,
    "pages in view only",
  );
  await tab.page.keyboard.type("9876");
  await tab.press("Enter");
  await tab.steps(1);
  equal(tab.json.drawing.page, 9876);
  await shown(tab);
});

const field = (name) => readFileSync(new URL(`../../data/field4/${name}`, import.meta.url));

/** The numbers of lines and outlines. */
const counts = (tab) =>
  tab.page.evaluate(() => {
    const { count, lines } = window.shelfbeamPlanner.planner.picture.lines;
    return [count, lines.firsts.length - 1];
  });

testPlanner("pdf: only visible lines, and files behind other bytes", { store: null, keeps: true }, async (tab) => {
  const files = {
    clip: [6, 1], // four walls, and a line of two parts
    white_cover: [5, 1],
    junk_mark: [5, 1],
    junk_head: [5, 1],
    junk_html: [5, 1],
    text_japan: [5, 1],
  };
  for (const [name, expected] of Object.entries(files)) {
    await showsAndGoes(tab, `${name}.pdf`, field(`${name}.pdf`));
    await lines(tab);
    equal(await counts(tab), expected, name);
    if (name === "text_japan") {
      const dark = await tab.page.evaluate(() => {
        const canvas = document.createElement("canvas");
        [canvas.width, canvas.height] = [120, 80];
        const [bitmap] = window.shelfbeamPlanner.planner.picture.state.levels;
        const [x, y] = [bitmap.width / 1000, bitmap.height / 700];
        const context = canvas.getContext("2d");
        context.drawImage(bitmap, 195 * x, 425 * y, 120 * x, 80 * y, 0, 0, 120, 80);
        return context.getImageData(0, 0, 120, 80).data.filter((value, k) => k % 4 === 0 && value < 128).length;
      });
      check(dark > 50, `${dark} dark pixels of the text`);
    }
    await removed(tab);
  }
});

testPlanner("pdf: a larger sheet keeps m per point, and is not checked", { store: null, keeps: true }, async (tab) => {
  const chip = () => tab.page.evaluate(() => document.querySelector(".scale-state:not([hidden])")?.textContent ?? "");
  await drop(tab, "sheet_a.pdf", field("sheet_a.pdf"));
  await tab.steps(1);
  await shown(tab);
  await lines(tab);
  const person = new Tracer(tab, ([x, y]) => [100 + 50 * x, 600 - 50 * y]);
  for (const [to, length, steps] of [
    [[16, 0], "16", 2],
    [[0, 10], "10", 3],
  ]) {
    await person.click([0, 0]);
    await person.click(to);
    await person.type(length, "Enter");
    await tab.steps(steps);
  }
  equal(await chip(), "");
  const { scale, check: checked } = tab.json.drawing;
  check(checked !== undefined, "the check is stored");
  await drop(tab, "sheet_b.pdf", field("sheet_b.pdf"));
  await tab.page.click(".question button:not(.close)");
  await tab.steps(4);
  await shown(tab);
  const { size, scale: after, check: again } = tab.json.drawing;
  equal([size, again, await chip()], [[1400, 900], undefined, "Scale not checked"]);
  const step = ({ from, to, length }) => length / Math.hypot(to[0] - from[0], to[1] - from[1]);
  equal(step(after).toFixed(6), step(scale).toFixed(6), "m per point");
  equal(step(after).toFixed(4), "0.0200");
});

testPlanner(
  "pdf: broken, encrypted and endless files are refused by name",
  { store: null, keeps: true },
  async (tab) => {
    const key = "<41".padEnd(65, "0") + ">";
    const refused = [
      ["The file is a form (XFA)", catalog("/AcroForm << /XFA 5 0 R /Fields [] >> ", streamOf("<xdp:xdp></xdp:xdp>"))],
      [
        "The file needs a password",
        pagesOf([box], {
          trailer: `/ID [<00> <00>] /Encrypt << /Filter /Standard /V 1 /R 2 /P -4 /O ${key} /U ${key} >> `,
        }),
      ],
      ["The file is damaged", Buffer.from("%PDF-1.7\nnothing of a PDF file")],
      ["The file is damaged", shopPdf().subarray(0, 300)],
      [
        "The file is damaged", // its pages contain themselves
        pdfOf(["<< /Type /Catalog /Pages 2 0 R >>", "<< /Type /Pages /Kids [2 0 R] /Count 1 >>"]),
      ],
    ];
    for (const [words, body] of refused) {
      await drop(tab, "plan.pdf", body);
      await notice(tab, `plan.pdf: ${words}`);
      await tab.page.evaluate(() => {
        document.querySelector(".notice").textContent = "";
      });
      await alive(tab);
    }
    await tab.steps(0);
    equal(tab.server.json.drawing, undefined);
  },
);
