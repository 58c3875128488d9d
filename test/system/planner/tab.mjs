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
    page.on("response", (response) => {
      if (response.status() >= 400) this.errors.push(`${response.status()} ${response.url()}`);
    });
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

  /** Until a number of steps are applied, and the page knows that they are saved. */
  async steps(count) {
    const state = () => {
      const { history, saving } = window.shelfbeamPlanner.planner.document;
      return { position: history.position, saving: saving.state };
    };
    const end = Date.now() + patience;
    for (;;) {
      const { position, saving } = await this.page.evaluate(state);
      if (position === count && saving === "saved") break;
      if (Date.now() > end) throw new Error(`${position} steps and ${saving}, not ${count}: ${await this.labels()}`);
      await new Promise((done) => setTimeout(done, 15));
    }
    await this.settle();
  }

  /** The names of the applied steps. */
  labels() {
    return this.page.evaluate(() => {
      const { steps, position } = window.shelfbeamPlanner.planner.document.history;
      return steps.slice(0, position).map(({ label }) => label);
    });
  }

  /** Nothing has changed the store. */
  async isUntouched() {
    await this.settle();
    return this.server.text === this.server.first;
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
    await this.page.selectOption(`[data-key="${key}"]`, { label });
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
    writeFileSync(join(this.pictures, `${name}.png`), await this.page.screenshot());
  }
}
