// The groups of one entity. One object serves all entities of a file, one after the other.

import { identity, type Matrix, ocsMatrix } from "../shape/matrix";
import type { Groups } from "./groups";
import { Numbers } from "./numbers";

/** Of the groups that the reader uses. */
const isNumber = (code: number): boolean =>
  code < 100 ? (code >= 10 && code < 80) || code >= 90 : (code >= 210 && code <= 230) || code === 420;

export class Entity extends Numbers {
  type = "";
  layer = "0";
  isInvisible = false;
  isInPaperSpace = false;
  private readonly texts: { code: number; text: string }[] = [];

  /** Reads up to the next group 0. `isDrawn`: whether its numbers matter. */
  read(groups: Groups, isDrawn: boolean): void {
    this.type = groups.name();
    this.layer = "0";
    this.isInvisible = this.isInPaperSpace = false;
    this.clear();
    if (this.texts.length > 0) this.texts.length = 0;
    let isEmbedded = false;
    for (groups.advance(); groups.code !== 0; groups.advance()) {
      const { code } = groups;
      // An object within the entity, with codes of its own.
      if (code === 101) isEmbedded = true;
      if (isEmbedded || code >= 999) continue;
      if (code === 8) this.layer = groups.name();
      else if (code === 60) this.isInvisible = groups.number() !== 0;
      else if (code === 67) this.isInPaperSpace = groups.number() !== 0;
      else if (isDrawn && code <= 3 && code > 0)
        this.texts.push({ code, text: code === 2 ? groups.name() : groups.text() });
      else if (isDrawn && isNumber(code)) this.add(code, groups.number());
    }
  }

  text(code: number): string {
    return this.texts.find((one) => one.code === code)?.text ?? "";
  }

  /** A long text stands in several groups 3, and ends with group 1. */
  longText(): string {
    return this.texts.map(({ code, text }) => (code === 3 || code === 1 ? text : "")).join("");
  }

  /** From the plane of the entity to its block, by its normal and elevation. */
  ocs(): Matrix {
    const [x, y, z] = this.normal();
    if (x === 0 && y === 0 && z > 0) return identity;
    return ocsMatrix(x, y, z, this.number(38, this.number(30)));
  }

  normal(): [number, number, number] {
    return [this.number(210), this.number(220), this.number(230, 1)];
  }

  /** Whether its plane is not parallel to the plan. */
  get isTilted(): boolean {
    const [x, y, z] = this.normal();
    return Math.hypot(x, y) > 1e-9 * Math.abs(z);
  }
}
