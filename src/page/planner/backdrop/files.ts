// Files that people drop: their formats, and their way to the program.

import type { Point } from "../document/messages";
import { isTable, isTableName } from "../table/sniff";
import { say, text } from "../text";
import type { DeviceFacts } from "../importing/module";
import type { Drawing } from "./drawing";
import { foreignOf } from "./foreign";

/** The file is not accepted; the message says why. */
export class NotAccepted extends Error {}

const longestName = 60;

const deviceKinds = ["ies", "ldt", "glb", "obj", "stl", "ply"] as const;

/** Whether it becomes a transceiver type or a fixture. */
export const isDevice = (kind: Kind): boolean => (deviceKinds as readonly string[]).includes(kind);

export type Kind = "png" | "jpg" | "webp" | "pdf" | "dxf" | "csv" | DeviceKind | "other";

/** Emission profiles and meshes. */
type DeviceKind = (typeof deviceKinds)[number];

/** Readers of PDF files allow so many bytes before the mark. */
const mostBefore = 1024;
const sniffed = 4096; // bytes

const beginningOf = (bytes: Uint8Array): string => String.fromCharCode(...bytes.subarray(0, sniffed));

/**
 * By its first bytes, and by its name if the format has no mark there. Binary DXF and DWG files count as DXF, whose reader
 * names the remedy; `csv`: a table.
 */
export function kindOf(bytes: Uint8Array, name = ""): Kind {
  const words = beginningOf(bytes);
  if (words.startsWith("\x89PNG\r\n\x1a\n")) return "png";
  if (words.startsWith("\xff\xd8\xff")) return "jpg";
  if (words.startsWith("RIFF") && words.startsWith("WEBP", 8)) return "webp";
  if (words.startsWith("%PDF-")) return "pdf";
  if (/^(\xef\xbb\xbf)?(\s*(0|999)\s*[\r\n]|AutoCAD Binary DXF|AC10\d\d(\0|$))/.test(words)) return "dxf";
  if (words.startsWith("glTF")) return "glb";
  if (words.startsWith("IESNA")) return "ies";
  const named = deviceKinds.find((kind) => name.toLowerCase().endsWith(`.${kind}`));
  if (named) return named;
  const isPdf = words.lastIndexOf("%PDF-", mostBefore) >= 0;
  if (isPdf && !isTableName(name)) return "pdf";
  if (foreignOf(words, name)) return "other";
  if (/\.(dxf|dwg)$/i.test(name)) return "dxf";
  return isTable(name, bytes) ? "csv" : "other";
}

/** A name that is safe in every file system. */
export function nameFor(name: string, kind: Kind): string {
  const stem = name
    .replace(/^.*[/\\]/, "")
    .replace(/\.\w+$/, "")
    .normalize("NFKD")
    .replace(/\p{M}/gu, "")
    .replace(/[^A-Za-z0-9._-]+/g, "-")
    .replace(/^[-.]+|[-.]+$/g, "")
    .slice(0, longestName);
  return `${stem || (kind === "csv" ? "table" : "plan")}.${kind}`;
}

/** Whether the browser turns the picture by a right angle, as the camera has noted. */
async function isTurned(file: Blob, [width, height]: Point): Promise<boolean> {
  // Browsers round the other side upwards, so that a small copy of an almost square picture is a square.
  const isAlmostSquare = Math.abs(width - height) < 0.02 * width;
  const bitmap = await createImageBitmap(file, isAlmostSquare ? {} : { resizeWidth: 256 });
  const isOther = bitmap.width > bitmap.height !== width > height;
  bitmap.close();
  return isOther;
}

export interface Given {
  name: string;
  kind: Kind;
  bytes: ArrayBuffer;
}

/** The content of a file. Throws NotAccepted. */
export async function contentOf(file: File): Promise<Given> {
  // A folder has no bytes.
  const bytes = await file.arrayBuffer().catch(() => new ArrayBuffer(0));
  if (bytes.byteLength === 0) throw new NotAccepted(say(text.picture.empty, file.name));
  const kind = kindOf(new Uint8Array(bytes), file.name);
  if (kind !== "other") return { name: file.name, kind, bytes };
  const foreign = foreignOf(beginningOf(new Uint8Array(bytes)), file.name);
  throw new NotAccepted(
    say(foreign ? text.picture.foreign[foreign.kind] : text.picture.other, file.name, foreign?.format ?? ""),
  );
}

interface Stored extends DeviceFacts {
  file: string;
  /** Of a picture, pixels. */
  width?: number;
  height?: number;
}

/** Sends a file to the program. Throws NotAccepted, or another error if there is no connection. */
export async function upload(address: string, { name, kind, bytes }: Given): Promise<Stored> {
  const answer = await fetch(`${address}files/${nameFor(name, kind)}`, { method: "PUT", body: bytes });
  if (!answer.ok) throw new NotAccepted((await answer.text()).trim() || say(text.picture.refused, name));
  return (await answer.json()) as Stored;
}

export async function uploadPicture(address: string, given: Given): Promise<Pick<Drawing, "file" | "size">> {
  const { file, width = 0, height = 0 } = await upload(address, given);
  const turned = await isTurned(new Blob([given.bytes]), [width, height]).catch(() => {
    throw new NotAccepted(say(text.picture.unreadable, given.name));
  });
  return { file, size: turned ? [height, width] : [width, height] };
}
