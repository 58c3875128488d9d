// A tab of the browser with the planner. Tests drive it by the pointer and the keyboard alone; they look at the page and,
// for places, at the state that it keeps for tests.

import { writeFileSync } from "node:fs";
import { join } from "node:path";

const patience = 8000; // ms

export class Tab {
  errors = [];

  constructor(page, server, pictures) {
    this.page = page;
    this.server = server;
    this.pictures = pictures;
    page.on("pageerror", ({ stack }) => this.errors.push(stack));
    page.on("console", (message) => message.type() === "error" && this.errors.push(message.text()));
  }

  async open() {
    await this.page.goto(this.server.url);
    await this.until(
      () =>
        document.querySelector(".saving")?.dataset.state === "saved" &&
        window.shelfbeamPlanner.planner.document.isReady,
    );
    await this.settle();
  }

  /** Two frames: all changes are drawn. */
  settle() {
    return this.page.evaluate(
      () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done()))),
    );
  }

  /** Polls: the content security policy forbids the functions that the driver would inject. */
  async until(condition, ...values) {
    const end = Date.now() + patience;
    for (;;) {
      const found = await this.page.evaluate(condition, ...values);
      if (found) return found;
      if (Date.now() > end) throw new Error(`did not happen: ${condition}`);
      await new Promise((done) => setTimeout(done, 25));
    }
  }

  /** Until the server has taken a number of steps, and the page knows it. */
  async steps(count) {
    const end = Date.now() + patience;
    while (this.server.position !== count) {
      if (Date.now() > end) throw new Error(`${this.server.position} steps, not ${count}: ${this.labels}`);
      await new Promise((done) => setTimeout(done, 10));
    }
    await this.until((position) => {
      const { document: store } = window.shelfbeamPlanner.planner;
      return store.history.position === position && store.saving.state !== "saving";
    }, count);
    await this.settle();
  }

  get labels() {
    return this.server.steps.slice(0, this.server.position).map(({ label }) => label);
  }

  get json() {
    return this.server.json;
  }

  /** The place on the screen of a point of the plan, m. */
  async at(x, y) {
    return this.page.evaluate(
      ([u, v]) => {
        const [left, top] = window.shelfbeamPlanner.planner.viewport.toScreen([u, v]);
        const box = document.querySelector(".surface").getBoundingClientRect();
        return [Math.round(box.left + left), Math.round(box.top + top)];
      },
      [x, y],
    );
  }

  async point(x, y) {
    await this.page.mouse.move(...(await this.at(x, y)));
    await this.settle();
  }

  async click(x, y, options) {
    await this.page.mouse.click(...(await this.at(x, y)), options);
    await this.settle();
  }

  /** Drags between two places of the plan. `during` runs before the button is released. */
  async drag([x, y], [u, v], { keys = [], button = "left", during = () => {} } = {}) {
    await this.dragPixels(await this.at(x, y), await this.at(u, v), { keys, button, during });
  }

  async dragPixels(from, to, { keys = [], button = "left", during = () => {} } = {}) {
    const { mouse, keyboard } = this.page;
    await mouse.move(...from);
    for (const key of keys) await keyboard.down(key);
    await mouse.down({ button });
    await mouse.move(from[0] + 0.4 * (to[0] - from[0]), from[1] + 0.4 * (to[1] - from[1]), { steps: 3 });
    await mouse.move(...to, { steps: 3 });
    await this.settle();
    await during();
    await mouse.up({ button });
    for (const key of keys) await keyboard.up(key);
    await this.settle();
  }

  /** The place of a handle on the screen. */
  grip(name) {
    return this.until((of) => {
      const box = document.querySelector(`[data-grip="${of}"]`)?.getBoundingClientRect();
      return box && [box.x + box.width / 2, box.y + box.height / 2];
    }, name);
  }

  async press(...keys) {
    for (const key of keys) await this.page.keyboard.press(key);
    await this.settle();
  }

  /** Replaces the text of a field of the panel, and leaves it by a key. */
  async fill(key, typed, leave = "Enter") {
    await this.until((of) => document.querySelector(`[data-key="${of}"]`) !== null, key);
    await this.page.evaluate((of) => {
      const field = document.querySelector(`[data-key="${of}"]`);
      field.focus();
      field.select?.();
    }, key);
    await this.page.keyboard.insertText(typed);
    await this.press(leave);
  }

  async choose(key, label) {
    const option = await this.page.$(`[data-key="${key}"]`);
    await option.selectOption({ label });
    await this.settle();
  }

  async push(selector) {
    await this.until((of) => document.querySelector(of) !== null, selector);
    await this.page.click(selector);
    await this.settle();
  }

  selected() {
    return this.page.evaluate(() =>
      window.shelfbeamPlanner.planner.selection.items.map(({ path, key }) => key ?? path),
    );
  }

  text(selector) {
    return this.page.evaluate((of) => document.querySelector(of)?.textContent ?? null, selector);
  }

  view() {
    return this.page.evaluate(() => {
      const { scale, centre } = window.shelfbeamPlanner.planner.viewport;
      return { scale, centre };
    });
  }

  async picture(name) {
    await this.settle();
    await new Promise((done) => setTimeout(done, 150));
    writeFileSync(join(this.pictures, `${name}.png`), await this.page.screenshot());
  }
}
