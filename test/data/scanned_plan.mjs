// The floor plan of a shop as an office copier gives it: a drawing with a title block and a scale bar, laid down a
// little askew, with grey paper, specks and blurred lines. The same input gives the same bytes in the same browser.

const paper = [2340, 1655]; // pixels: A3 at 142 dots per inch
const perMetre = 74; // pixels
const margin = [180, 120]; // pixels from the lower left corner of the paper to the inner corner of the room
const wall = 0.24; // m
const askew = 1.2; // degrees, clockwise

/** The place of a point of the shop, m, in pixels of the picture from its upper left corner. */
export function pixelOf([x, y]) {
  const [u, v] = [margin[0] + perMetre * x - 0.5 * paper[0], 0.5 * paper[1] - margin[1] - perMetre * y];
  const angle = (askew * Math.PI) / 180;
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return [0.5 * paper[0] + c * u - s * v, 0.5 * paper[1] + s * u + c * v];
}

const escaped = (words) => words.replaceAll("&", "&amp;").replaceAll("<", "&lt;");

const sizeOf = ([a, b, c]) => [Math.hypot(b[0] - a[0], b[1] - a[1]), Math.hypot(c[0] - b[0], c[1] - b[1])];

/** The line between both sides of a gondola. */
function backOf([a, b, c, d], at) {
  const middle = (p, q) => [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])];
  const points = `${at(middle(a, d))} ${at(middle(b, c))}`;
  return `<polyline points="${points}" stroke="#222" stroke-width="1.5"/>`;
}

/** `parts`: outlines of the room, fixtures and keep-out areas in m, with ids. */
function drawingOf(title, parts) {
  const at = ([x, y]) => `${margin[0] + perMetre * x},${paper[1] - margin[1] - perMetre * y}`;
  const polygon = (corners, style) => `<polygon points="${corners.map(at).join(" ")}" ${style}/>`;
  const thin = 'fill="none" stroke="#222" stroke-width="2"';
  const shapes = parts.map(({ kind, id, outline }) => {
    if (kind === "room") {
      const width = 2 * wall * perMetre;
      const walls = `fill="none" stroke="#333" stroke-width="${width}" stroke-linejoin="miter"`;
      return polygon(outline, walls) + polygon(outline, 'fill="#fff" stroke="#111" stroke-width="2"');
    }
    if (kind === "keep_out") return polygon(outline, 'fill="none" stroke="#222" stroke-width="2" stroke-dasharray="14 7"');
    if (kind !== "fixture") return "";
    const middle = [0, 1].map((k) => outline.reduce((sum, corner) => sum + corner[k], 0) / outline.length);
    const [x, y] = at(middle).split(",");
    const words = `<text x="${x}" y="${y}" dy="7" text-anchor="middle" font-size="20" fill="#444">${escaped(id)}</text>`;
    const [length, depth] = sizeOf(outline);
    if (length < 0.5) return polygon(outline, 'fill="#777" stroke="#222" stroke-width="2"');
    return polygon(outline, thin) + (outline.length === 4 && depth > 0.85 ? backOf(outline, at) : "") + words;
  });
  const [left, top] = [paper[0] - 520, 30];
  const bar = [0, 1, 2, 3, 4].map(
    (k) =>
      `<rect x="${margin[0] + k * perMetre}" y="40" width="${perMetre}" height="12" fill="${k % 2 ? "#fff" : "#111"}" stroke="#111"/>`,
  );
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${paper[0]}" height="${paper[1]}" font-family="DejaVu Sans, sans-serif">
<filter id="scan" x="0" y="0" width="100%" height="100%" color-interpolation-filters="sRGB">
<feGaussianBlur in="SourceGraphic" stdDeviation="0.9" result="ink"/>
<feTurbulence type="fractalNoise" baseFrequency="0.8" numOctaves="2" seed="7"/>
<feColorMatrix type="matrix" values="0 0 0 0 0.2  0 0 0 0 0.2  0 0 0 0 0.2  0 0 0 1.7 -0.75" result="specks"/>
<feMerge><feMergeNode in="ink"/><feMergeNode in="specks"/></feMerge></filter>
<g filter="url(#scan)"><rect width="100%" height="100%" fill="#eceae4"/>
<g transform="rotate(${askew} ${0.5 * paper[0]} ${0.5 * paper[1]})">${shapes.join("\n")}${bar.join("")}
<text x="${margin[0]}" y="78" font-size="20">0</text><text x="${margin[0] + 4.7 * perMetre}" y="78" font-size="20">5 m</text>
<rect x="${left}" y="${top}" width="480" height="96" fill="#fff" stroke="#111" stroke-width="2"/>
<path d="M${left} ${top + 48}h480M${left + 300} ${top + 48}v48" stroke="#111" stroke-width="2"/>
<text x="${left + 14}" y="${top + 34}" font-size="26">${escaped(title)}</text>
<text x="${left + 14}" y="${top + 80}" font-size="20">Ground floor</text><text x="${left + 314}" y="${top + 80}" font-size="20">Sheet 3 of 7</text>
</g></g></svg>`;
}

/** The bytes of a PNG file. `browser`: of playwright. */
export async function scannedPlan(browser, title, parts) {
  const page = await browser.newPage({ viewport: { width: paper[0], height: paper[1] } });
  await page.setContent(`<body style="margin:0">${drawingOf(title, parts)}</body>`);
  const bytes = await page.screenshot({ type: "png" });
  await page.close();
  return bytes;
}
