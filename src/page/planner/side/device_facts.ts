// Facts about a label or unit that is not an element of its own.

import type { DeviceAnswer, LabelPlace } from "../document/messages";
import { lengthText, type LengthUnit } from "../geometry/units";
import { say, text } from "../text";

type Facts = [string, string][];

/** "G3, back, board 2, at 1.20 m". */
export function placeText(place: LabelPlace, unit: LengthUnit): string {
  const names = text.label_place;
  return [
    place.fixture ?? say(names.wall, place.wall ?? ""),
    place.face === null ? null : (text.options as Record<string, string>)[place.face],
    place.on_top ? names.on_top : null,
    place.board > 0 ? say(names.board, place.board) : null,
    say(names.along, lengthText(place.along, unit)),
  ]
    .filter((part) => part !== null)
    .join(", ");
}

/** The angle in degrees by which a direction is above the horizontal. */
export function tiltOf([x, y, z]: number[]): number {
  return (Math.atan2(z, Math.hypot(x, y)) * 180) / Math.PI;
}

/** `hasType`: no field shows it. */
export function deviceFacts(answer: DeviceAnswer, unit: LengthUnit, hasType = true): Facts {
  const facts: Facts = [];
  if (answer.description) facts.push([text.fields.description, answer.description]);
  if (answer.place) facts.push([text.label_place.title, placeText(answer.place, unit)]);
  if (hasType) facts.push([text.fields.type, answer.type]);
  facts.push([text.fields.position, answer.position.map((value) => value.toFixed(2)).join(", ") + "\u00a0m"]);
  if (answer.normal) facts.push([text.fields.tilt_deg, `${Math.round(tiltOf(answer.normal))}°`]);
  facts.push([text.properties.source, answer.source]);
  return facts;
}
