// What tests of units look for.

import { check } from "../viewer/check.mjs";

export const last = (list) => list[list.length - 1];
export const isAt = (found, expected, slack = 0.02) =>
  check(
    found.every((value, k) => Math.abs(value - expected[k]) <= slack),
    `place: found ${found}, expected ${expected}`,
  );
export const axisNear = (found, expected) =>
  check(
    found.every((value, k) => Math.abs(value - expected[k]) < 1e-4),
    `axis: found ${found}, expected ${expected}`,
  );

/** The candidate that is nearest to a place: its number, where it is, and its state. */
export const unitAt = (tab, x, y) =>
  tab.until(
    ([u, v]) => {
      const { units } = window.shelfbeamPlanner.planner.document;
      const all = Array.from({ length: units.count }, (_, index) => ({ index, at: units.at(index) }));
      const away = ({ at }) => Math.hypot(at[0] - u, at[1] - v);
      const found = all.sort((a, b) => away(a) - away(b))[0];
      return (
        found && {
          ...found,
          at: found.at.map((value) => Math.round(1e4 * value) / 1e4),
          state: units.state[found.index],
        }
      );
    },
    [x, y],
  );

/** The words at the unit that a click would place, or that is dragged. */
export const said = (tab, words) =>
  tab.until(
    (wanted) => document.querySelector(".overlay .reading")?.textContent.replaceAll("\u00a0", " ").includes(wanted),
    words,
  );

export const notice = (tab, words) =>
  tab.until((wanted) => document.querySelector(".notice").textContent.includes(wanted), words);
