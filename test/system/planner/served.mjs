// A project folder with a copy of an example or without anything, and `shelfbeam serve` for it behind a wire.

import { spawn } from "node:child_process";
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";

import { parse } from "./jsonc.mjs";
import { Wire } from "./wire.mjs";

export class Served {
  /** `example`: null for an empty folder. `prepare` gets the folder before the program starts. */
  constructor(program, example, work, prepare, hasLight) {
    this.program = program;
    this.hasLight = hasLight;
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
    // The light of a shop takes all processors, so only tests that look at it have it.
    const options = ["--no-browser", ...(this.hasLight ? [] : ["--no-light"])];
    this.child = spawn(this.program, ["serve", this.folder, ...options], { stdio: ["ignore", "pipe", "pipe"] });
    const address = await new Promise((found, failed) => {
      let said = "";
      const read = (data) => {
        said += data;
        const match = /http:\/\/127\S+/.exec(said);
        if (match) found(match[0]);
      };
      this.child.stdout.on("data", read);
      this.child.stderr.on("data", read);
      this.child.on("exit", () => failed(new Error(said)));
    });
    this.wire = new Wire(address.endsWith("/") ? address : `${address}/`, packages);
    this.url = await this.wire.listen();
  }

  /** Another program writes an invalid file. */
  spoil() {
    writeFileSync(join(this.folder, "store.json"), this.text.slice(0, -20));
  }

  /** Another program writes the file. */
  write(text) {
    writeFileSync(join(this.folder, "store.json"), text);
  }

  /** Ends the program; its address then refuses connections. */
  async end() {
    if (!this.child) return;
    const { child, wire } = this;
    this.child = null;
    await wire?.close();
    child.removeAllListeners("exit");
    const ended = new Promise((done) => child.once("exit", done));
    child.kill();
    await ended;
  }

  async close() {
    await this.end();
    rmSync(this.folder, { recursive: true, force: true });
  }
}
