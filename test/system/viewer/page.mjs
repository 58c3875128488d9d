// A page of the browser: a report, or a tab with the planner.

export class Page {
  requests = [];
  errors = [];

  constructor(page) {
    this.page = page;
    page.on("request", (request) => this.requests.push(request.url()));
    page.on("pageerror", ({ stack }) => this.errors.push(stack));
    page.on("console", (message) => message.type() === "error" && this.errors.push(message.text()));
    page.on("response", (response) => {
      if (response.status() >= 400) this.errors.push(`${response.status()} ${response.url()}`);
    });
  }

  /** The value of an expression in the page, or of a function that is called there with JSON arguments. */
  evaluate(code, ...values) {
    return this.page.evaluate(typeof code === "function" ? `(${code})(...${JSON.stringify(values)})` : code);
  }

  /** Two frames: all changes are drawn. */
  settle() {
    return this.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done()))));
  }

  text(selector) {
    return this.evaluate((of) => document.querySelector(of)?.textContent ?? null, selector);
  }

  texts(selector) {
    return this.evaluate((of) => [...document.querySelectorAll(of)].map(({ textContent }) => textContent), selector);
  }

  async press(...keys) {
    for (const key of keys) await this.page.keyboard.press(key);
    await this.settle();
  }
}
