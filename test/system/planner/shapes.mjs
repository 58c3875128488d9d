// Points of the plan.

/** "0,0 4,0 4,3": the corners of a triangle. */
export const points = (text) => text.split(" ").map((point) => point.split(",").map(Number));
export const rectangle = (x, y, u, v) => [
  [x, y],
  [u, y],
  [u, v],
  [x, v],
];
export const square = (x, y, width, height = width) => rectangle(x, y, x + width, y + height);
