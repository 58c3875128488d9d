// The drawn shop as a DXF file of release 2000: in millimetres, with layers, blocks and far coordinates.

import { columns, outline, outside, zone } from "./drawn_shop.mjs";

/** Where the lower left corner of the room is, mm. */
const corner = [3_500_000, 5_800_000];

const place = ([x, y]) => [corner[0] + 1000 * x, corner[1] + 1000 * y];
const tags = (...pairs) => pairs.map(([code, value]) => `${String(code).padStart(3)}\n${value}`).join("\n");

const polyline = (layer, points) =>
  tags(
    [0, "LWPOLYLINE"],
    [100, "AcDbEntity"],
    [8, layer],
    [100, "AcDbPolyline"],
    [90, points.length],
    [70, 1],
    ...points.flatMap((point) => {
      const [x, y] = place(point);
      return [
        [10, x],
        [20, y],
      ];
    }),
  );

const line = (layer, from, to) => {
  const [[x, y], [u, v]] = [place(from), place(to)];
  return tags([0, "LINE"], [8, layer], [10, x], [20, y], [11, u], [21, v]);
};

const text = (layer, at, height, words) => {
  const [x, y] = place(at);
  return tags([0, "TEXT"], [8, layer], [10, x], [20, y], [40, 1000 * height], [1, words]);
};

const layer = (name, colour) => tags([0, "LAYER"], [2, name], [70, 0], [62, colour], [6, "CONTINUOUS"]);
const section = (name, ...content) => [tags([0, "SECTION"], [2, name]), ...content, tags([0, "ENDSEC"])];

/** `header`: the value of $INSUNITS; 4 is millimetres. */
export function shopDxf({ header = 4, more = [], outlines = [outline] } = {}) {
  return Buffer.from(
    [
      ...section(
        "HEADER",
        tags([9, "$ACADVER"], [1, "AC1015"]),
        tags([9, "$DWGCODEPAGE"], [3, "ANSI_1252"]),
        tags([9, "$INSUNITS"], [70, header]),
      ),
      ...section(
        "TABLES",
        tags([0, "TABLE"], [2, "LAYER"], [70, 5]),
        layer("WALLS", 7),
        layer("COLUMNS", 1),
        layer("CEILING", 5),
        layer("FURNITURE", 3),
        layer("TEXT", 8),
        tags([0, "ENDTAB"]),
      ),
      ...section(
        "ENTITIES",
        ...outlines.map((points) => polyline("WALLS", points)),
        polyline("WALLS", outside),
        ...columns.map((points) => polyline("COLUMNS", points)),
        polyline("CEILING", zone),
        polyline("FURNITURE", [
          [2, 2],
          [8, 2],
          [8, 3],
          [2, 3],
        ]),
        line("TEXT", [0, -1], [18, -1]),
        text("TEXT", [7, -1.6], 0.3, "18.00 m, M\xf6bel"),
        text("TEXT", [11, 12], 0.8, "GROUND FLOOR"),
        ...more,
      ),
      tags([0, "EOF"]),
      "",
    ].join("\n"),
    "latin1",
  );
}

/** The place of a point of the shop in the picture, whose lower left corner is that of the drawing: mm. */
export const pixelIn = ({ size, origin }) => {
  return (point) => {
    const [x, y] = place(point);
    return [x - origin[0], size[1] - (y - origin[1])];
  };
};
