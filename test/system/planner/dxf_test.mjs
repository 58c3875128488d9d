// Tests floor plans from DXF files.

import { readFileSync } from "node:fs";

import { columns, outline } from "../../data/drawn_shop.mjs";
import { pixelIn, shopDxf } from "../../data/shop_dxf.mjs";
import { check, equal, says } from "../viewer/check.mjs";
import { colourAt, drop, pixelAt, shown } from "./floor_plan.mjs";
import { inEmptyShop, testPlanner } from "./opened.mjs";
import { poll } from "./poll.mjs";
import { farthest, linesOf, traceRoom } from "./traced_shop.mjs";
import { Tracer } from "./tracer.mjs";

const proposed = (tab) => tab.evaluate(() => document.querySelector('[data-key="unit-choice"]').value);

/** Drops a drawing; the question for its unit is there. */
async function ask(tab, name, body) {
  await drop(tab, name, body);
  await tab.until(() => document.querySelector(".dialog.unit") !== null);
}

async function take(tab, name, body) {
  await ask(tab, name, body);
  await tab.use("unit-take");
  await tab.steps(1);
  await shown(tab);
  await linesOf(tab);
}

testPlanner("dxf: an L-shaped shop with a slanted wall, by snapping", { ...inEmptyShop, smoke: true }, async (tab) => {
  await ask(tab, "Shop.dxf", shopDxf());
  says(await tab.text(".dialog h2"), "In which unit is Shop.dxf?");
  says(await tab.text(".dialog p"), "The file says millimetres.");
  await tab.picture("dxf-unit");
  await tab.press("Enter");
  await tab.steps(1);
  await shown(tab);
  await linesOf(tab);
  const { drawing } = tab.json;
  equal([drawing.file, drawing.unit], ["Shop.dxf", "mm"]);
  check(await tab.has(".scale-state[hidden]"), "the unit is the scale");
  await traceRoom(new Tracer(tab, pixelIn(drawing)));
  await tab.picture("dxf-traced");
});

testPlanner("dxf: outlines become the room, columns, zones and fixtures", inEmptyShop, async (tab) => {
  await take(tab, "shop.dxf", shopDxf());
  const person = new Tracer(tab, pixelIn(tab.json.drawing));
  /** A click on a command of the menu at a place of the shop. */
  const use = async (point, command) => {
    await person.look(point, 40);
    await tab.page.mouse.click(...(await pixelAt(tab, ...person.pixelOf(point))), { button: "right" });
    await tab.settle();
    await tab.push(`.menu [data-command="${command}"]`);
  };
  await use([1, 1], "outline_room");
  await tab.steps(2);
  equal((await tab.labels())[1], "Use an outline as the room");
  const off = farthest(tab.json.room.outline, outline);
  check(off < 0.001, `the room is ${off} m off`);
  person.pixelOf = pixelIn(tab.json.drawing);
  await use([4, 12], "outline_zone");
  await tab.steps(3);
  equal(tab.json.room.zones.length, 1);
  // All columns of a layer at once.
  await tab.press("Escape");
  await tab.run("Properties of the floor plan");
  equal(await tab.text('[data-key="picture/outlines/COLUMNS"]'), "2 outlines …");
  await tab.use("picture/outlines/COLUMNS");
  check(!(await tab.has('.menu [data-command="outline_room"]')), "two outlines are no room");
  await tab.push('.menu [data-command="outline_column"]');
  await tab.steps(4);
  const { fixtures } = tab.json;
  equal(
    fixtures.map(({ id, top }) => `${id} ${top}`),
    ["C1 ceiling", "C2 ceiling"],
  );
  columns.forEach((column, k) => check(farthest(fixtures[k].polygon, column) < 0.001, `column ${k}`));
  // A fixture needs a preset.
  await use([5, 2.5], "outline_fixture");
  await tab.notice("Choose a preset first");
  await tab.choose("tool/Preset", "gondola 1.00 m, double, 1.6 m high");
  await tab.press("Escape");
  await use([5, 2.5], "outline_fixture");
  await tab.steps(5);
  const gondola = tab.json.fixtures[2];
  equal([gondola.preset, gondola.length, gondola.depth], ["gondola 1.00 m, double, 1.6 m high", 6, 1]);
  equal(
    gondola.at.map((value) => Number(value.toFixed(3))),
    [2, 2],
  );
  await tab.picture("dxf-taken");
});

testPlanner("dxf: layers are switched one by one, and attract only while they are shown", inEmptyShop, async (tab) => {
  await take(tab, "shop.dxf", shopDxf());
  const pixel = pixelIn(tab.json.drawing);
  const red = async () => {
    const [x, y] = await pixelAt(tab, ...pixel([4.8, 5]));
    const found = await Promise.all([-1, 0, 1].map((dx) => colourAt(tab, [x + dx, y])));
    return found.some(([r, g]) => r > 200 && g < 180);
  };
  /** Until the column is red, or is not, in the detailed drawing. */
  const turns = async (isRed) => {
    await tab.reaches(({ planner }) => planner.picture.state.page?.detail.now);
    await poll(
      red,
      (is) => is === isRed,
      () => `the column turns ${isRed ? "" : "not "}red`,
    );
  };
  const snapped = async () => {
    await tab.press("m");
    const [x, y] = await pixelAt(tab, ...pixel([4.8, 4.8]));
    await tab.page.mouse.move(x - 3, y + 2);
    await tab.settle();
    const { kind } = (await tab.scope()).to;
    await tab.press("Escape");
    return kind;
  };
  await turns(true);
  equal(await snapped(), "end");
  await tab.use("picture/layer/COLUMNS");
  await turns(false);
  equal(await snapped(), null);
  await tab.reload();
  await shown(tab);
  await turns(false); // the browser remembers the layers
});

testPlanner("dxf: wrong units are doubted, and files are refused by name", inEmptyShop, async (tab) => {
  await ask(tab, "shop.dxf", shopDxf({ header: 6 })); // metres
  says(await tab.text(".dialog .problem"), "The file itself says metres.");
  equal(await proposed(tab), "mm");
  await tab.press("Escape");
  await tab.steps(0);
  for (const [body, words] of [
    [shopDxf().subarray(0, 900), "plan.dxf: The file ends early, at line"],
    [
      Buffer.from("  0\nSECTION\n  2\nENTITIES\n  0\nAEC_WALL\n  8\nWALLS\n  0\nENDSEC\n  0\nEOF\n"),
      "plan.dxf: Model space has no object that the planner shows. Not shown: objects of AutoCAD Architecture (AEC_WALL): 1.",
    ],
  ]) {
    await drop(tab, "plan.dxf", body);
    await tab.notice(words);
  }
  equal(tab.json.drawing, undefined);
  await ask(tab, "solid.dxf", shopDxf({ more: ["  0\n3DSOLID\n  8\nWALLS", "  0\nREGION\n  8\nWALLS"] }));
  await tab.push(".dialog summary");
  says(await tab.text(".dialog .notes"), "Not shown: solids, surfaces or meshes (3DSOLID): 1");
  await tab.press("Escape");
  await ask(tab, "inches.dxf", readFileSync(new URL("../../data/field4/inches_in_name_only.dxf", import.meta.url)));
  says(await tab.text(".dialog .problem"), "it says inches ($INSUNITS), which would make 50.8 m × 35.6 m, but metric");
  equal(await proposed(tab), "cm");
  await tab.press("Escape");
});
