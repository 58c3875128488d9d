// What tests of units look for.

import { check } from "../viewer/check.mjs";

export const isAt = (found, expected, slack = 0.02, what = "place") =>
  check(
    found.length === expected.length && found.every((value, k) => Math.abs(value - expected[k]) <= slack),
    `${what}: found ${found}, expected ${expected}`,
  );
export const axisNear = (found, expected) => isAt(found, expected, 1e-4, "axis");

/** The candidate that is nearest to a place: its number, where it is, there on the plan, and its state. */
export const unitAt = (tab, ...place) =>
  tab.reaches(
    (
      {
        planner: {
          document: { units },
        },
      },
      x,
      y,
    ) => {
      const all = Array.from({ length: units.count }, (_, index) => ({ index, at: units.at(index) }));
      const away = ({ at }) => Math.hypot(at[0] - x, at[1] - y);
      const [found] = all.sort((a, b) => away(a) - away(b));
      const at = found?.at.map((value) => Math.round(1e4 * value) / 1e4);
      return found && { ...found, at, place: at.slice(0, 2), state: units.state[found.index] };
    },
    ...place,
  );

/** Selects a candidate near a place: its id, where it is, and there on the plan. */
export async function chooseUnit(tab, x, y, grid = "G1-") {
  const { at, place } = await unitAt(tab, x, y);
  await tab.press("Escape");
  await tab.click(...place);
  const id = await tab.until((of) => {
    const name = document.querySelector(".properties h2").textContent;
    return name.startsWith(of) && name;
  }, grid);
  return { at, place, id };
}

/** The words at the unit that a click would place, or that is dragged. */
export const said = (tab, words) =>
  tab.until(
    (wanted) => document.querySelector(".overlay .reading")?.textContent.replaceAll("\u00a0", " ").includes(wanted),
    words,
  );
