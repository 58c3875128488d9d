// Tests floor plans from DXF files.

import { readFileSync } from "node:fs";

import { columns, outline } from "../../data/drawn_shop.mjs";
import { pixelIn, shopDxf } from "../../data/shop_dxf.mjs";
import { check, equal, says } from "../viewer/check.mjs";
import { colourAt, drop, pixelAt, shown } from "./floor_plan.mjs";
import { testPlanner } from "./opened.mjs";
import { farthest, traceRoom } from "./pdf_test.mjs";
import { Tracer } from "./tracer.mjs";

const lines = (tab) => tab.until(() => window.shelfbeamPlanner.planner.picture.lines !== null);
const dialog = (tab) => tab.until(() => document.querySelector(".dialog.unit") !== null);
const notice = (tab, words) =>
  tab.until((part) => document.querySelector(".notice").textContent.replaceAll("\u00a0", " ").includes(part), words);

async function opened(tab, name, body) {
  await drop(tab, name, body);
  await dialog(tab);
  await tab.push('[data-key="unit-take"]');
  await tab.steps(1);
  await shown(tab);
  await lines(tab);
}

/** A click on a command of the menu at a place of the shop. */
async function use(tab, person, point, command) {
  await person.look(point, 40);
  await tab.page.mouse.click(...(await pixelAt(tab, ...person.pixelOf(point))), { button: "right" });
  await tab.settle();
  await tab.push(`.menu [data-command="${command}"]`);
}

testPlanner(
  "dxf: an L-shaped shop with a slanted wall from a drawing, by snapping",
  { store: null, smoke: true, keeps: true },
  async (tab) => {
    await drop(tab, "Shop.dxf", shopDxf());
    await dialog(tab);
    says(await tab.text(".dialog h2"), "In which unit is Shop.dxf?");
    says(await tab.text(".dialog p"), "The file says millimetres.");
    await tab.picture("dxf-unit");
    await tab.press("Enter");
    await tab.steps(1);
    await shown(tab);
    await lines(tab);
    const { drawing } = tab.json;
    equal([drawing.file, drawing.unit], ["Shop.dxf", "mm"]);
    check(await tab.page.evaluate(() => document.querySelector(".scale-state").hidden), "the unit is the scale");
    await traceRoom(new Tracer(tab, pixelIn(drawing)));
    await tab.picture("dxf-traced");
  },
);

testPlanner("dxf: outlines become the room, columns, zones and fixtures", { store: null, keeps: true }, async (tab) => {
  await opened(tab, "shop.dxf", shopDxf());
  const person = new Tracer(tab, pixelIn(tab.json.drawing));
  await use(tab, person, [1, 1], "outline_room");
  await tab.steps(2);
  equal((await tab.labels())[1], "Use an outline as the room");
  const off = farthest(tab.json.room.outline, outline);
  check(off < 0.001, `the room is ${off} m off`);
  person.pixelOf = pixelIn(tab.json.drawing);
  await use(tab, person, [4, 12], "outline_zone");
  await tab.steps(3);
  equal(tab.json.room.zones.length, 1);
  // All columns of a layer at once.
  await tab.press("Escape");
  await tab.page.keyboard.press("Control+k");
  await tab.page.keyboard.type("Properties of the floor plan");
  await tab.press("Enter");
  equal(await tab.text('[data-key="picture/outlines/COLUMNS"]'), "2 outlines …");
  await tab.push('[data-key="picture/outlines/COLUMNS"]');
  equal(await tab.page.$('.menu [data-command="outline_room"]'), null, "two outlines are no room");
  await tab.push('.menu [data-command="outline_column"]');
  await tab.steps(4);
  const { fixtures } = tab.json;
  equal(
    fixtures.map(({ id, top }) => [id, top]),
    [
      ["C1", "ceiling"],
      ["C2", "ceiling"],
    ],
  );
  columns.forEach((column, k) => check(farthest(fixtures[k].polygon, column) < 0.001, `column ${k}`));
  // A fixture needs a preset.
  await use(tab, person, [5, 2.5], "outline_fixture");
  await notice(tab, "Choose a preset first");
  await tab.choose("tool/Preset", "gondola 1.00 m, double, 1.6 m high");
  await tab.press("Escape");
  await use(tab, person, [5, 2.5], "outline_fixture");
  await tab.steps(5);
  const gondola = tab.json.fixtures[2];
  equal([gondola.preset, gondola.length, gondola.depth], ["gondola 1.00 m, double, 1.6 m high", 6, 1]);
  equal(
    gondola.at.map((value) => Number(value.toFixed(3))),
    [2, 2],
  );
  await tab.picture("dxf-taken");
});

testPlanner("dxf: the inner edges of wide walls become the room", { store: null, keeps: true }, async (tab) => {
  await opened(tab, "wide.dxf", readFileSync(new URL("../../data/field4/wide_walls.dxf", import.meta.url)));
  const { size, origin } = tab.json.drawing;
  const person = new Tracer(tab, ([x, y]) => [1000 * x - origin[0], size[1] - (1000 * y - origin[1])]);
  await use(tab, person, [7, 3], "outline_room");
  await tab.steps(2);
  const sides = tab.json.room.size.slice(0, 2).map((side) => Number(side.toFixed(3)));
  equal(sides, [19.7, 13.7]);
});

testPlanner(
  "dxf: layers are switched one by one, and attract only while they are shown",
  { store: null, keeps: true },
  async (tab) => {
    await opened(tab, "shop.dxf", shopDxf());
    const pixel = pixelIn(tab.json.drawing);
    const red = async () => {
      const [x, y] = await pixelAt(tab, ...pixel([4.8, 5]));
      const found = await Promise.all([-1, 0, 1].map((dx) => colourAt(tab, [x + dx, y])));
      return found.some(([r, g]) => r > 200 && g < 180);
    };
    const settled = () => new Promise((done) => setTimeout(done, 600));
    const snapped = async () => {
      await tab.press("m");
      const [x, y] = await pixelAt(tab, ...pixel([4.8, 4.8]));
      await tab.page.mouse.move(x - 3, y + 2);
      await tab.settle();
      const kind = await tab.page.evaluate(() => window.shelfbeamPlanner.page.gestures.scope.to.kind);
      await tab.press("Escape");
      return kind;
    };
    await settled();
    check(await red(), "columns are drawn");
    equal(await snapped(), "end");
    await tab.push('[data-key="picture/layer/COLUMNS"]');
    await settled();
    check(!(await red()), "columns are not drawn");
    equal(await snapped(), null);
    await tab.page.reload();
    await tab.until(() => window.shelfbeamPlanner?.planner.picture.state.kind === "shown");
    await settled();
    check(!(await red()), "the browser remembers the layers");
  },
);

testPlanner(
  "dxf: wrong units are doubted, and files are refused by name",
  { store: null, keeps: true },
  async (tab) => {
    await drop(tab, "shop.dxf", shopDxf({ header: 6 })); // metres
    await dialog(tab);
    says(await tab.text(".dialog .problem"), "The file itself says metres.");
    equal(await tab.page.evaluate(() => document.querySelector('[data-key="unit-choice"]').value), "mm");
    await tab.press("Escape");
    await tab.steps(0);
    const whole = shopDxf();
    for (const [body, words] of [
      [
        Buffer.from("AutoCAD Binary DXF\r\n\x1a\0"),
        "plan.dxf: The file is a binary DXF file. Save it as DXF in text form",
      ],
      [Buffer.from("AC1032\0\0"), "plan.dxf: The file is a DWG file (AC1032). Save it as DXF"],
      [whole.subarray(0, 900), "plan.dxf: The file ends early, at line"],
      [
        Buffer.from("  0\nSECTION\n  2\nENTITIES\n  0\nENDSEC\n  0\nEOF\n"),
        "plan.dxf: Model space has neither lines nor texts; paper space has 0 objects",
      ],
      [
        Buffer.from("  0\nSECTION\n  2\nENTITIES\n  0\nAEC_WALL\n  8\nWALLS\n  0\nENDSEC\n  0\nEOF\n"),
        "plan.dxf: Model space has no object that the planner shows. Not shown: objects of AutoCAD Architecture (AEC_WALL): 1.",
      ],
      [
        Buffer.from(whole.toString("latin1").replace("\n100\nAcDbEntity", "\nhundred\nAcDbEntity"), "latin1"),
        "is not a group code",
      ],
    ]) {
      await drop(tab, "plan.dxf", body);
      await notice(tab, words);
    }
    equal(tab.json.drawing, undefined);
    const bound = shopDxf({ more: ["  0\n3DSOLID\n  8\nWALLS", "  0\nREGION\n  8\nWALLS"] });
    await drop(tab, "solid.dxf", bound);
    await dialog(tab);
    await tab.push(".dialog summary");
    says(await tab.text(".dialog .notes"), "Not shown: solids, surfaces or meshes (3DSOLID): 1");
    await tab.press("Escape");
    await drop(tab, "inches.dxf", readFileSync(new URL("../../data/field4/inches_in_name_only.dxf", import.meta.url)));
    await dialog(tab);
    says(
      await tab.text(".dialog .problem"),
      "it says inches ($INSUNITS), which would make 50.8 m × 35.6 m, but metric",
    );
    equal(await tab.page.evaluate(() => document.querySelector('[data-key="unit-choice"]').value), "cm");
    await tab.press("Escape");
  },
);
