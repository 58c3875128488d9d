// Icons: strokes on a square of 24 units.

import { svg } from "../plan/svg";

const paths = {
  select: "M5 3l6.5 16 2.3-6.7L20.5 10z",
  measure: "M3 16.5L16.5 3 21 7.5 7.5 21zM7 12.5l2 2M10 9.5l1.5 1.5M13 6.5l2 2",
  scale: "M4 14v6M20 14v6M4 17h16M4 4h16v7H4zM8 11V8M12 11V7M16 11V8",
  room: "M4 4h16v10h-7v6H4z",
  wall: "M3 9h18v6H3zM9 9v3M15 9v3M6 12v3M12 12v3M18 12v3",
  opening: "M3 12h4M17 12h4M7 9v6M17 9v6M7 12a10 10 0 0 1 10-8v8",
  run: "M3 8h18v8H3zM3 12h18M9 8v8M15 8v8",
  block: "M6 6h12v12H6zM6 6l12 12M18 6L6 18",
  zone: "M4 6h3M10 6h4M17 6h3v3M20 12v3M20 18h-3M14 18h-4M7 18H4v-3M4 12V9",
  rows: "M3 4h18v4H3zM3 12h18M3 15h18M3 19h18",
  keep_out: "M4 4h16v16H4zM4 12l8-8M4 20L20 4M12 20l8-8",
  area: "M4 4h16v16H4zM9 9h.5M15 9h.5M9 15h.5M15 15h.5",
  unit: "M12 3v5M6.5 8h11l-2.2 5H8.7zM8 16.5L6.5 20M12 16.5V20M16 16.5l1.5 3.5",
  rail: "M3 7h18M6 7v4M12 7v4M18 7v4M4.5 11h3v3h-3zM10.5 11h3v3h-3zM16.5 11h3v3h-3z",
  faces: "M9 4h6v16H9zM5.5 8h.5M5.5 12h.5M5.5 16h.5M18 8h.5M18 12h.5M18 16h.5",
  undo: "M8 5L3.5 9.5 8 14M4 9.5h9.5a5.5 5.5 0 0 1 0 11H10",
  redo: "M16 5l4.5 4.5L16 14M20 9.5h-9.5a5.5 5.5 0 0 0 0 11H14",
  fit: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",
  find: "M10.5 4a6.5 6.5 0 1 0 0 13 6.5 6.5 0 0 0 0-13zM15.5 15.5L21 21",
  command: "M5 7l5 5-5 5M12 18h7",
  help: "M9 9a3 3 0 1 1 4.2 2.7c-.9.4-1.2 1-1.2 2.3M12 17.5v.5M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18z",
  objects: "M9 6h12M9 12h12M9 18h12M4 6h.5M4 12h.5M4 18h.5",
  layers: "M12 3l9 5-9 5-9-5zM3 12.5l9 5 9-5M3 16.8l9 5 9-5",
  light: "M12 3a6 6 0 0 0-3.6 10.8c.8.7 1.1 1.3 1.1 2.7h5c0-1.4.3-2 1.1-2.7A6 6 0 0 0 12 3zM9.8 19.5h4.4M10.5 21.8h3",
  person: "M12 3a3 3 0 1 0 0 6 3 3 0 0 0 0-6zM6 21v-5a6 6 0 0 1 12 0v5",
  plans: "M5 3h14v18H5zM8.5 8h7M8.5 12h4M8.5 16.5l1.7 1.7 4-4",
  types: "M4 4h7v7H4zM17 3.5l4 7.5h-8zM7.5 13.5a4 4 0 1 0 0 8 4 4 0 0 0 0-8zM14 15h7v6h-7z",
  problems: "M12 4l9.5 16.5h-19zM12 10v4.5M12 17.3v.4",
  history: "M4 12a8 8 0 1 0 2.5-5.8L4 8.5M4 4v4.5h4.5M12 7.5V12l3.5 2",
  shown: "M2.5 12S6 5.5 12 5.5 21.5 12 21.5 12 18 18.5 12 18.5 2.5 12 2.5 12zM12 9a3 3 0 1 0 0 6 3 3 0 0 0 0-6z",
  hidden:
    "M4 4l16 16M9.5 6a9.5 9.5 0 0 1 2.5-.5c6 0 9.5 6.5 9.5 6.5a15 15 0 0 1-2.6 3.3M6 7.8A15 15 0 0 0 2.5 12S6 18.5 12 18.5c1.5 0 2.8-.4 4-1",
  locked: "M5.5 11h13v9h-13zM8.5 11V8a3.5 3.5 0 0 1 7 0v3",
  free: "M5.5 11h13v9h-13zM8.5 11V7.5a3.5 3.5 0 0 1 6.8-1",
  turn: "M19 12a7 7 0 1 1-2.2-5.1L19 9M19 4v5h-5",
  mirror_x: "M12 3v18M9 7L3 17h6zM15 7l6 10h-6z",
  mirror_y: "M3 12h18M7 9L17 3v6zM7 15l10 6v-6z",
  duplicate: "M8 8h12v12H8zM4 16V4h12",
  delete: "M4 7h16M9 7V4h6v3M6 7l1 13h10l1-13M10 11v5M14 11v5",
  show: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5M9 9h6v6H9z",
  align_left: "M4 3v18M8 6h12v4H8zM8 14h7v4H8z",
  align_centre: "M12 3v18M5 6h14v4H5zM8 14h8v4H8z",
  align_right: "M20 3v18M4 6h12v4H4zM9 14h7v4H9z",
  align_top: "M3 4h18M6 8v12h4V8zM14 8v7h4V8z",
  align_middle: "M3 12h18M6 5v14h4V5zM14 8v8h4V8z",
  align_bottom: "M3 20h18M6 4v12h4V4zM14 9v7h4V9z",
  distribute_x: "M4 3v18M20 3v18M9.5 7h5v10h-5z",
  distribute_y: "M3 4h18M3 20h18M7 9.5v5h10v-5z",
  cube: "M12 3l8 4.5v9L12 21l-8-4.5v-9zM4 7.5l8 4.5 8-4.5M12 12v9",
  plan: "M4 4h16v16H4zM4 11h8V4M12 20v-4",
  more: "M5 12h.5M12 12h.5M19 12h.5",
};

export type IconName = keyof typeof paths;

export const icon = (name: IconName): SVGSVGElement =>
  svg("svg", { viewBox: "0 0 24 24", class: "icon", "aria-hidden": "true" }, svg("path", { d: paths[name] }));
