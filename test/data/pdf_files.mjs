// PDF files for tests: a floor plan, and files that readers fail on.

import { columns, outline, outside, zone } from "./drawn_shop.mjs";

/** `objects`: their bodies by number from 1; the first is the catalog. */
export function pdfOf(objects, { trailer = "" } = {}) {
  const parts = [Buffer.from("%PDF-1.7\n%\xe2\xe3\xcf\xd3\n", "latin1")];
  const places = [];
  let at = parts[0].length;
  const add = (part) => {
    parts.push(part);
    at += part.length;
  };
  objects.forEach((body, k) => {
    places.push(at);
    add(Buffer.concat([Buffer.from(`${k + 1} 0 obj\n`), Buffer.from(body, "latin1"), Buffer.from("\nendobj\n")]));
  });
  const start = at;
  const rows = places.map((place) => `${String(place).padStart(10, "0")} 00000 n \n`);
  add(
    Buffer.from(
      `xref\n0 ${objects.length + 1}\n0000000000 65535 f \n${rows.join("")}trailer\n<< /Size ${objects.length + 1} ` +
        `/Root 1 0 R ${trailer}>>\nstartxref\n${start}\n%%EOF\n`,
    ),
  );
  return Buffer.concat(parts);
}

export const streamOf = (content, entries = "") => `<< /Length ${content.length} ${entries}>>\nstream\n${content}\nendstream`;

/** Pages of a size with contents, and what else the catalog has. The first object after those of the pages is `next`. */
export function pagesOf(contents, { size = [300, 200], catalog = "", more = [], resources = "", trailer } = {}) {
  const first = 3;
  const kids = contents.map((_, k) => `${first + 2 * k} 0 R`);
  const objects = [
    `<< /Type /Catalog /Pages 2 0 R ${catalog}>>`,
    `<< /Type /Pages /Kids [${kids.join(" ")}] /Count ${contents.length} >>`,
    ...contents.flatMap((content, k) => [
      `<< /Type /Page /Parent 2 0 R /MediaBox [0 0 ${size.join(" ")}] /Contents ${first + 2 * k + 1} 0 R ` +
        `/Resources << /Font << /F1 << /Type /Font /Subtype /Type1 /BaseFont /Helvetica >> >> ${resources}>> >>`,
      streamOf(content),
    ]),
    ...more,
  ];
  return pdfOf(objects, { trailer });
}

/** Points for each m at 1 : 100. */
export const perMetre = 72 / 2.54;
const paper = [1190.55, 841.89];
const corner = [200, 150];

/** The place of a point of the shop in the picture: points, from the upper left corner. */
export const pixelOf = ([x, y]) => [corner[0] + perMetre * x, paper[1] - corner[1] - perMetre * y];

const path = (points, end = "s") =>
  `${points.map(([x, y], k) => `${x} ${y} ${k === 0 ? "m" : "l"}`).join("\n")}\n${end}\n`;

/** The shop on A3 at 1 : 100, with dimensions, a grid and a frame. */
export function shopPdf() {
  const content = [
    `q 1 0 0 1 ${corner.join(" ")} cm ${perMetre} 0 0 ${perMetre} 0 0 cm`,
    "0.01 w",
    path(outline),
    path(outside),
    "0 0 1 RG",
    "[0.2 0.1] 0 d",
    path(zone),
    "[] 0 d",
    "0.2 g",
    ...columns.map((column) => path(column, "b")),
    "0 G",
    path([
      [0, -1],
      [18, -1],
    ], "S"),
    "Q",
    "q 0.5 w 20 20 1150.55 801.89 re S Q",
    `BT /F1 14 Tf ${corner[0] + 200} ${corner[1] - 45} Td (18.00) Tj ET`,
    `BT /F1 24 Tf 700 60 Td (GROUND FLOOR 1:100) Tj ET`,
  ].join("\n");
  return pagesOf(["0 g BT /F1 30 Tf 100 700 Td (Cover sheet) Tj ET", content], { size: paper });
}
