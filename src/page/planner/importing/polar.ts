// The polar picture of an emission profile: intensities by direction, relative to the largest.

import { svg } from "../plan/svg";

/** As the program answers to an upload (docs/formats/planner.md). */
export interface Photometry {
  type: "ies" | "eulumdat";
  step_deg: number;
  /** For C = 0, 90, 180 and 270 degrees: from the axis to the opposite direction. */
  planes: [number[], number[], number[], number[]];
}

const radius = 90; // pixels
const rings = [0.25, 0.5, 0.75, 1];
const marks = [0, 30, 60, 90];

/** The place of an intensity; the axis points down, and the half-plane is to the right or left. */
const place = (value: number, degrees: number, side: 1 | -1): string => {
  const angle = (degrees * Math.PI) / 180;
  return `${(side * radius * value * Math.sin(angle)).toFixed(2)} ${(radius * value * Math.cos(angle)).toFixed(2)}`;
};

function curve(right: readonly number[], left: readonly number[], step: number, name: string): SVGElement {
  const points = [
    ...right.map((value, k) => place(value, k * step, 1)).reverse(),
    ...left.map((value, k) => place(value, k * step, -1)),
  ];
  return svg("path", { class: `curve ${name}`, d: `M${points.join("L")}` });
}

export function polarPicture({ step_deg, planes }: Photometry, title: string): SVGElement {
  const [a, b, c, d] = planes;
  const grid = [
    ...rings.map((ring) => svg("circle", { r: ring * radius })),
    ...marks.flatMap((mark) => ([1, -1] as const).map((side) => svg("path", { d: `M0 0L${place(1, mark, side)}` }))),
  ];
  const labels = marks.map((mark) => {
    const [x, y] = place(1.12, mark, 1).split(" ");
    const text = svg("text", { x, y });
    text.textContent = `${mark}°`;
    return text;
  });
  const picture = svg("svg", { class: "polar", viewBox: "-116 -98 232 212", role: "img", "aria-label": title });
  const lines = svg("g", { class: "grid" });
  lines.append(...grid);
  picture.append(lines, curve(b, d, step_deg, "across"), curve(a, c, step_deg, "along"), ...labels);
  return picture;
}
