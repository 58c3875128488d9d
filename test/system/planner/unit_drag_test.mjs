// Tests units that are dragged: in the plan and in 3-D, along their surfaces, with their light.

import { check, equal } from "../viewer/check.mjs";
import { isDone, wait } from "./light.mjs";
import { placed, testPlanner } from "./opened.mjs";
import { isAt, last, said, unitAt } from "./units.mjs";

testPlanner("units: a drag moves a candidate along the ceiling, and pins it", { smoke: true }, async (tab) => {
  const { index, at } = await unitAt(tab, 10, 9);
  const [x, y] = at;
  await tab.drag([x, y], [x + 1, y + 0.5]);
  equal(await tab.selected(), [], "a frame begins at a candidate, which a click selects first");
  await tab.click(x, y);
  for (const cancel of ["Escape", "Control+z"]) {
    await tab.drag([x, y], [x + 1, y + 0.5], {
      during: async () => {
        await said(tab, "below the ceiling, 3.58 m");
        await tab.press(cancel);
      },
    });
    equal(await tab.page.evaluate(() => window.shelfbeamPlanner.planner.mover.shown), null, cancel);
    check(await tab.isUntouched(), `${cancel} puts it back`);
  }
  await tab.drag([x, y], [x + 1, y + 0.5], { during: () => tab.picture("unit-drag") });
  await tab.steps(1);
  const [label] = await tab.labels();
  check(/^Move unit G1-\d+-\d+$/.test(label), label);
  const { list, pinned } = tab.json.transceivers;
  placed(list[0].position, [x + 1, y + 0.5, 3.58]);
  equal(pinned, ["U1"]);
  equal(await tab.selected(), ["/transceivers/list/0"]);
  equal((await unitAt(tab, x, y)).at, at, "the candidate of the grid stays");
  check(index >= 0, "it had a number");
  await tab.drag([x + 1, y + 0.5], [x + 1.5, y + 2], { keys: ["Shift"] });
  await tab.steps(2);
  placed(tab.json.transceivers.list[0].position, [x + 1, y + 2, 3.58], "along one axis");
  await tab.press("Control+z", "Control+z");
  await tab.steps(0);
  check(tab.server.text === tab.server.first, "undo brings the candidate back");
});

testPlanner("units: a drag that begins before the last drop is written is not lost", {}, async (tab) => {
  const { at } = await unitAt(tab, 10, 9);
  const [x, y] = at;
  await tab.click(x, y);
  await tab.until(() => document.querySelector(".properties h2").textContent.startsWith("G1-"));
  let release;
  await tab.drag([x, y], [x + 1, y + 0.5], {
    during: async () => {
      await said(tab, "below the ceiling");
      release = tab.server.wire.hold();
    },
  });
  await tab.drag([x + 1, y + 0.5], [x + 2, y + 1.5]); // from where it is shown
  release();
  await tab.steps(2);
  const { list } = tab.json.transceivers;
  equal(list.length, 1);
  placed(list[0].position, [x + 2, y + 1.5, 3.58]);
  equal(await tab.selected(), ["/transceivers/list/0"]);
});

testPlanner(
  "units: the light follows a drag, and comes back with Esc",
  { store: "chiller", light: true },
  async (tab) => {
    const light = (read) => tab.page.evaluate(read);
    await wait(tab, isDone);
    const signals = () => light(() => [...(window.shelfbeamPlanner.planner.light.field?.total ?? [])].join());
    const position = () => light(() => window.shelfbeamPlanner.planner.light.dragged?.about.position ?? null);
    const before = await signals();
    for (const cancel of ["Escape", "Control+z"]) {
      await tab.drag([10.6, 2.6], [8.6, 4.1], {
        during: async () => {
          await tab.until(
            () => Math.abs((window.shelfbeamPlanner.planner.light.dragged?.about.position[0] ?? 0) - 8.6) < 0.05,
          );
          check((await signals()) !== before, "other signals");
          await tab.press(cancel);
        },
      });
      equal(await position(), null, cancel);
      equal(await signals(), before, `${cancel} brings the signals back`);
    }
    await tab.drag([10.6, 2.6], [8.6, 4.1]);
    await tab.steps(1);
    check((await signals()) !== before, "the light of the last place stays");
    isAt(tab.json.transceivers.list[6].position, [8.6, 4.1, 3.15], 0.06);
  },
);

testPlanner("units: one on a column moves around it", { store: "market-hall" }, async (tab) => {
  const { at } = await unitAt(tab, 8.5, 3.9);
  await tab.click(at[0], at[1]);
  await tab.drag([at[0], at[1]], [8.9, 4.2], { during: () => said(tab, "on the face of column 2, 2.80 m") });
  await tab.steps(1);
  const [{ position, axis }] = tab.json.transceivers.list;
  check(position[0] > 8.7 && Math.abs(position[1] - 4.2) < 0.1 && position[2] === 2.8, `the east side: ${position}`);
  check(axis[0] > 0.8, `it turns: ${axis}`);
});

testPlanner("units: a drag in 3-D", { store: "market-hall" }, async (tab) => {
  const ceiling = await unitAt(tab, 4, 3);
  await tab.press("d");
  await tab.until(() => window.shelfbeamPlanner.page.stage.fixtures.group.children.length > 0);
  const onScreen = (at) =>
    tab.page.evaluate((point) => {
      const { stage } = window.shelfbeamPlanner.page;
      const { x, y } = stage.project(point);
      const box = stage.canvas.getBoundingClientRect();
      return [box.x + x, box.y + y];
    }, at);
  const view = () => tab.page.evaluate(() => JSON.stringify(window.shelfbeamPlanner.page.stage.cameraPlace()));
  await new Promise((done) => setTimeout(done, 800)); // the picture of the shop
  const before = await view();
  await tab.page.mouse.click(...(await onScreen(ceiling.at)));
  const [x, y, z] = ceiling.at;
  const to = [x + 1, y + 0.6, z];
  await tab.dragPixels(await onScreen(ceiling.at), await onScreen(to), {
    during: () => tab.press("Escape"),
  });
  equal(await view(), before, "the view does not turn");
  check(await tab.isUntouched(), "Esc puts the unit back");
  await tab.dragPixels(await onScreen(ceiling.at), await onScreen(to), { during: () => tab.picture("unit-space") });
  await tab.steps(1);
  isAt(tab.json.transceivers.list[0].position, to, 0.04);
  await tab.press("Escape", "d");
  const face = await unitAt(tab, 8.5, 3.75);
  await tab.press("d");
  await tab.settle();
  await tab.page.mouse.click(...(await onScreen(face.at)));
  await tab.dragPixels(await onScreen(face.at), await onScreen([face.at[0], face.at[1], 2]));
  await tab.steps(2);
  const { position } = last(tab.json.transceivers.list);
  check(Math.abs(position[2] - 2) < 0.1, `down the column: ${position}`);
  await tab.press("ArrowUp");
  await tab.steps(3);
  const higher = last(tab.json.transceivers.list).position[2];
  check(Math.abs(higher - position[2] - 0.01) < 1e-3, `one centimetre up: ${higher}`);
  await tab.press("d");
});
