// An L-shaped shop with a slanted wall, a part with a lower ceiling and two columns, as an architect draws it. Lengths
// are in m.

export const outline = [
  [0, 0],
  [18, 0],
  [18, 7],
  [16, 9],
  [8, 9],
  [8, 15],
  [0, 15],
];
/** The part with the lower ceiling. */
export const zone = [
  [0, 9],
  [8, 9],
  [8, 15],
  [0, 15],
];
export const columns = [
  [
    [4.8, 4.8],
    [5.2, 4.8],
    [5.2, 5.2],
    [4.8, 5.2],
  ],
  [
    [11.8, 4.8],
    [12.2, 4.8],
    [12.2, 5.2],
    [11.8, 5.2],
  ],
];

/** The outer faces of the walls, 20 cm from the inner ones. */
export const outside = (() => {
  const lines = outline.map(([x, y], k) => {
    const [u, v] = outline[(k + 1) % outline.length];
    const length = Math.hypot(u - x, v - y);
    const normal = [(v - y) / length, (x - u) / length];
    return { way: [u - x, v - y], at: [x + 0.2 * normal[0], y + 0.2 * normal[1]] };
  });
  return lines.map((b, k) => {
    const a = lines[(k + lines.length - 1) % lines.length];
    const side = a.way[0] * b.way[1] - a.way[1] * b.way[0];
    const t = ((b.at[0] - a.at[0]) * b.way[1] - (b.at[1] - a.at[1]) * b.way[0]) / side;
    return [a.at[0] + t * a.way[0], a.at[1] + t * a.way[1]];
  });
})();
