// The colours of layers, made readable on white.

type Rgb = [number, number, number];

/** Colours 1 to 9. */
const first: readonly number[] = [
  0xff0000, 0xffff00, 0x00ff00, 0x00ffff, 0x0000ff, 0xff00ff, 0xffffff, 0x808080, 0xc0c0c0,
];
const greys: readonly number[] = [51, 80, 105, 130, 190, 255];
const values: readonly number[] = [255, 165, 127, 76, 38];

const parts = (rgb: number): Rgb => [(rgb >> 16) & 255, (rgb >> 8) & 255, rgb & 255];

/** Of AutoCAD's colour index, 1 to 255: 24 hues, each in five values, full or pale. */
export function colourOfIndex(index: number): Rgb {
  if (index >= 1 && index <= 9) return parts(first[index - 1]);
  if (index >= 250 && index <= 255) return [greys[index - 250], greys[index - 250], greys[index - 250]];
  if (!(index >= 10 && index < 250)) return [0, 0, 0];
  const value = values[(index % 10) >> 1];
  const least = index % 2 === 1 ? Math.floor(value / 2) : 0;
  const hue = Math.floor(index / 10 - 1) / 4;
  return [0, 4, 2].map((shift) => {
    const k = (hue + shift) % 6;
    const share = Math.min(Math.max(Math.abs(k - 3) - 1, 0), 1);
    return Math.floor(least + (value - least) * share);
  }) as Rgb;
}

export const colourOfNumber = (rgb: number): Rgb => parts(rgb);

const linear = (part: number): number => (part <= 10 ? part / 3295 : ((part / 255 + 0.055) / 1.055) ** 2.4);

/** Of light that the colour reflects, relative to white. */
export const luminance = ([r, g, b]: Rgb): number => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);

/** A contrast of 3 to 1 with white. */
const mostLuminance = 0.3;

/** Light greys are for a dark ground: on white they become as dark. Other colours are darkened. */
export function onWhite(colour: Rgb): string {
  let rgb = colour;
  if (Math.max(...rgb) - Math.min(...rgb) < 16 && rgb[1] > 127) rgb = rgb.map((part) => 255 - part) as Rgb;
  while (luminance(rgb) > mostLuminance) rgb = rgb.map((part) => Math.floor(0.96 * part)) as Rgb;
  return `#${rgb.map((part) => part.toString(16).padStart(2, "0")).join("")}`;
}
