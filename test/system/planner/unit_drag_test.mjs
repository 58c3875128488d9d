// Tests units that are dragged: in the plan and in 3-D, along their surfaces, with their light.

import { check, equal } from "../viewer/check.mjs";
import { placed, testPlanner } from "./opened.mjs";
import { chooseUnit, isAt, said, unitAt } from "./units.mjs";

testPlanner("units: a drag moves a candidate along the ceiling, and pins it", { smoke: true }, async (tab) => {
  const { at } = await unitAt(tab, 10, 9);
  const [x, y] = at;
  const [from, to] = [
    [x, y],
    [x + 1, y + 0.5],
  ];
  await tab.drag(from, to);
  equal(await tab.selected(), [], "a frame begins at a candidate, which a click selects first");
  await tab.click(x, y);
  for (const cancel of ["Escape", "Control+z"]) {
    await tab.drag(from, to, {
      during: async () => {
        await said(tab, "below the ceiling, 3.58 m");
        await tab.press(cancel);
      },
    });
    equal(await tab.state(({ planner }) => planner.mover.shown), null, cancel);
    check(await tab.isUntouched(), `${cancel} puts it back`);
  }
  await tab.drag(from, to, { during: () => tab.picture("unit-drag") });
  await tab.steps(1);
  const [label] = await tab.labels();
  check(/^Move unit G1-\d+-\d+$/.test(label), label);
  const { list, pinned } = tab.json.transceivers;
  placed(list[0].position, [...to, 3.58]);
  equal(pinned, ["U1"]);
  equal(await tab.selected(), ["/transceivers/list/0"]);
  equal((await unitAt(tab, x, y)).at, at, "the candidate of the grid stays");
  await tab.drag(to, [x + 1.5, y + 2], { keys: ["Shift"] });
  await tab.steps(2);
  placed(tab.json.transceivers.list[0].position, [x + 1, y + 2, 3.58], "along one axis");
});

testPlanner("units: a drag that begins before the last drop is written is not lost", {}, async (tab) => {
  const { at } = await chooseUnit(tab, 10, 9);
  const [x, y] = at;
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

const lit = { store: "chiller", light: true };
testPlanner("units: the light follows a drag, and comes back with Esc", lit, async (tab) => {
  await tab.lit();
  const signals = () => tab.state(({ planner }) => [...(planner.light.field?.total ?? [])].join());
  const before = await signals();
  for (const cancel of ["Escape", "Control+z"]) {
    await tab.drag([10.6, 2.6], [8.6, 4.1], {
      during: async () => {
        await tab.reaches(({ planner }) => Math.abs((planner.light.dragged?.about.position[0] ?? 0) - 8.6) < 0.05);
        check((await signals()) !== before, "other signals");
        await tab.press(cancel);
      },
    });
    equal(await tab.state(({ planner }) => planner.light.dragged), null, cancel);
    equal(await signals(), before, `${cancel} brings the signals back`);
  }
  await tab.drag([10.6, 2.6], [8.6, 4.1]);
  await tab.steps(1);
  check((await signals()) !== before, "the light of the last place stays");
  isAt(tab.json.transceivers.list[6].position, [8.6, 4.1, 3.15], 0.06);
});

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
  await tab.reaches(({ page }) => page.stage.fixtures.group.children.length > 0);
  const onScreen = (at) =>
    tab.state(({ page: { stage } }, point) => {
      const { x, y } = stage.project(point);
      const box = stage.canvas.getBoundingClientRect();
      return [box.x + x, box.y + y];
    }, at);
  const drag = async (from, to, during) => tab.dragPixels(await onScreen(from), await onScreen(to), { during });
  const view = () => tab.state(({ page }) => JSON.stringify(page.stage.cameraPlace()));
  const position = () => tab.json.transceivers.list.at(-1).position;
  await tab.hasSpace();
  const before = await view();
  await tab.page.mouse.click(...(await onScreen(ceiling.at)));
  const [x, y, z] = ceiling.at;
  const to = [x + 1, y + 0.6, z];
  await drag(ceiling.at, to, () => tab.press("Escape"));
  equal(await view(), before, "the view does not turn");
  check(await tab.isUntouched(), "Esc puts the unit back");
  await drag(ceiling.at, to, () => tab.picture("unit-space"));
  await tab.steps(1);
  isAt(position(), to, 0.04);
  await tab.press("Escape", "d");
  const face = await unitAt(tab, 8.5, 3.75);
  await tab.press("d");
  await tab.settle();
  await tab.page.mouse.click(...(await onScreen(face.at)));
  await drag(face.at, [face.at[0], face.at[1], 2]);
  await tab.steps(2);
  const lower = position();
  isAt([lower[2]], [2], 0.1, "height");
  await tab.press("ArrowUp");
  await tab.steps(3);
  isAt([position()[2]], [lower[2] + 0.01], 1e-3, "one centimetre up");
  await tab.press("d");
});
