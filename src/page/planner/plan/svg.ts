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

export function pathOf(points: readonly Point[], isOpen = false): string {
  if (points.length === 0) return "";
  const corners = points.map(([x, y]) => `${short(x)} ${short(y)}`).join("L");
  return `M${corners}${isOpen ? "" : "Z"}`;
}
