// A project folder with a copy of an example or without anything, and `shelfbeam serve` for it behind a wire.

import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";

import { parse } from "./jsonc.mjs";
import { serve } from "./server.mjs";
import { Wire } from "./wire.mjs";

export class Served {
  /** `example`: null for an empty folder. `prepare` gets the folder before the program starts. */
  constructor(program, example, work, prepare, hasLight) {
    this.program = program;
    // The light of a shop takes all processors, so only tests that look at it have it.
    this.options = hasLight ? [] : ["--no-light"];
    this.folder = mkdtempSync(join(work, `${example === null ? "empty" : basename(example)}-`));
    if (example !== null) cpSync(example, this.folder, { recursive: true });
    prepare(this.folder);
    this.first = example === null ? null : this.text;
  }

  get text() {
    return readFileSync(join(this.folder, "store.json"), "utf8");
  }

  get json() {
    return parse(this.text);
  }

  async start(packages) {
    this.running = await serve(this.program, this.folder, ...this.options);
    this.wire = new Wire(this.running.address, packages);
    this.url = await this.wire.listen();
  }

  /** Another program writes the file. */
  write(text) {
    writeFileSync(join(this.folder, "store.json"), text);
  }

  /** Ends the program; its address then refuses connections. */
  async end() {
    const { running, wire } = this;
    this.running = null;
    await wire?.close();
    await running?.end();
    this.wire = null;
  }

  async close() {
    await this.end();
    rmSync(this.folder, { recursive: true, force: true });
  }
}
