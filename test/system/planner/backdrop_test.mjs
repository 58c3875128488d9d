// Tests the picture of the floor plan.

import { readFileSync } from "node:fs";

import { check, equal, near, says } from "../viewer/check.mjs";
import { clickPixel, colourAt, drop, pasteFile, pixelAt, serveFiles, shown, wallsOf } from "./floor_plan.mjs";
import { testPlanner } from "./opened.mjs";

const plan = wallsOf(1200, 800);
const field = (name) => readFileSync(new URL(`../../data/field4/${name}`, import.meta.url));

const scopeOf = (tab) => tab.page.evaluate(() => document.querySelector(".surface").dataset.scope);
const toolOf = (tab) => tab.page.evaluate(() => document.querySelector(".plan").dataset.tool);
const chip = (tab) => tab.page.evaluate(() => document.querySelector(".scale-state:not([hidden])")?.textContent ?? "");
const notice = async (tab, ...parts) => {
  await tab.until(
    (words) => document.querySelector(".notice").textContent.replaceAll("\u00a0", " ").includes(words),
    parts[0],
  );
  says(await tab.text(".notice"), ...parts);
};

/** Runs a command of the list of commands. */
async function run(tab, name) {
  await tab.press("Control+k");
  await tab.page.keyboard.type(name);
  await tab.until((of) => document.querySelector(".results li span")?.textContent === of, name);
  await tab.press("Enter");
}

/** A tab with a picture and without a tool. */
async function withPicture(tab) {
  const files = await serveFiles(tab);
  await drop(tab, "plan.png", plan);
  await tab.steps(1);
  await shown(tab);
  await tab.press("Escape");
  equal(await toolOf(tab), "select");
  return files;
}

const numbers = (values, decimals) => values.map((value) => Number(value.toFixed(decimals)));

testPlanner("picture: dropped, scaled and checked", { smoke: true }, async (tab) => {
  const files = await serveFiles(tab);
  const isTarget = () => tab.page.evaluate(() => !document.querySelector(".drop").hidden);
  await drop(tab, "My plan.png", plan, async () => check(await isTarget(), "the drop target is visible"));
  check(!(await isTarget()), "the drop target is gone");
  await tab.steps(1);
  await shown(tab);
  check(files.get("My-plan.png").equals(plan), "the bytes have arrived");
  equal(tab.json.drawing, { file: "My-plan.png", size: [1200, 800], at: [0, 0] });
  equal([await toolOf(tab), await chip(tab)], ["scale", "No scale"]);
  says(await tab.text(".hint"), "Click both ends of a long wall");
  await clickPixel(tab, 22, 400);
  await tab.page.mouse.move(...(await pixelAt(tab, 600, 400)));
  await tab.settle();
  check(await tab.page.evaluate(() => !document.querySelector(".loupe").hidden), "the loupe is there");
  await clickPixel(tab, 1178, 402);
  equal(await tab.page.evaluate(() => document.activeElement.id), "line-length");
  await tab.page.keyboard.type("twenty");
  await tab.press("Enter");
  says(await tab.text(".length-field .why"), "Not a length");
  await tab.page.keyboard.press("Control+a");
  await tab.page.keyboard.type("2*11.56");
  await tab.press("Enter");
  await tab.steps(2);
  const { scale, rotation_deg } = tab.json.drawing;
  near(scale.length, 23.12, 1e-9, "length");
  near(scale.to[0] - scale.from[0], 1156, 0.003, "line");
  check(rotation_deg > 0.02 && rotation_deg < 0.2, `straightened by ${rotation_deg}`);
  equal(await tab.labels(), ["Add the floor plan", "Set the scale"]);
  equal([await toolOf(tab), await chip(tab)], ["check", "Scale not checked"]);
  says(await tab.text(".overlay .reading"), "23.12 m");
  await clickPixel(tab, 100, 30);
  await clickPixel(tab, 1100, 30);
  await notice(tab, "at least 30° from the first");
  equal(await tab.page.evaluate(() => document.querySelector(".length-field").hidden), true);
  await clickPixel(tab, 100, 30);
  await clickPixel(tab, 100, 780);
  await tab.page.keyboard.type("14m");
  await tab.press("Enter");
  await tab.steps(3);
  await notice(tab, "The picture is stretched by 7.", "instead of 14.00 m");
  equal([await toolOf(tab), await chip(tab)], ["select", "Scale not checked"]);
  await tab.push(".scale-state");
  equal(await toolOf(tab), "check");
  await clickPixel(tab, 22, 22);
  await clickPixel(tab, 22, 778);
  await tab.page.keyboard.type("1512cm");
  await tab.press("Enter");
  await tab.steps(4);
  await notice(tab, "The check agrees with the scale within 0.");
  equal(await chip(tab), "");
});

testPlanner("picture: it lies where its numbers say", {}, async (tab) => {
  await withPicture(tab);
  const [dark, light] = [await pixelAt(tab, 23, 400), await pixelAt(tab, 60, 400)];
  check((await colourAt(tab, dark))[0] < 120, `a wall is dark: ${await colourAt(tab, dark)}`);
  equal((await colourAt(tab, light)).slice(0, 3), [255, 255, 255]);
  await run(tab, "Rotate the floor plan by 90°");
  await tab.steps(2);
  equal(tab.json.drawing.rotation_deg, 90);
  const turned = await pixelAt(tab, 23, 400);
  check(Math.hypot(turned[0] - dark[0], turned[1] - dark[1]) > 50, "the wall is elsewhere");
  check((await colourAt(tab, turned))[0] < 120, `a wall is dark: ${await colourAt(tab, turned)}`);
  await run(tab, "Crop the floor plan");
  const [from, to] = [await pixelAt(tab, 300, 200), await pixelAt(tab, 900, 600)];
  await tab.dragPixels(from, to);
  await tab.steps(3);
  check(
    tab.json.drawing.crop.every((value, k) => Math.abs(value - [300, 200, 900, 600][k]) <= 2),
    JSON.stringify(tab.json.drawing.crop),
  );
  equal((await colourAt(tab, await pixelAt(tab, 23, 400)))[3], 0, "opacity outside of the crop");
  equal((await colourAt(tab, await pixelAt(tab, 600, 400)))[3], 255, "opacity inside");
  equal(await toolOf(tab), "select");
});

testPlanner("picture: Esc and Ctrl+Z in the middle of each gesture", {}, async (tab) => {
  await withPicture(tab);
  for (const key of ["Escape", "Control+z"]) {
    await tab.press("s");
    await clickPixel(tab, 22, 400);
    await tab.press(key);
    equal([await toolOf(tab), await scopeOf(tab)], ["scale", "scaling"], "the tool stays");
    equal(await tab.page.evaluate(() => window.shelfbeamPlanner.page.gestures.scope.from), null);
    await clickPixel(tab, 22, 400);
    await clickPixel(tab, 622, 400);
    await tab.press(key);
    equal(await tab.page.evaluate(() => document.querySelector(".length-field").hidden), true, "field");
    equal(await tab.page.evaluate(() => document.activeElement.className), "surface", "focus");
    await tab.press("Escape");
    equal(await toolOf(tab), "select");
    await run(tab, "Crop the floor plan");
    const [from, to] = [await pixelAt(tab, 300, 200), await pixelAt(tab, 900, 600)];
    await tab.dragPixels(from, to, { during: () => tab.press(key) });
    equal(await toolOf(tab), "crop");
    await tab.press("Escape");
    equal(await toolOf(tab), "select");
    await tab.page.evaluate(() => window.shelfbeamPlanner.planner.look.set({ isLocked: false }));
    const [a, b] = [await pixelAt(tab, 162, 428), await pixelAt(tab, 262, 528)];
    await tab.dragPixels(a, b, {
      during: async () => {
        equal(await scopeOf(tab), "shifting");
        await tab.press(key);
      },
    });
    equal(await pixelAt(tab, 162, 428), a, "the picture is back");
  }
  await tab.steps(1);
  equal(tab.json.drawing, { file: "plan.png", size: [1200, 800], at: [0, 0] });
});

testPlanner("picture: locked it is never touched, free it moves", {}, async (tab) => {
  await withPicture(tab);
  const [from, to] = [await tab.at(2.7, 6.2), await tab.at(4.7, 7.2)];
  await tab.dragPixels(from, to, { during: async () => equal(await scopeOf(tab), "marquee") });
  await tab.press("Escape");
  await tab.steps(1);
  await run(tab, "Lock or free the floor plan");
  await tab.dragPixels(from, to);
  await tab.steps(2);
  const { at } = tab.json.drawing;
  check(Math.abs(at[0] - 2) <= 0.06 && Math.abs(at[1] - 1) <= 0.06, `moved to ${at}`);
  equal(numbers(at, 2), at, "whole centimetres");
  await tab.dragPixels(await tab.at(10, 9.85), await tab.at(11, 9.85));
  await tab.steps(3);
  equal((await tab.labels()).at(-1), "Move A3", "elements come first");
});

testPlanner("picture: another file replaces it, or starts anew", {}, async (tab) => {
  await withPicture(tab);
  await tab.press("s");
  await clickPixel(tab, 22, 400);
  await clickPixel(tab, 1178, 400);
  await tab.page.keyboard.type("23.12");
  await tab.press("Enter", "Escape");
  await tab.steps(2);
  const { scale, at } = tab.json.drawing;
  await drop(tab, "large.png", wallsOf(2400, 1600));
  await tab.page.click(".question button:not(.close)");
  await tab.steps(3);
  await shown(tab);
  const replaced = tab.json.drawing;
  equal([replaced.file, replaced.size, replaced.at], ["large.png", [2400, 1600], at]);
  equal(
    numbers(replaced.scale.from, 1),
    numbers(
      scale.from.map((value) => 2 * value),
      1,
    ),
  );
  await pasteFile(tab, "image.png", wallsOf(600, 400));
  await tab.press("Escape");
  equal(await tab.page.$("dialog[open]"), null, "Esc keeps the picture");
  await tab.steps(3);
  await pasteFile(tab, "image.png", wallsOf(600, 400));
  await tab.page.click(".question p:last-child button");
  await tab.steps(4);
  equal(tab.json.drawing, { file: "image.png", size: [600, 400], at: [0, 0] });
  equal(await toolOf(tab), "scale");
  await tab.press("Escape");
});

testPlanner("picture: a scale stays per pixel, and is unchecked with another size", { keeps: true }, async (tab) => {
  const files = await serveFiles(tab);
  const replace = async (name, body, steps) => {
    await drop(tab, name, body);
    await tab.page.click(".question button:not(.close)");
    await tab.steps(steps);
    await shown(tab);
  };
  const step = ({ from, to, length }) => length / Math.hypot(to[0] - from[0], to[1] - from[1]);
  await drop(tab, "plan_800.png", field("plan_800.png"));
  await tab.steps(1);
  await shown(tab);
  for (const [to, length, steps] of [
    [[700, 550], "12", 2],
    [[100, 50], "10", 3],
  ]) {
    await clickPixel(tab, 100, 550);
    await clickPixel(tab, ...to);
    await tab.page.keyboard.type(length);
    await tab.press("Enter");
    await tab.steps(steps);
  }
  const { drawing } = tab.json;
  near(step(drawing.scale), 0.02, 1e-4, "m per pixel");
  equal(await chip(tab), "");
  await replace("same.png", field("plan_800.png"), 4);
  equal([await chip(tab), tab.json.drawing.check], ["", drawing.check], "a version of the same size");
  await replace("plan_title_block.png", field("plan_title_block.png"), 5);
  await notice(tab, "plan_title_block.png takes the place", "check the scale again");
  equal([await chip(tab), tab.json.drawing.check], ["Scale not checked", undefined]);
  near(step(tab.json.drawing.scale), step(drawing.scale), 1e-9, "m per pixel");
  equal([tab.json.drawing.size, tab.json.drawing.at], [[1100, 600], drawing.at]);
  await tab.press("Escape", "Control+z");
  await tab.steps(4);
  equal(await chip(tab), "", "the old version with its check");
  // A file that changes in the folder is not stretched to the old size.
  files.set("same.png", field("plan_title_block.png"));
  await tab.page.reload();
  await tab.until(() => window.shelfbeamPlanner?.planner.picture.state.kind === "failed");
  await tab.settle();
  equal(await chip(tab), "Floor plan not shown");
  await tab.push(".scale-state");
  says(await tab.text(".properties .problem"), "same.png has changed: its size is now 1100 × 600 instead of 800 × 600");
  await replace("same.png", field("plan_title_block.png"), 5);
  equal([await chip(tab), tab.json.drawing.size], ["Scale not checked", [1100, 600]]);
});

testPlanner("picture: almost square ones keep their sides", {}, async (tab) => {
  for (const name of ["near_square.png", "camera_square.jpg"]) {
    await drop(tab, name, field(name));
    await tab.steps(1);
    await shown(tab);
    equal(tab.json.drawing.size, [1000, 998], name);
    await tab.press("Escape", "Control+z");
    await tab.steps(0);
  }
});

testPlanner("picture: wrong files are refused with a reason", {}, async (tab) => {
  const sentence = "plan.png has more than 100 megapixels; export it smaller.";
  await serveFiles(tab, { status: 413, contentType: "text/plain", body: sentence });
  await drop(tab, "plan.dwg", Buffer.from("AC1032"));
  await notice(tab, "plan.dwg: The file is a DWG file");
  await drop(tab, "plan.gif", Buffer.from("GIF89a"));
  await notice(tab, "plan.gif is a picture of another format (GIF)");
  await drop(tab, "plan.ifc", field("plan.ifc"));
  await notice(tab, "plan.ifc is a model (IFC)", "as DXF or PDF");
  equal(await tab.page.$("dialog[open]"), null, "no dialog for labels");
  await drop(tab, "plan.png", plan);
  await notice(tab, sentence);
  check(await tab.isUntouched(), "the store is untouched");
  tab.errors.length = 0; // of the refused file
});

testPlanner("picture: bad images get a clear answer, and everything stays alive", {}, async (tab) => {
  const huge = Buffer.from(plan);
  huge.writeUInt32BE(60000, 16);
  huge.writeUInt32BE(60000, 20);
  await drop(tab, "huge.png", huge);
  await notice(tab, "60000 x 60000 pixels");
  await drop(tab, "short.png", plan.subarray(0, Math.floor(0.4 * plan.length)));
  await notice(tab, "short.png: is incomplete or damaged; export it again");
  await drop(tab, "header.png", plan.subarray(0, 20));
  await notice(tab, "header.png: is incomplete or damaged");
  await drop(tab, "words.jpg", Buffer.from("A letter, not a picture"));
  await notice(tab, "words.jpg is of no format that the planner reads.");
  check(await tab.isUntouched(), "the store is untouched");
  tab.errors.length = 0; // of refused files
  // The content decides, not the name.
  await drop(tab, "really-png.jpg", plan);
  await tab.steps(1);
  equal(tab.json.drawing.file, "really-png.png");
  await shown(tab);
  await tab.press("Escape");
});

testPlanner("picture: its panel", {}, async (tab, given) => {
  await withPicture(tab);
  await run(tab, "Properties of the floor plan");
  equal(await tab.text(".properties h2"), "plan.png");
  await tab.fill("picture/at/0", "-1.5");
  await tab.steps(2);
  await tab.fill("picture/turn", "-2.5");
  await tab.steps(3);
  equal(tab.json.drawing.rotation_deg, -2.5);
  await tab.fill("picture/crop", "100, 50, 1100, 750");
  await tab.steps(4);
  equal(tab.json.drawing.crop, [100, 50, 1100, 750]);
  await tab.fill("picture/crop", "");
  await tab.steps(5);
  equal(tab.json.drawing.crop, undefined);
  await tab.push('[data-key="turn_picture_back"]');
  await tab.steps(6);
  equal(tab.json.drawing.rotation_deg, -92.5);
  await tab.push('.properties [data-key="scale"]');
  await clickPixel(tab, 300, 400);
  await clickPixel(tab, 900, 400);
  equal(await tab.page.evaluate(() => document.querySelector(".straight input").checked), true);
  await tab.page.keyboard.type("12");
  await tab.press("Enter", "Escape");
  await tab.steps(7);
  near(tab.json.drawing.rotation_deg, -90, 1e-3, "straight");
  check((await tab.page.$(".overlay .measure")) !== null, "the line is visible while the panel is open");
  await tab.fill("picture/scale", "6");
  await tab.steps(8);
  equal(tab.json.drawing.scale.length, 6);
  await tab.fill("picture/scale", "0");
  says(await tab.text(".properties"), "greater than 0");
  await tab.press("Escape");
  await tab.push('[data-key="picture/isGrey"]');
  await tab.page.focus('[data-key="picture/fade"]');
  await tab.press("ArrowRight", "ArrowRight");
  const look = (of) =>
    of.page.evaluate(() => {
      const canvas = document.querySelector(".backdrop");
      return [canvas.className, canvas.style.opacity, canvas.hidden];
    });
  equal(await look(tab), ["backdrop grey", "0.6", false]);
  await tab.page.reload();
  await shown(tab);
  await tab.settle();
  equal(await look(tab), ["backdrop grey", "0.6", false], "the browser remembers the look");
  await tab.push("#tab-layers");
  await tab.push('[data-key="show-picture"]');
  equal((await look(tab))[2], true, "hidden");
  await tab.push('[data-key="show-picture"]');
  await tab.push('[data-key="open-picture"]');
  await tab.push('[data-key="remove_picture"]');
  await tab.steps(9);
  equal([tab.json.drawing, await chip(tab)], [undefined, ""]);
  await tab.press("Control+z");
  await tab.steps(8);
  await shown(tab);
  const other = await given.tab(tab.server);
  equal(await chip(other), "Scale not checked");
  other.errors.length = 0; // its browser has no files
});

testPlanner("picture: all by keys", {}, async (tab) => {
  await serveFiles(tab);
  const chooser = tab.page.waitForEvent("filechooser");
  await run(tab, "Choose a floor plan …");
  await (await chooser).setFiles({ name: "plan.png", mimeType: "image/png", buffer: plan });
  await tab.steps(1);
  await shown(tab);
  await tab.press("ArrowRight", "Shift+ArrowUp", "Enter");
  const first = await tab.page.evaluate(() => window.shelfbeamPlanner.page.gestures.scope.from);
  for (let k = 0; k < 30; ++k) await tab.page.keyboard.press("Shift+ArrowLeft");
  await tab.press("ArrowDown", "Enter");
  await tab.page.keyboard.type("6ft");
  await tab.press("Enter");
  await tab.steps(2);
  const { scale } = tab.json.drawing;
  equal(numbers([scale.to[0] - scale.from[0], scale.to[1] - scale.from[1]], 2), [-300, 1]);
  equal([scale.from, scale.length], [first, 1.8288]);
  await tab.press("Escape");
});

testPlanner("picture: a missing file is named", { keeps: true }, async (tab) => {
  const files = await withPicture(tab);
  files.clear();
  await tab.page.reload();
  await tab.until(() => window.shelfbeamPlanner.planner.picture.state.kind === "failed");
  await run(tab, "Properties of the floor plan");
  says(await tab.text(".properties .problem"), "plan.png is missing from the folder of the project");
  tab.errors.length = 0; // of the missing file
});

for (const dark of [false, true])
  testPlanner(`picture: axe has no findings, ${dark ? "dark" : "light"}`, { dark }, async (tab, { axe }) => {
    await withPicture(tab);
    const clean = async (what) => {
      await tab.page.evaluate(axe);
      const found = await tab.page.evaluate(async () => {
        const { violations } = await window.axe.run(document, { resultTypes: ["violations"] });
        return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target).join("; ")}`);
      });
      equal(found, [], what);
    };
    await run(tab, "Properties of the floor plan");
    await tab.push("#tab-layers");
    await clean("panel");
    await tab.picture(`picture-panel-${dark}`);
    await tab.press("s");
    await clickPixel(tab, 22, 400);
    await clickPixel(tab, 1178, 400);
    await tab.press("Enter");
    await clean("field with an error");
    await tab.press("Escape", "Escape");
    await drop(tab, "other.png", plan, () => clean("drop target"));
    await clean("question");
    await tab.press("Escape");
  });
