// How labels look by their verdicts: shape, colour, and the patterns of previews and old values.

import type { KeyShape } from "../../panel/key";
import { patterns, shapes } from "../../scene/marks";
import { bands, verdicts, type Verdict } from "./verdicts";

/** `clear`: told apart by brightness alone. */
export const palettes = ["usual", "clear"] as const;
export type PaletteName = (typeof palettes)[number];

/** After the colours of the bands. */
const undecidedColour = bands.length;
const unknownColour = bands.length + 1;
export const plainColour = bands.length + 2;

/** The CSS variable of a band. */
export const bandColour = (band: number, palette: PaletteName): string => `--${palette === "usual" ? "m" : "c"}${band}`;

export const otherColours: Record<"undecided" | "unknown", string> = { undecided: "--open", unknown: "--cand" };

/** CSS variables, in the order of the colours of looks. */
export const colourNames = (palette: PaletteName): string[] => [
  ...bands.map((_, band) => bandColour(band, palette)),
  otherColours.undecided,
  otherColours.unknown,
  "--label",
];

/** By verdict. */
const shapeOf = Uint8Array.from(
  verdicts,
  (verdict) =>
    ({
      missed: shapes.triangle,
      undecided: shapes.square | patterns.hatched,
      unknown: shapes.disc,
      reached: shapes.disc,
    })[verdict],
);
/** By verdict; 0: that of the band. */
const colourOf = Uint8Array.from(
  verdicts,
  (verdict) => ({ missed: 0, undecided: undecidedColour, unknown: unknownColour, reached: 0 })[verdict],
);

export const keyShapes: Record<Verdict, KeyShape> = {
  missed: "triangle",
  undecided: "hatched",
  unknown: "disc",
  reached: "disc",
};

export const lookShape = (verdict: number): number => shapeOf[verdict];
export const lookColour = (verdict: number, band: number): number => colourOf[verdict] || band;

/** What is added to all marks with values. */
export const addedPatterns = (isPreview: boolean, isStale: boolean): number =>
  (isPreview ? patterns.hollow : 0) | (isStale ? patterns.pale : 0);
