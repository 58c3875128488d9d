// What one test works with: servers and tabs of its own, which end with it.

import { execFile } from "node:child_process";
import { join } from "node:path";
import { promisify } from "node:util";

import { newContext } from "../viewer/browser.mjs";
import { Served } from "./served.mjs";
import { Tab } from "./tab.mjs";

export class Workshop {
  #servers = [];
  #contexts = [];

  /** `tools`: those of planner_test.mjs, which all tests share. */
  constructor(tools) {
    this.tools = tools;
    this.axe = tools.axe;
  }

  /** `store`: the name of an example; null: an empty folder. `prepare`: gets the folder before the program starts. */
  async serve(store, prepare = () => {}, hasLight = false) {
    const { shelfbeam, packages, examples, work } = this.tools;
    const server = new Served(shelfbeam, store === null ? null : join(examples, store), work, prepare, hasLight);
    this.#servers.push(server);
    await server.start(packages);
    return server;
  }

  async tab(server, options) {
    const context = await newContext(this.tools.browser, options);
    this.#contexts.push(context);
    const tab = new Tab(await context.newPage(), server, this.tools.pictures);
    await tab.open();
    return tab;
  }

  /** What the program prints, which must succeed. Meanwhile, other tests go on. */
  async run(...words) {
    return (await promisify(execFile)(this.tools.shelfbeam, words)).stdout;
  }

  async close() {
    for (const context of this.#contexts) await context.close();
    for (const server of this.#servers) await server.close();
  }
}
