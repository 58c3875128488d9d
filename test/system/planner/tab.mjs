// A tab of the browser with the planner. Tests drive it by the pointer and the keyboard alone; they look at the page and,
// for places, at the state that it keeps for tests.

import { join } from "node:path";

import { Page } from "../viewer/page.mjs";
import { poll } from "./poll.mjs";

const patienceForPlans = 480_000; // ms

export class Tab extends Page {
  constructor(page, server, pictures) {
    super(page);
    this.server = server;
    this.pictures = pictures;
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

  async reload() {
    await this.page.reload();
    await this.until(() => window.shelfbeamPlanner?.planner.document.isReady);
    await this.settle();
  }

  /** The result of a function that gets the objects of the page, `{ planner, page }`, and JSON arguments. */
  state(read, ...values) {
    return this.evaluate(`(${read})(window.shelfbeamPlanner, ...${JSON.stringify(values)})`);
  }

  /** Polls: the content security policy forbids the functions that the driver would inject. */
  until(condition, ...values) {
    return poll(
      () => this.evaluate(condition, ...values),
      Boolean,
      () => `${condition} ${values}`,
    );
  }

  /** As `until`, for a function that gets the objects of the page. */
  reaches(condition, ...values) {
    return poll(
      () => this.state(condition, ...values),
      Boolean,
      () => `${condition} ${values}`,
    );
  }

  /** As `reaches`, for conditions that need a simulation. */
  computes(condition, ...values) {
    return poll(
      () => this.state(condition, ...values),
      Boolean,
      () => `${condition}`,
      patienceForPlans,
    );
  }

  /** Until the 3-D view has its scene, and has placed its camera. */
  hasSpace() {
    return this.reaches(({ page: { stage } }) => stage.scenery.part.look.length > 0 && stage.drawCalls > 4);
  }

  /** Until the light is simulated. */
  lit() {
    return this.computes(({ planner }) => planner.light.event?.phase === "done");
  }

  /** Until a number of steps are applied, and the page knows that they are saved. */
  async steps(count) {
    await poll(
      () =>
        this.state(
          ({
            planner: {
              document: { history, saving },
            },
          }) => [history.position, saving.state],
        ),
      ([position, saving]) => position === count && saving === "saved",
      async (found) => `${found}, not ${count} steps: ${await this.labels()}`,
    );
    await this.settle();
  }

  /** The names of the applied steps. */
  labels() {
    return this.state(({ planner }) => {
      const { steps, position } = planner.document.history;
      return steps.slice(0, position).map(({ label }) => label);
    });
  }

  /** Until the notice has these words. */
  async notice(words) {
    await poll(
      () => this.text(".notice"),
      (text) => text.replaceAll("\u00a0", " ").includes(words),
      (text) => `the notice is '${text}', not '${words}'`,
    );
  }

  /** Takes the notice away, so that the next one is new. */
  async hush() {
    await this.state(({ planner }) => planner.say(""));
    await this.settle();
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
  at(x, y) {
    return this.state(
      ({ planner }, place) => {
        const [left, top] = planner.viewport.toScreen(place);
        const box = document.querySelector(".surface").getBoundingClientRect();
        return [Math.round(box.left + left), Math.round(box.top + top)];
      },
      [x, y],
    );
  }

  /** Runs while keys are held. */
  async holding(keys, run) {
    for (const key of keys) await this.page.keyboard.down(key);
    await run();
    for (const key of keys) await this.page.keyboard.up(key);
    await this.settle();
  }

  async point(x, y, ...keys) {
    await this.holding(keys, async () => this.page.mouse.move(...(await this.at(x, y))));
  }

  async click(x, y, { keys = [], ...options } = {}) {
    await this.holding(keys, async () => this.page.mouse.click(...(await this.at(x, y)), options));
  }

  /** Clicks on places that nothing attracts. */
  async freely(...places) {
    for (const [x, y] of places) await this.click(x, y, { keys: ["Alt"] });
  }

  /** Drags between two places of the plan. `during` runs before the button is released. */
  async drag([x, y], [u, v], options) {
    await this.dragPixels(await this.at(x, y), await this.at(u, v), options);
  }

  async dragPixels(from, to, { keys = [], button = "left", during = () => {} } = {}) {
    const { mouse } = this.page;
    await mouse.move(...from);
    await this.holding(keys, async () => {
      await mouse.down({ button });
      await mouse.move(from[0] + 0.4 * (to[0] - from[0]), from[1] + 0.4 * (to[1] - from[1]), { steps: 3 });
      await mouse.move(...to, { steps: 3 });
      await this.settle();
      await during();
      await mouse.up({ button });
    });
  }

  /** The place of a handle on the screen. */
  grip(name) {
    return this.until((of) => {
      const box = document.querySelector(`[data-grip="${of}"]`)?.getBoundingClientRect();
      return box && [box.x + box.width / 2, box.y + box.height / 2];
    }, name);
  }

  /** Turns the wheel at a place of the plan. */
  async wheel(x, y, delta, times = 1) {
    await this.page.mouse.move(...(await this.at(x, y)));
    for (let k = 0; k < times; ++k) await this.page.mouse.wheel(0, delta);
    await this.settle();
  }

  /** Replaces the text of a field, and keeps the focus there. */
  async type(key, typed) {
    await this.until((of) => document.querySelector(`[data-key="${of}"]`) !== null, key);
    await this.page.focus(`[data-key="${key}"]`);
    await this.page.keyboard.press("Control+a");
    await this.page.keyboard.insertText(typed);
  }

  /** Replaces the text of a field of the panel, and leaves it by a key. */
  async fill(key, typed, leave = "Enter") {
    await this.until((of) => document.querySelector(`[data-key="${of}"]`) !== null, key);
    await this.evaluate((of) => {
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

  /** Pushes the element with a key. */
  async use(key) {
    await this.push(`[data-key="${key}"]`);
  }

  /** Takes the first of the results, once it has this name: of commands after Ctrl+K, of elements after Ctrl+F. */
  async pick(keys, name, typed = name) {
    await this.press(keys);
    await this.page.keyboard.type(typed);
    await this.until((of) => document.querySelector(".results li span")?.textContent === of, name);
    await this.press("Enter");
  }

  async run(command) {
    await this.pick("Control+k", command);
  }

  async find(name) {
    await this.pick("Control+f", name);
    await this.until((of) => document.querySelector(".properties h2").textContent === of, name);
  }

  /** Selects the first of the elements that the list finds by a name, with the focus in the plan. */
  async list(name) {
    await this.page.fill(".objects input[type=search]", name);
    await this.settle();
    await this.page.click(".object >> nth=0");
    await this.page.focus(".surface");
  }

  has(selector) {
    return this.evaluate((of) => document.querySelector(of) !== null, selector);
  }

  count(selector) {
    return this.evaluate((of) => document.querySelectorAll(of).length, selector);
  }

  tool() {
    return this.evaluate(() => document.querySelector(".plan").dataset.tool);
  }

  /** What has the focus: its key, or otherwise its command, id, class, or kind. */
  focused() {
    return this.evaluate(() => {
      const { dataset, id, className, tagName } = document.activeElement;
      return (dataset.key ?? dataset.command ?? id) || className || tagName;
    });
  }

  /** Of the gesture. */
  scope() {
    return this.state(({ page }) => page.gestures.scope);
  }

  problems() {
    return this.state(({ planner }) => planner.document.problems.map(({ sentence }) => sentence));
  }

  selected() {
    return this.state(({ planner }) => planner.selection.items.map(({ path, key }) => key ?? path));
  }

  view() {
    return this.state(({ planner: { viewport } }) => ({ scale: viewport.scale, centre: viewport.centre }));
  }

  async picture(name) {
    await this.settle();
    await this.page.screenshot({ path: join(this.pictures, `${name}.png`) });
  }
}
