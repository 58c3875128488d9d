// The planogram of a shop of 1,200 articles for the example grocery, as a German program exports it: foreign names of
// fixtures and label types, and 3 % of bad lines.

export const articles = 1200;

const rows = ["A1", "A2", "A3", "A4"];
const sides = { front: "vorne", back: "hinten" };

/** Names in the file that are not like those of the shop. */
export const names = {
  "Wandregal Nord": "W1",
  "Wandregal West": "W2",
  "Truhe vorn": "F1",
  "Truhe hinten": "F2",
  "Obst links": "P1",
  "Obst rechts": "P2",
};
export const types = { Groß: "large", Tiefkühl: "freezer" };

const edge = (fixture, side, board, type, most) => ({ fixture, side, board, type, most, count: 0 });
const boards = (count, make) => Array.from({ length: count }, (_, k) => make(k + 1));

const edges = () => [
  ...rows.flatMap((row) =>
    Object.values(sides).flatMap((side) => boards(4, (k) => edge(`Gondel ${row}`, side, k, "Standard", 60))),
  ),
  ...rows.flatMap((row) =>
    ["west", "east"].flatMap((end) => boards(2, (k) => edge(`Stirn ${row} ${end}`, "vorne", k, "Standard", 4))),
  ),
  ...boards(4, (k) => edge("Wandregal Nord", "vorne", k, "Standard", 90)),
  ...boards(4, (k) => edge("Wandregal West", "vorne", k, "Standard", 45)),
  edge("Truhe vorn", "vorne", 1, "Tiefkühl", 30),
  edge("Truhe hinten", "hinten", 1, "Tiefkühl", 30),
  ...["Obst links", "Obst rechts"].flatMap((table) =>
    Object.values(sides).flatMap((side) => boards(2, (k) => edge(table, side, k, "Groß", 12))),
  ),
];

const replaced = (line, at, field) => line.map((own, k) => (k === at ? field : own));

/** Ways to spoil the fields of a line, with what the page says about it. */
const mistakes = [
  [(line) => ["", ...line.slice(1)], "No article"],
  [(line) => replaced(line, 2, "Lager"), "Unknown fixture “Lager”"],
  [(line) => replaced(line, 4, "9"), "No board “9”: the fixture has"],
  [(line) => replaced(line, 5, "neben 1 und 2"), "“neben 1 und 2” is not a number"],
  [(line) => line.slice(0, 5), "Too few fields"],
  [(line) => [...line, "x"], "Too many fields"],
  [(line) => replaced(line, 0, "4,00638E+12"), "A spreadsheet has shortened “4,00638E+12”"],
  [(line) => replaced(line, 3, "unten"), "Unknown face “unten”"],
  [(line) => replaced(line, 1, '"Brot'), "A quote is not closed"],
];

const ean = (k) => {
  const digits = `400168${String(630000 + k)}`;
  const sum = [...digits].reduce((total, digit, place) => total + Number(digit) * (place % 2 === 0 ? 1 : 3), 0);
  return `${digits}${(10 - (sum % 10)) % 10}`;
};

/** `month`: articles and bad lines differ. The file, and its bad lines with the words of the page. */
export function planogramFile(month = 0) {
  const all = edges();
  const bad = [];
  const lines = ["Artikelnummer;Artikelbezeichnung;Regal;Seite;Fachboden;Platz;Etikettentyp;Neigung"];
  for (let k = 0, at = 0; k < articles; ++at) {
    const place = all[at % all.length];
    if (place.count === place.most) continue;
    const tilt = place.type === "Groß" ? "12,5" : "";
    const line = [
      ean(k + 7 * month),
      `Müsli \x96 ${k}${k % 10 === 0 ? "; mit Nüssen" : ""}`,
      place.fixture,
      place.side,
      String(place.board),
      String(++place.count),
      place.type,
      tilt,
    ];
    const written = line.map((field) => (field.includes(";") ? `"${field}"` : field));
    ++k;
    const isBad = k % 33 === 5 + month && bad.length < 36;
    if (isBad) {
      const [spoil, words] = mistakes[bad.length % mistakes.length];
      bad.push({ line: lines.length + 1, words });
      lines.push(spoil(written).join(";"));
    } else lines.push(written.join(";"));
  }
  // In Windows-1252, 96 is a dash; its other letters are those of Latin-1.
  return { file: Buffer.from(`${lines.join("\r\n")}\r\n`, "latin1"), bad };
}
