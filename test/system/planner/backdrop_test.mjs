// Tests the picture of the floor plan.

import { readFileSync } from "node:fs";

import { check, equal, near, says } from "../viewer/check.mjs";
import { clickPixel, colourAt, drop, pasteFile, pixelAt, serveFiles, shown, wallsOf } from "./floor_plan.mjs";
import { testAxe, testPlanner } from "./opened.mjs";

const plan = wallsOf(1200, 800);
const field = (name) => readFileSync(new URL(`../../data/field4/${name}`, import.meta.url));

const scopeOf = (tab) => tab.evaluate(() => document.querySelector(".surface").dataset.scope);
const chip = (tab) => tab.evaluate(() => document.querySelector(".scale-state:not([hidden])")?.textContent ?? "");
const hidden = (tab, selector) => tab.evaluate((of) => document.querySelector(of).hidden, selector);
const firstEnd = (tab) => tab.state(({ page }) => page.gestures.scope.from);

/** A tab with a picture and without a tool. */
async function withPicture(tab) {
  const files = await serveFiles(tab);
  await drop(tab, "plan.png", plan);
  await tab.steps(1);
  await shown(tab);
  await tab.press("Escape");
  equal(await tab.tool(), "select");
  return files;
}

/** Draws a line between two pixels, and types its length. */
async function drawLine(tab, from, to, length) {
  await clickPixel(tab, ...from);
  await clickPixel(tab, ...to);
  await tab.page.keyboard.type(length);
  await tab.press("Enter");
}

/** Drops a file, and answers that it takes the place of the picture. */
async function replace(tab, name, body, steps) {
  await drop(tab, name, body);
  await tab.push(".question button:not(.close)");
  await tab.steps(steps);
  await shown(tab);
}

const numbers = (values, decimals) => values.map((value) => Number(value.toFixed(decimals)));

testPlanner("picture: dropped, scaled and checked", { smoke: true }, async (tab) => {
  const files = await serveFiles(tab);
  await drop(tab, "My plan.png", plan, async () => check(!(await hidden(tab, ".drop")), "the drop target is visible"));
  check(await hidden(tab, ".drop"), "the drop target is gone");
  await tab.steps(1);
  await shown(tab);
  check(files.get("My-plan.png").equals(plan), "the bytes have arrived");
  equal(tab.json.drawing, { file: "My-plan.png", size: [1200, 800], at: [0, 0] });
  equal([await tab.tool(), await chip(tab)], ["scale", "No scale"]);
  says(await tab.text(".hint"), "Click both ends of a long wall");
  await clickPixel(tab, 22, 400);
  await tab.page.mouse.move(...(await pixelAt(tab, 600, 400)));
  await tab.settle();
  check(!(await hidden(tab, ".loupe")), "the loupe is there");
  await clickPixel(tab, 1178, 402);
  equal(await tab.focused(), "line-length");
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
  equal([await tab.tool(), await chip(tab)], ["check", "Scale not checked"]);
  says(await tab.text(".overlay .reading"), "23.12 m");
  await clickPixel(tab, 100, 30);
  await clickPixel(tab, 1100, 30);
  await tab.notice("at least 30° from the first");
  check(await hidden(tab, ".length-field"), "no field for a length");
  await drawLine(tab, [100, 30], [100, 780], "14m");
  await tab.steps(3);
  await tab.notice("The picture is stretched by 7.");
  says(await tab.text(".notice"), "instead of 14.00 m");
  equal([await tab.tool(), await chip(tab)], ["select", "Scale not checked"]);
  await tab.push(".scale-state");
  equal(await tab.tool(), "check");
  await drawLine(tab, [22, 22], [22, 778], "1512cm");
  await tab.steps(4);
  await tab.notice("The check agrees with the scale within 0.");
  equal(await chip(tab), "");
});

testPlanner("picture: it lies where its numbers say", {}, async (tab) => {
  await withPicture(tab);
  const isDark = async (place) => check((await colourAt(tab, place))[0] < 120, `a wall at ${place} is dark`);
  const dark = await pixelAt(tab, 23, 400);
  await isDark(dark);
  equal((await colourAt(tab, await pixelAt(tab, 60, 400))).slice(0, 3), [255, 255, 255]);
  await tab.run("Rotate the floor plan by 90°");
  await tab.steps(2);
  equal(tab.json.drawing.rotation_deg, 90);
  const turned = await pixelAt(tab, 23, 400);
  check(Math.hypot(turned[0] - dark[0], turned[1] - dark[1]) > 50, "the wall is elsewhere");
  await isDark(turned);
  await tab.run("Crop the floor plan");
  await tab.dragPixels(await pixelAt(tab, 300, 200), await pixelAt(tab, 900, 600));
  await tab.steps(3);
  const { crop } = tab.json.drawing;
  check(
    crop.every((value, k) => Math.abs(value - [300, 200, 900, 600][k]) <= 2),
    `${crop}`,
  );
  equal((await colourAt(tab, await pixelAt(tab, 23, 400)))[3], 0, "opacity outside of the crop");
  equal((await colourAt(tab, await pixelAt(tab, 600, 400)))[3], 255, "opacity inside");
  equal(await tab.tool(), "select");
});

testPlanner("picture: Esc and Ctrl+Z in the middle of each gesture", {}, async (tab) => {
  await withPicture(tab);
  for (const key of ["Escape", "Control+z"]) {
    await tab.press("s");
    await clickPixel(tab, 22, 400);
    await tab.press(key);
    equal([await tab.tool(), await scopeOf(tab)], ["scale", "scaling"], "the tool stays");
    equal(await firstEnd(tab), null);
    await clickPixel(tab, 22, 400);
    await clickPixel(tab, 622, 400);
    await tab.press(key);
    check(await hidden(tab, ".length-field"), "the field is gone");
    equal(await tab.focused(), "surface");
    await tab.press("Escape");
    equal(await tab.tool(), "select");
    await tab.run("Crop the floor plan");
    const corners = [await pixelAt(tab, 300, 200), await pixelAt(tab, 900, 600)];
    await tab.dragPixels(...corners, { during: () => tab.press(key) });
    equal(await tab.tool(), "crop");
    await tab.press("Escape");
    equal(await tab.tool(), "select");
    await tab.state(({ planner }) => planner.look.set({ isLocked: false }));
    const [from, to] = [await pixelAt(tab, 162, 428), await pixelAt(tab, 262, 528)];
    await tab.dragPixels(from, to, {
      during: async () => {
        equal(await scopeOf(tab), "shifting");
        await tab.press(key);
      },
    });
    equal(await pixelAt(tab, 162, 428), from, "the picture is back");
  }
  await tab.steps(1);
  equal(tab.json.drawing, { file: "plan.png", size: [1200, 800], at: [0, 0] });
});

testPlanner("picture: locked it is never touched, free it moves", {}, async (tab) => {
  await withPicture(tab);
  const places = [await tab.at(2.7, 6.2), await tab.at(4.7, 7.2)];
  await tab.dragPixels(...places, { during: async () => equal(await scopeOf(tab), "marquee") });
  await tab.press("Escape");
  await tab.steps(1);
  await tab.run("Lock or free the floor plan");
  await tab.dragPixels(...places);
  await tab.steps(2);
  const { at } = tab.json.drawing;
  check(Math.abs(at[0] - 2) <= 0.06 && Math.abs(at[1] - 1) <= 0.06, `moved to ${at}`);
  equal(numbers(at, 2), at, "whole centimetres");
  await tab.drag([10, 9.85], [11, 9.85]);
  await tab.steps(3);
  equal((await tab.labels()).at(-1), "Move A3", "elements come first");
});

testPlanner("picture: another file replaces it, or starts anew", {}, async (tab) => {
  await withPicture(tab);
  await tab.press("s");
  await drawLine(tab, [22, 400], [1178, 400], "23.12");
  await tab.press("Escape");
  await tab.steps(2);
  const { scale, at } = tab.json.drawing;
  await replace(tab, "large.png", wallsOf(2400, 1600), 3);
  const { drawing } = tab.json;
  equal([drawing.file, drawing.size, drawing.at], ["large.png", [2400, 1600], at]);
  const doubled = scale.from.map((value) => 2 * value);
  equal(numbers(drawing.scale.from, 1), numbers(doubled, 1));
  await pasteFile(tab, "image.png", wallsOf(600, 400));
  await tab.press("Escape");
  check(!(await tab.has("dialog[open]")), "the question is gone");
  await tab.steps(3);
  await pasteFile(tab, "image.png", wallsOf(600, 400));
  await tab.push(".question p:last-child button");
  await tab.steps(4);
  equal(tab.json.drawing, { file: "image.png", size: [600, 400], at: [0, 0] });
  equal(await tab.tool(), "scale");
  await tab.press("Escape");
});

testPlanner("picture: what changes its size is not checked, or not shown", { keeps: true }, async (tab) => {
  const files = await serveFiles(tab);
  await drop(tab, "plan_800.png", field("plan_800.png"));
  await tab.steps(1);
  await shown(tab);
  await drawLine(tab, [100, 550], [700, 550], "12");
  await tab.steps(2);
  await drawLine(tab, [100, 550], [100, 50], "10");
  await tab.steps(3);
  equal(await chip(tab), "");
  await replace(tab, "same.png", field("plan_800.png"), 4);
  equal(await chip(tab), "", "a version of the same size");
  await replace(tab, "plan_title_block.png", field("plan_title_block.png"), 5);
  await tab.notice("plan_title_block.png takes the place");
  says(await tab.text(".notice"), "check the scale again");
  equal([await chip(tab), tab.json.drawing.check], ["Scale not checked", undefined]);
  await tab.press("Escape", "Control+z");
  await tab.steps(4);
  equal(await chip(tab), "", "the old version with its check");
  // A file that changes in the folder is not stretched to the old size.
  files.set("same.png", field("plan_title_block.png"));
  await tab.reload();
  await tab.reaches(({ planner }) => planner.picture.state.kind === "failed");
  await tab.settle();
  equal(await chip(tab), "Floor plan not shown");
  await tab.push(".scale-state");
  says(await tab.text(".properties .problem"), "same.png has changed: its size is now 1100 × 600 instead of 800 × 600");
  await replace(tab, "same.png", field("plan_title_block.png"), 5);
  equal([await chip(tab), tab.json.drawing.size], ["Scale not checked", [1100, 600]]);
});

testPlanner("picture: the content decides about sides and format", {}, async (tab) => {
  for (const [name, body, file, size] of [
    ["near_square.png", field("near_square.png"), "near_square.png", [1000, 998]],
    ["camera_square.jpg", field("camera_square.jpg"), "camera_square.jpg", [1000, 998]],
    ["really-png.jpg", plan, "really-png.png", [1200, 800]],
  ]) {
    await drop(tab, name, body);
    await tab.steps(1);
    await shown(tab);
    equal([tab.json.drawing.file, tab.json.drawing.size], [file, size]);
    await tab.press("Escape", "Control+z");
    await tab.steps(0);
  }
});

testPlanner("picture: wrong files are refused with a reason, and everything stays alive", {}, async (tab) => {
  for (const [name, body, words] of [
    ["plan.dwg", Buffer.from("AC1032"), "plan.dwg: The file is a DWG file"], // by the reader of drawings
    ["plan.ifc", field("plan.ifc"), "plan.ifc is a model (IFC)"], // by the page
    ["header.png", plan.subarray(0, 20), "header.png: is incomplete or damaged"], // by the program
  ]) {
    await drop(tab, name, body);
    await tab.notice(words);
    check(!(await tab.has("dialog[open]")), "no dialog for labels");
  }
  check(await tab.isUntouched(), "the store is untouched");
  tab.errors.length = 0; // of the refused file
  await drop(tab, "plan.png", plan);
  await tab.steps(1);
  await tab.press("Escape");
});

testPlanner("picture: its panel", {}, async (tab, given) => {
  await withPicture(tab);
  await tab.run("Properties of the floor plan");
  equal(await tab.text(".properties h2"), "plan.png");
  let steps = 1;
  for (const [key, typed, read, expected] of [
    ["at/0", "-1.5", ({ at }) => at[0], -1.5],
    ["turn", "-2.5", ({ rotation_deg }) => rotation_deg, -2.5],
    ["crop", "100, 50, 1100, 750", ({ crop }) => crop, [100, 50, 1100, 750]],
    ["crop", "", ({ crop }) => crop, undefined],
  ]) {
    await tab.fill(`picture/${key}`, typed);
    await tab.steps(++steps);
    equal(read(tab.json.drawing), expected, key);
  }
  await tab.use("turn_picture_back");
  await tab.steps(6);
  equal(tab.json.drawing.rotation_deg, -92.5);
  await tab.push('.properties [data-key="scale"]');
  await clickPixel(tab, 300, 400);
  await clickPixel(tab, 900, 400);
  equal(await tab.evaluate(() => document.querySelector(".straight input").checked), true);
  await tab.page.keyboard.type("12");
  await tab.press("Enter", "Escape");
  await tab.steps(7);
  near(tab.json.drawing.rotation_deg, -90, 1e-3, "straight");
  check(await tab.has(".overlay .measure"), "the line is visible while the panel is open");
  await tab.fill("picture/scale", "6");
  await tab.steps(8);
  equal(tab.json.drawing.scale.length, 6);
  await tab.fill("picture/scale", "0");
  says(await tab.text(".properties"), "greater than 0");
  await tab.press("Escape");
  await tab.use("picture/isGrey");
  await tab.page.focus('[data-key="picture/fade"]');
  await tab.press("ArrowRight", "ArrowRight");
  const look = () =>
    tab.evaluate(() => {
      const { className, style, hidden: isHidden } = document.querySelector(".backdrop");
      return [className, style.opacity, isHidden];
    });
  equal(await look(), ["backdrop grey", "0.6", false]);
  await tab.reload();
  await shown(tab);
  await tab.settle();
  equal(await look(), ["backdrop grey", "0.6", false], "the browser remembers the look");
  await tab.push("#tab-layers");
  await tab.use("show-picture");
  equal((await look())[2], true, "hidden");
  await tab.use("show-picture");
  await tab.use("open-picture");
  await tab.use("remove_picture");
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
  await tab.run("Choose a floor plan …");
  await (await chooser).setFiles({ name: "plan.png", mimeType: "image/png", buffer: plan });
  await tab.steps(1);
  await shown(tab);
  await tab.press("ArrowRight", "Shift+ArrowUp", "Enter");
  const first = await firstEnd(tab);
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

testAxe("picture", {}, async (tab, clean, colours) => {
  await withPicture(tab);
  await tab.run("Properties of the floor plan");
  await tab.push("#tab-layers");
  await clean("panel");
  await tab.picture(`picture-panel-${colours}`);
  await tab.press("s");
  await drawLine(tab, [22, 400], [1178, 400], "");
  await clean("field with an error");
  await tab.press("Escape", "Escape");
  await drop(tab, "other.png", plan, () => clean("drop target"));
  await clean("question");
  await tab.press("Escape");
});
