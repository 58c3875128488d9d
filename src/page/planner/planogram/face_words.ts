// Words for the faces of fixtures in English, German, French, Spanish, Italian and Dutch.

import type { Face } from "./mapping";
import { squashed } from "./words";

const known: Record<Face, string> = {
  front:
    "front vorne vorn v vorderseite f avant devant facade delante delantera frente fronte davanti voor voorkant a 1",
  back: "back rear hinten h ruckseite ruck b arriere detras trasera dietro retro achter achterkant 2",
  left: "left links l gauche izquierda sinistra",
  right: "right rechts r droite derecha destra",
  top: "top oben oberseite deckel dessus arriba encima sopra boven",
};

const faceByWord = new Map(
  (Object.entries(known) as [Face, string][]).flatMap(([face, words]) => words.split(" ").map((word) => [word, face])),
);

export const faceNamed = (word: string): Face | undefined =>
  faceByWord.get(squashed(word)) ??
  faceByWord.get(squashed(word.replace(/\b(seite|side|face|cote|lado|lato|zijde)\b/gi, "")));
