// Runs Chromium without a window through the DevTools protocol.

import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";

export async function startBrowser(program) {
  const { WebSocket } = createRequire(`${process.env.VIEWER_PACKAGES}/`)("ws");
  const profile = mkdtempSync(join(tmpdir(), "viewer-"));
  const child = spawn(
    program,
    [
      "--headless=new",
      "--no-sandbox",
      "--disable-dev-shm-usage",
      "--no-first-run",
      "--hide-scrollbars",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--remote-debugging-port=0",
      `--user-data-dir=${profile}`,
      "about:blank",
    ],
    { stdio: ["ignore", "ignore", "pipe"] },
  );
  const address = await new Promise((found, failed) => {
    let text = "";
    child.stderr.on("data", (data) => {
      text += data;
      const match = /DevTools listening on (ws:\S+)/.exec(text);
      if (match) found(match[1]);
    });
    child.on("exit", () => failed(new Error(`${program} did not start:\n${text}`)));
  });
  const socket = new WebSocket(address, { perMessageDeflate: false, maxPayload: 1 << 28 });
  await new Promise((opened, failed) => socket.on("open", opened).on("error", failed));

  let last = 0;
  const waiting = new Map();
  const pages = new Map(); // by session
  socket.on("message", (data) => {
    const message = JSON.parse(data);
    if (!message.id) return pages.get(message.sessionId)?.note(message);
    const { resolve, reject } = waiting.get(message.id);
    waiting.delete(message.id);
    if (message.error) reject(new Error(message.error.message));
    else resolve(message.result);
  });
  const send = (method, params = {}, sessionId) =>
    new Promise((resolve, reject) => {
      waiting.set(++last, { resolve, reject });
      socket.send(JSON.stringify({ id: last, method, params, sessionId }));
    });

  return {
    /**
     * Opens a page of a size in CSS pixels, and records every network request and every error. `before` runs before
     * the page is loaded. Waits until the 3-D view is ready.
     */
    async page(url, { width = 1000, height = 600, dark = false, ready = true, before = () => {} } = {}) {
      const { targetId } = await send("Target.createTarget", { url: "about:blank" });
      const { sessionId } = await send("Target.attachToTarget", { targetId, flatten: true });
      const page = new Page(targetId, (method, params) => send(method, params, sessionId));
      pages.set(sessionId, page);
      for (const domain of ["Page", "Runtime", "Network", "Log"]) await page.send(`${domain}.enable`);
      await page.send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
      await page.darken(dark);
      await before(page);
      await page.go(url);
      if (ready) await page.evaluate("window.shelfbeamViewer.then(() => true)");
      return page;
    },
    async closePages() {
      for (const { targetId } of pages.values()) await send("Target.closeTarget", { targetId });
      pages.clear();
    },
    async close() {
      socket.close();
      child.removeAllListeners("exit");
      const ended = new Promise((done) => child.once("exit", done));
      child.kill();
      await ended;
      rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
    },
  };
}

class Page {
  requests = [];
  errors = [];
  #loaded = () => {};

  constructor(targetId, send) {
    this.targetId = targetId;
    this.send = send;
  }

  note({ method, params }) {
    if (method === "Page.loadEventFired") this.#loaded();
    if (method === "Network.requestWillBeSent") this.requests.push(params.request.url);
    if (method === "Runtime.exceptionThrown")
      this.errors.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
    if (method === "Log.entryAdded" && params.entry.level === "error") this.errors.push(params.entry.text);
    if (method === "Runtime.consoleAPICalled" && params.type === "error")
      this.errors.push(params.args.map(({ value, description }) => value ?? description).join(" "));
  }

  async go(url) {
    const loaded = new Promise((done) => (this.#loaded = done));
    await this.send("Page.navigate", { url });
    await loaded;
  }

  darken(dark) {
    const value = dark ? "dark" : "light";
    return this.send("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value }] });
  }

  /** The value of an expression in the page, or of a function called there with JSON arguments. */
  async evaluate(code, ...values) {
    const { result, exceptionDetails } = await this.send("Runtime.evaluate", {
      expression: typeof code === "function" ? `(${code})(...${JSON.stringify(values)})` : code,
      awaitPromise: true,
      returnByValue: true,
    });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  /** Calls a function in the page with the 3-D view (`view`) and JSON arguments. */
  run(call, ...values) {
    return this.evaluate(`window.shelfbeamViewer.then((view) => (${call})(view, ...${JSON.stringify(values)}))`);
  }

  /** Waits until all changes are drawn. */
  settle() {
    return this.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))");
  }

  text(selector) {
    return this.evaluate((of) => document.querySelector(of).textContent, selector);
  }

  focus(selector) {
    return this.evaluate((of) => document.querySelector(of).focus(), selector);
  }

  type(text) {
    return this.send("Input.insertText", { text });
  }

  async click(x, y) {
    const at = { x, y, button: "left", clickCount: 1 };
    await this.send("Input.dispatchMouseEvent", { type: "mouseMoved", x, y });
    await this.send("Input.dispatchMouseEvent", { type: "mousePressed", ...at });
    await this.send("Input.dispatchMouseEvent", { type: "mouseReleased", ...at });
    await this.settle();
  }

  /** Clicks the upper left corner of an element. */
  async clickOn(selector) {
    const { x, y } = await this.evaluate((of) => {
      const element = document.querySelector(of);
      element.scrollIntoView({ block: "center" });
      return element.getBoundingClientRect().toJSON();
    }, selector);
    await this.click(x + 8, y + 8);
  }

  async press(key) {
    const codes = { Tab: 9, Enter: 13, " ": 32, ArrowLeft: 37, ArrowRight: 39, Escape: 27 };
    const text = { Enter: "\r", " ": " " }[key];
    const params = { key, code: key === " " ? "Space" : key, windowsVirtualKeyCode: codes[key] };
    await this.send("Input.dispatchKeyEvent", { type: text ? "keyDown" : "rawKeyDown", text, ...params });
    await this.send("Input.dispatchKeyEvent", { type: "keyUp", ...params });
    await this.settle();
  }

  async screenshot(clip) {
    const picture = { format: "png", captureBeyondViewport: true, clip: { ...clip, scale: 1 } };
    return Buffer.from((await this.send("Page.captureScreenshot", picture)).data, "base64");
  }
}
