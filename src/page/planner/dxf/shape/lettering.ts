// Where and how texts stand.

import type { Entity } from "../file/entity";
import { plainParagraphs, plainText } from "../text";
import { radians } from "./angle";

type Pair = [number, number];

export interface Lettering {
  text: string;
  at: Pair;
  /** The place of `at` in the box of the text, from its left and from its lower end, 0 to 1. */
  anchor: Pair;
  /** In the direction of reading, with length 1. */
  along: Pair;
  /** To the upper end of a letter. */
  up: Pair;
  /** `at` is in the plane of the entity. */
  isPlanar: boolean;
}

const anchors: readonly number[] = [0, 0.5, 1];

function directions(degrees: number, height: number): { along: Pair; up: Pair } {
  const [c, s] = [Math.cos(radians(degrees)), Math.sin(radians(degrees))];
  return { along: [c, s], up: [-s * height, c * height] };
}

/** A text of one line. */
export function letteringOf(entity: Entity): Lettering {
  const across = entity.number(72);
  const upwards = entity.number(entity.type === "TEXT" ? 73 : 74);
  const isMiddle = across === 4;
  // Stretched from its first point to its second.
  const isStretched = across === 3 || across === 5;
  const isAligned = !isStretched && (across !== 0 || upwards !== 0) && entity.has(11);
  return {
    text: plainText(entity.text(1)),
    at: entity.point(isAligned ? 11 : 10),
    anchor: isAligned
      ? [isMiddle ? 0.5 : (anchors[across] ?? 0), isMiddle ? 0.5 : (anchors[upwards - 1] ?? 0)]
      : [0, 0],
    ...directions(entity.number(50), entity.number(40)),
    isPlanar: true,
  };
}

export function paragraphsOf(entity: Entity): Lettering {
  const place = entity.number(71, 1) - 1;
  const degrees = entity.has(11) ? directionIn(entity) : entity.number(50);
  return {
    text: plainParagraphs(entity.longText()),
    at: entity.point(10),
    anchor: [anchors[place % 3] ?? 0, anchors[2 - Math.floor(place / 3)] ?? 1],
    ...directions(degrees, entity.number(40)),
    isPlanar: false,
  };
}

/** The direction of reading is given in the block, and wanted in the plane of the entity. */
function directionIn(entity: Entity): number {
  const [a, b, c, d] = entity.ocs();
  const [x, y] = entity.point(11);
  const determinant = a * d - b * c || 1;
  return (Math.atan2((a * y - b * x) / determinant, (d * x - c * y) / determinant) * 180) / Math.PI;
}
