// Formats that people try, and that the planner does not read: each kind has a remedy of its own.

export type ForeignKind = "model" | "mesh" | "spreadsheet" | "picture" | "document" | "archive" | "no_pdf";

const extensions: [ForeignKind, RegExp][] = [
  [
    "model",
    /^(ifc|ifcxml|ifczip|stpz?|step|p21|rvt|rfa|rte|skp|pln|pla|bimx|vwx|dgn|dwfx?|dwt|3dm|nw[cdf]|ige?s|sat|fcstd|sld(prt|asm|drw)|ipt|iam)$/,
  ],
  ["mesh", /^(gltf|fbx|dae|3ds|3mf|blend|max|usd[acz]?|wrl|x3d|ma|mb)$/],
  ["spreadsheet", /^(xls[xmb]?|xlt[xm]?|f?ods|ots|numbers)$/],
  ["picture", /^(gif|tiff?|bmp|heic|heif|avif|jxl|jp2|svgz?|psd|xcf|ai|eps|ps|cdr)$/],
  ["document", /^(docx?|docm|odt|rtf|pages|pptx?|odp|key|vsdx?|odg|xps|oxps|pub)$/],
  ["archive", /^(zip|rar|7z|t?gz|bz2|xz|tar|bcf|bcfzip)$/],
];

/** The beginnings of files, perhaps with what follows soon, and the names of the formats. */
const marks: [kind: ForeignKind, format: string, mark: string, soon?: string][] = [
  ["model", "IFC", "ISO-10303-21;", "FILE_SCHEMA(('IFC"],
  ["model", "STEP", "ISO-10303-21;"],
  ["model", "SketchUp", "\xff\xfe\xff\x0eS\0k\0e\0t\0c\0h\0U\0p\0"],
  ["mesh", "FBX", "Kaydara FBX"],
  ["spreadsheet", "XLSX", "PK\x03\x04", "[Content_Types].xml"],
  ["spreadsheet", "ODS", "PK\x03\x04", "opendocument.spreadsheet"],
  ["archive", "ZIP", "PK\x03\x04"],
  ["archive", "RAR", "Rar!\x1a\x07"],
  ["archive", "7-Zip", "7z\xbc\xaf\x27\x1c"],
  ["document", "Office", "\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"],
  ["picture", "GIF", "GIF8"],
  ["picture", "TIFF", "II*\0"],
  ["picture", "TIFF", "MM\0*"],
  ["picture", "HEIC", "ftyphei"],
  ["picture", "HEIC", "ftypmif1"],
  ["picture", "AVIF", "ftypavi"],
];

/** `beginning`: some kilobytes of the file, a letter for each byte. The name says more of formats that share a mark. */
export function foreignOf(beginning: string, name: string): { kind: ForeignKind; format: string } | null {
  const extension = /\.(\w+)$/.exec(name)?.[1].toLowerCase() ?? "";
  const named = extensions.find(([, known]) => known.test(extension));
  if (named) return { kind: named[0], format: extension.toUpperCase() };
  const words = beginning.replace(/^\xef\xbb\xbf/, "").trimStart();
  const begins = (mark: string) =>
    words.startsWith(mark) || beginning.startsWith(mark, mark.startsWith("ftyp") ? 4 : 0);
  const marked = marks.find(([, , mark, soon = ""]) => begins(mark) && words.replace(/ /g, "").includes(soon));
  if (marked) return { kind: marked[0], format: marked[1] };
  return extension === "pdf" ? { kind: "no_pdf", format: "PDF" } : null;
}
