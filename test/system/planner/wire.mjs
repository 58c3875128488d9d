// A wire between page and server that can hold requests, be cut, and refuse edits.

import { createServer, request as ask } from "node:http";
import { createRequire } from "node:module";

import { poll } from "./poll.mjs";

export class Wire {
  /** Requests go on when this promise is fulfilled. */
  #free = Promise.resolve();
  #held = 0;
  #isCut = false;
  /** The reason for which edits are refused; null: they are not. */
  refuse = null;
  #pairs = new Set();

  constructor(server, packages) {
    this.server = new URL(server);
    const { WebSocket, WebSocketServer } = createRequire(`${packages}/`)("ws");
    this.http = createServer((request, response) => this.#serve(request, response));
    new WebSocketServer({ server: this.http }).on("connection", (socket, request) => {
      const { host, origin } = this.server;
      this.#join(socket, new WebSocket(`ws://${host}${request.url}`, { origin }));
    });
  }

  async listen() {
    await new Promise((done) => this.http.listen(0, "127.0.0.1", done));
    return `http://127.0.0.1:${this.http.address().port}${this.server.pathname}`;
  }

  /** Holds all requests until the returned function is called. */
  hold() {
    let release;
    this.#held = 0;
    this.#free = new Promise((done) => {
      release = done;
    });
    return release;
  }

  /** Until so many requests have come since `hold`. */
  holds(count) {
    return poll(
      () => this.#held,
      (held) => held >= count,
      (held) => `${held} of ${count} requests have come`,
    );
  }

  /** Cuts all connections, and those that the page begins until `mend`. */
  cut() {
    this.#isCut = true;
    for (const { socket } of this.#pairs) socket.terminate();
  }

  mend() {
    this.#isCut = false;
  }

  close() {
    this.cut();
    this.http.closeAllConnections?.();
    return new Promise((done) => this.http.close(done));
  }

  #serve(request, response) {
    const { hostname, port, host, origin } = this.server;
    const { method, url } = request;
    const headers = { ...request.headers, host, ...(request.headers.origin ? { origin } : {}) };
    const asked = ask({ hostname, port, method, path: url, headers }, (answer) => {
      response.writeHead(answer.statusCode, answer.headers);
      answer.pipe(response);
    }).on("error", () => response.destroy());
    request.pipe(asked);
  }

  #join(socket, server) {
    if (this.#isCut) socket.terminate();
    const pair = { socket, server };
    this.#pairs.add(pair);
    let last = new Promise((opened) => server.on("open", opened));
    socket.on("message", (data) => {
      const { id, do: what } = JSON.parse(data);
      if (this.refuse !== null && what === "edit") {
        socket.send(JSON.stringify({ id, error: { message: this.refuse } }));
        return;
      }
      const free = this.#free;
      ++this.#held;
      last = last.then(() => free).then(() => server.send(String(data)));
    });
    server.on("message", (data, isBinary) => socket.send(data, { binary: isBinary }));
    socket.on("close", () => {
      this.#pairs.delete(pair);
      server.terminate();
    });
    for (const end of [server, socket]) end.on("error", () => socket.terminate());
    server.on("close", () => socket.close());
  }
}
