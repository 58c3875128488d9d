// Traces the drawn shop of test/data over its floor plan, as a person does.

import { outline, zone } from "../../data/drawn_shop.mjs";
import { check, equal } from "../viewer/check.mjs";

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

/** Until the lines of the floor plan are there. */
export const linesOf = (tab) => tab.reaches(({ planner }) => planner.picture.lines !== null);

/** Traces the scale and its check. */
export async function traceScale(person) {
  for (const [corner, length] of [
    [1, "18"],
    [6, "15"],
  ]) {
    await person.line(outline[0], outline[corner]);
    await person.type(length, "Enter");
  }
  await person.tab.until(() => document.querySelector(".scale-state").hidden);
}

/** Traces the room, and the zone with the lower ceiling. */
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
