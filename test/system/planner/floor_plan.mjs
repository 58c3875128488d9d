// Pictures of floor plans, the way of a file into the page, and a store of files in place of the program's.

import { deflateSync } from "node:zlib";

const crcTable = Uint32Array.from({ length: 256 }, (_, byte) => {
  let value = byte;
  for (let bit = 0; bit < 8; ++bit) value = value & 1 ? 0xedb88320 ^ (value >>> 1) : value >>> 1;
  return value;
});

function chunk(type, data) {
  const body = Buffer.concat([Buffer.from(type, "latin1"), data]);
  let crc = 0xffffffff;
  for (const byte of body) crc = crcTable[(crc ^ byte) & 255] ^ (crc >>> 8);
  const ends = Buffer.alloc(8);
  ends.writeUInt32BE(data.length, 0);
  ends.writeUInt32BE((crc ^ 0xffffffff) >>> 0, 4);
  return Buffer.concat([ends.subarray(0, 4), body, ends.subarray(4)]);
}

/** A PNG file with black where `isDark` says, white elsewhere. */
export function pngOf(width, height, isDark) {
  const rows = Buffer.alloc(height * (width + 1), 255);
  for (let y = 0; y < height; ++y) {
    rows[y * (width + 1)] = 0; // no filter
    for (let x = 0; x < width; ++x) if (isDark(x, y)) rows[y * (width + 1) + 1 + x] = 0;
  }
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header[8] = 8; // bits of grey
  const start = Buffer.from("\x89PNG\r\n\x1a\n", "latin1");
  return Buffer.concat([
    start,
    chunk("IHDR", header),
    chunk("IDAT", deflateSync(rows)),
    chunk("IEND", Buffer.alloc(0)),
  ]);
}

/** The outer walls of a shop, 20 pixels inside of the picture and 6 pixels thick. */
export function wallsOf(width, height) {
  const isWithin = (value, size, edge) => value >= edge && value < size - edge;
  return pngOf(width, height, (x, y) => {
    const isInside = (edge) => isWithin(x, width, edge) && isWithin(y, height, edge);
    return isInside(20) && !isInside(26);
  });
}

/** Answers requests for files: it keeps what it gets. `answer`: what it says to a new file instead. */
export async function serveFiles(tab, answer = null) {
  const kept = new Map();
  await tab.page.context().route("**/files/*", async (route) => {
    const request = route.request();
    const name = decodeURIComponent(new URL(request.url()).pathname.split("/").at(-1));
    if (request.method() === "GET") {
      const body = kept.get(name);
      await route.fulfill(body ? { status: 200, contentType: "image/png", body } : { status: 404 });
      return;
    }
    if (answer) {
      await route.fulfill(answer);
      return;
    }
    const body = request.postDataBuffer();
    kept.set(name, body);
    const [width, height] = [body.readUInt32BE(16), body.readUInt32BE(20)];
    await route.fulfill({ status: 201, json: { file: name, width, height } });
  });
  return kept;
}

const transferred = `(name, type, content) => {
  const bytes = Uint8Array.from(atob(content), (letter) => letter.charCodeAt(0));
  const transfer = new DataTransfer();
  transfer.items.add(new File([bytes], name, { type }));
  return transfer;
}`;

/** Drags a file over the page. `during` runs before it is dropped. */
export async function drop(tab, name, body, during = () => {}) {
  const send = (kinds) =>
    tab.page.evaluate(
      `(() => {
        const dataTransfer = (${transferred})(${JSON.stringify(name)}, "", ${JSON.stringify(body.toString("base64"))});
        for (const kind of ${JSON.stringify(kinds)})
          document.body.dispatchEvent(new DragEvent(kind, { dataTransfer, bubbles: true, cancelable: true }));
      })()`,
    );
  await send(["dragenter", "dragover"]);
  await tab.settle();
  await during();
  await send(["drop"]);
  await tab.settle();
}

export async function pasteFile(tab, name, body) {
  await tab.page.evaluate(
    `(() => {
      const clipboardData = (${transferred})(${JSON.stringify(name)}, "image/png", ${JSON.stringify(body.toString("base64"))});
      document.body.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true, cancelable: true }));
    })()`,
  );
  await tab.settle();
}

/** Until the pixels of the picture are there. */
export const shown = (tab) => tab.reaches(({ planner }) => planner.picture.state.kind === "shown");

/** The place on the screen of a pixel of the picture. */
export const pixelAt = (tab, x, y) =>
  tab.state(
    ({ planner }, [u, v]) => {
      const { size, at, scale, unit, rotation_deg = 0 } = planner.drawing;
      const { factor } = planner.document.unit;
      const unscaled = unit ? { mm: 0.001, m: 1, in: 0.0254 }[unit] : 20 / size[0];
      const length = scale && Math.hypot(scale.to[0] - scale.from[0], scale.to[1] - scale.from[1]);
      const step = scale ? (scale.length / length) * factor : unscaled;
      const angle = (rotation_deg * Math.PI) / 180;
      const [a, b] = [step * u, step * (size[1] - v)];
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      const [left, top] = planner.viewport.toScreen([factor * at[0] + c * a - s * b, factor * at[1] + s * a + c * b]);
      const box = document.querySelector(".surface").getBoundingClientRect();
      return [box.left + left, box.top + top];
    },
    [x, y],
  );

/** Clicks a pixel of the picture. */
export async function clickPixel(tab, x, y) {
  await tab.page.mouse.click(...(await pixelAt(tab, x, y)));
  await tab.settle();
}

/** The colour of the picture at a place of the screen, as [red, green, blue, opacity]. */
export const colourAt = (tab, [x, y]) =>
  tab.evaluate(
    (u, v) => {
      const canvas = document.querySelector(".backdrop");
      const box = canvas.getBoundingClientRect();
      return [...canvas.getContext("2d").getImageData(u - box.left, v - box.top, 1, 1).data];
    },
    Math.round(x),
    Math.round(y),
  );
