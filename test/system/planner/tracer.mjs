// A person who traces a picture: clicks at whole pixels that are up to two pixels beside what is meant, drags, typed
// fields, and the wheel. All but the wheel and single keys count as actions.

import { pixelAt } from "./floor_plan.mjs";

export class Tracer {
  actions = 0;
  #seed = 1;

  /** `pixelOf`: the place of a point of the shop in the picture. */
  constructor(tab, pixelOf) {
    this.tab = tab;
    this.pixelOf = pixelOf;
  }

  #unsteady() {
    this.#seed = (Math.imul(this.#seed, 1103515245) + 12345) & 0x7fffffff;
    return ((this.#seed >> 16) % 5) - 2;
  }

  #screen(point) {
    return pixelAt(this.tab, ...this.pixelOf(point));
  }

  /**
   * Zooms by the wheel until the point is on the plan, and a metre of the shop has so many pixels, or fewer, so that
   * `others` are on the plan, too.
   */
  async look(point, pixels = 110, others = []) {
    const { tab } = this;
    const { mouse } = tab.page;
    const { x, y, width, height } = await tab.page.locator(".surface").boundingBox();
    const turn = async ([u, v], delta) => {
      await mouse.move(Math.round(u), Math.round(v));
      await mouse.wheel(0, delta);
      await tab.settle();
    };
    const margin = 60;
    const isSeen = async (which) => {
      const [u, v] = await this.#screen(which);
      return u - x > margin && v - y > margin && u - x < width - margin && v - y < height - margin;
    };
    let isFar = false;
    for (let k = 0; k < 60; ++k) {
      const [place, beside] = [await this.#screen(point), await this.#screen([point[0] + 1, point[1]])];
      const now = Math.hypot(beside[0] - place[0], beside[1] - place[1]);
      const seen = await Promise.all(others.map(isSeen));
      isFar ||= now >= pixels && seen.includes(false);
      if (!(await isSeen(point)) || seen.includes(false)) await turn([x + 0.5 * width, y + 0.5 * height], 300);
      else if (now < pixels && !isFar)
        await turn(place, -Math.min(200, Math.ceil(Math.log(pixels / now) / 0.0018) + 10));
      else return;
    }
    throw new Error(`cannot look at ${point}`);
  }

  async #aim(point) {
    const [x, y] = await this.#screen(point);
    const place = [Math.round(x) + this.#unsteady(), Math.round(y) + this.#unsteady()];
    await this.tab.page.mouse.move(place[0] - 7, place[1] + 3);
    await this.tab.page.mouse.move(...place);
    await this.tab.settle();
    return place;
  }

  async click(point, { pixels } = {}) {
    ++this.actions;
    await this.look(point, pixels);
    await this.tab.page.mouse.click(...(await this.#aim(point)));
    await this.tab.settle();
  }

  async drag(from, to, { pixels } = {}) {
    const { tab } = this;
    ++this.actions;
    await this.look([0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])], pixels, [from, to]);
    await this.#aim(from);
    await tab.page.mouse.down();
    await this.#aim(to);
    await tab.page.mouse.up();
    await tab.settle();
  }

  /** Types a length or another value at the pointer. */
  async type(words, ...keys) {
    ++this.actions;
    await this.tab.page.keyboard.type(words);
    await this.tab.press(...keys);
  }

  /** A click into a field, and what is typed there. */
  async fill(key, words) {
    ++this.actions;
    const { tab } = this;
    await tab.page.click(`[data-key="${key}"]`, { clickCount: 3 });
    await tab.page.keyboard.type(words);
    await tab.press("Enter");
  }

  /** Clicks on both ends of a line. */
  async line(from, to) {
    await this.click(from);
    await this.click(to);
  }

  async choose(key, label) {
    ++this.actions;
    await this.tab.choose(key, label);
  }

  /** A tool by its key. */
  async take(key) {
    await this.tab.press(key);
  }
}
