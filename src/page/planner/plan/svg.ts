// Elements of SVG, and texts of their paths.

import type { Point } from "../document/messages";

const namespace = "http://www.w3.org/2000/svg";

export function svg<Tag extends keyof SVGElementTagNameMap>(
  tag: Tag,
  attributes: Record<string, string | number | undefined> = {},
  ...children: Node[]
): SVGElementTagNameMap[Tag] {
  const made = document.createElementNS(namespace, tag);
  for (const [name, value] of Object.entries(attributes))
    if (value !== undefined) made.setAttribute(name, String(value));
  made.append(...children);
  return made;
}

const short = (value: number): string => String(Math.round(value * 1e4) / 1e4);

/** An arrow from a unit to the side to which its axis leans; `way`: at most of length 1. */
export function leanPath([x, y]: Point, [dx, dy]: Point): string {
  const length = 12 + 14 * Math.hypot(dx, dy);
  const [c, s] = [dx, dy].map((value) => value / Math.hypot(dx, dy));
  const at = (along: number, across: number) =>
    `${short(x + along * c - across * s)} ${short(y + along * s + across * c)}`;
  return `M${at(9, 0)}L${at(length, 0)}M${at(length - 5, -4)}L${at(length, 0)}L${at(length - 5, 4)}`;
}

export function pathOf(points: readonly Point[], isOpen = false): string {
  if (points.length === 0) return "";
  const corners = points.map(([x, y]) => `${short(x)} ${short(y)}`).join("L");
  return `M${corners}${isOpen ? "" : "Z"}`;
}
