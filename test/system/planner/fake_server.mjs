// A server for the page without the program: it applies edits to the JSON of a store in memory. Deleted when the program
// serves the page.

import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { basename, dirname, join } from "node:path";

import { effective, resolve } from "./fake_resolve.mjs";
import { parse } from "./jsonc.mjs";

const policy =
  "default-src 'none'; script-src 'self'; worker-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src 'self'; " +
  "frame-ancestors 'none'; base-uri 'none'; form-action 'none'";
const types = {
  html: "text/html; charset=utf-8",
  css: "text/css; charset=utf-8",
  js: "text/javascript; charset=utf-8",
  svg: "image/svg+xml",
};

const tokensOf = (pointer) =>
  pointer
    .split("/")
    .slice(1)
    .map((token) => token.replaceAll("~1", "/").replaceAll("~0", "~"));
const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

export function applied(json, ops) {
  const root = structuredClone(json);
  for (const { path, before, after } of structuredClone(ops)) {
    const tokens = tokensOf(path);
    const key = tokens.pop();
    let parent = root;
    for (const token of tokens) parent = parent?.[token];
    if (typeof parent !== "object" || parent === null) throw new Error(`${path}: there is no such place`);
    const isInsertion = Array.isArray(parent) && before === undefined;
    if (!isInsertion && !same(parent[key], before)) throw new Error(`${path}: is not as expected`);
    if (Array.isArray(parent)) {
      if (before === undefined) parent.splice(Number(key), 0, after);
      else if (after === undefined) parent.splice(Number(key), 1);
      else parent[key] = after;
    } else if (after === undefined) delete parent[key];
    else parent[key] = after;
  }
  return root;
}

const inverse = (ops) => [...ops].reverse().map(({ path, before, after }) => ({ path, before: after, after: before }));

function frame(about, arrays) {
  const header = Buffer.from(
    JSON.stringify({ about, arrays: arrays.map(({ name, type, values }) => ({ name, type, count: values.length })) }),
  );
  const size = Buffer.alloc(4);
  size.writeUInt32LE(header.length);
  return Buffer.concat([size, header, ...arrays.map(({ values }) => Buffer.from(values.buffer))]);
}

function deviceFrame(event, devices, revision, remove) {
  const [direction, state] = event === "labels" ? ["normal", "level"] : ["axis", "state"];
  return frame({ event, revision, from: 0, remove }, [
    { name: "position", type: "f32", values: Float32Array.from(devices.flatMap(({ at }) => at)) },
    { name: direction, type: "f32", values: Float32Array.from(devices.flatMap(({ normal }) => normal)) },
    { name: state, type: "u8", values: Uint8Array.from(devices, ({ level }) => level) },
    { name: "source_kind", type: "u8", values: Uint8Array.from(devices, ({ kind }) => kind) },
    { name: "source", type: "u32", values: Uint32Array.from(devices, ({ source }) => source) },
  ]);
}

function sceneFrame({ parts }, revision) {
  const shown = parts.filter(({ kind }) => kind === "fixture" || kind === "wall");
  const all = parts.flatMap(({ outline }) => outline);
  const [lower, upper] = [Math.min, Math.max].map((pick) =>
    [0, 1].map((axis) => pick(...all.map((point) => point[axis]))),
  );
  return frame({ revision, lower: [...lower, 0], upper: [...upper, parts[0]?.height ?? 3] }, [
    { name: "part_look", type: "u8", values: Uint8Array.from(shown, ({ type }) => (type === "freezer" ? 1 : 0)) },
    { name: "part_corners", type: "u8", values: Uint8Array.from(shown, ({ outline }) => outline.length) },
    { name: "part_outline", type: "f32", values: Float32Array.from(shown.flatMap(({ outline }) => outline.flat())) },
    { name: "part_height", type: "f32", values: Float32Array.from(shown.flatMap(({ height }) => [0, height])) },
    { name: "mesh_vertex", type: "f32", values: new Float32Array() },
    { name: "mesh_triangle", type: "u32", values: new Uint32Array() },
  ]);
}

/** A file of the page as the program sends it. */
export const asset = (folder, name) => ({
  headers: {
    "Content-Security-Policy": policy,
    "Content-Type": types[name.split(".")[1]],
    "Content-Encoding": "gzip",
  },
  bytes: readFileSync(join(folder, `${name}.gz`)),
});

export class FakeServer {
  /** What a wire does between page and program. */
  wire = {
    delay: 0,
    refuse: null,
    cut: () => {
      for (const { socket } of this.tabs) socket.terminate();
    },
  };
  tabs = new Set();

  constructor(store, page, packages) {
    this.page = page;
    this.file = store;
    this.json = parse(readFileSync(store, "utf8"));
    this.first = this.text;
    this.steps = [];
    this.position = 0;
    this.revision = 1;
    this.locked = null;
    this.lastTab = 0;
    this.resolved = resolve(this.json);
    const { WebSocketServer } = createRequire(`${packages}/`)("ws");
    this.http = createServer((request, response) => this.serve(request, response));
    this.sockets = new WebSocketServer({ server: this.http });
    this.sockets.on("connection", (socket) => this.connect(socket));
  }

  /** Without the order of keys, which the program keeps. */
  get text() {
    const sorted = (value) =>
      Array.isArray(value)
        ? value.map(sorted)
        : typeof value === "object" && value !== null
          ? Object.fromEntries(
              Object.keys(value)
                .sort()
                .map((key) => [key, sorted(value[key])]),
            )
          : value;
    return JSON.stringify(sorted(this.json));
  }

  spoil() {
    this.locked = { message: "store.json:12: room.size[0]: is no number" };
    for (const tab of this.tabs)
      this.send(tab, {
        event: "changed",
        revision: this.revision,
        json: this.json,
        problems: [],
        history: this.history,
        locked: this.locked,
      });
  }

  async listen(port = 0) {
    await new Promise((done) => this.http.listen(port, "127.0.0.1", done));
    this.url = `http://127.0.0.1:${this.http.address().port}/token/`;
    return this.url;
  }

  close() {
    for (const { socket } of this.tabs) socket.terminate();
    this.http.closeAllConnections?.();
    return new Promise((done) => this.http.close(done));
  }

  serve(request, response) {
    const name = request.url.replace("/token/", "") || "index.html";
    if (name === "scene") {
      response.setHeader("Content-Type", "application/octet-stream");
      response.end(sceneFrame(this.resolved, this.revision));
      return;
    }
    if (!/^[a-z]+\.(html|js|css|svg)$/.test(name)) {
      response.statusCode = 404;
      response.end();
      return;
    }
    const { headers, bytes } = asset(this.page, name);
    response.writeHead(200, headers);
    response.end(bytes);
  }

  connect(socket) {
    const tab = { socket, number: ++this.lastTab };
    this.tabs.add(tab);
    socket.on("close", () => this.tabs.delete(tab));
    socket.on("message", (data) => setTimeout(() => this.receive(tab, JSON.parse(data)), this.wire.delay));
    const { json, resolved, revision, locked } = this;
    this.send(tab, {
      event: "project",
      name: json.name ?? "",
      file: basename(this.file),
      version: "0.0.0",
      tab: tab.number,
      revision,
      json,
      unit: json.units ?? "m",
      parts: resolved.parts,
      problems: resolved.problems,
      history: this.history,
      locked,
      shared: this.shared,
    });
    this.sendDevices(tab, { labels: [], units: [] });
    this.send(tab, { event: "warnings", revision, warnings: this.warnings ?? [] });
  }

  get shared() {
    const names = {};
    for (const file of this.json.catalogues ?? []) {
      const content = parse(readFileSync(join(dirname(this.file), file), "utf8"));
      for (const list of ["presets", "materials", "label_types", "transceiver_types"])
        names[list] = Object.keys(content[list] ?? {});
    }
    return names;
  }

  get history() {
    return { steps: this.steps.map(({ label, time }) => ({ label, time })), position: this.position };
  }

  send({ socket }, message) {
    socket.send(JSON.stringify(message));
  }

  sendDevices(tab, before) {
    const { labels, units } = this.resolved;
    tab.socket.send(deviceFrame("labels", labels, this.revision, before.labels.length));
    tab.socket.send(deviceFrame("units", units, this.revision, before.units.length));
  }

  /** Tells all tabs about another store. */
  change(json, cause) {
    const before = this.resolved;
    const known = new Map(before.parts.map((part) => [part.key, JSON.stringify(part)]));
    this.json = json;
    this.resolved = resolve(json);
    ++this.revision;
    const set = this.resolved.parts.filter((part) => known.get(part.key) !== JSON.stringify(part));
    const keys = new Set(this.resolved.parts.map(({ key }) => key));
    const remove = [...known.keys()].filter((key) => !keys.has(key));
    const event = {
      event: "changed",
      revision: this.revision,
      ...cause,
      parts: { set, remove },
      problems: this.resolved.problems,
      history: this.history,
      locked: this.locked,
    };
    for (const tab of this.tabs) {
      this.send(tab, event);
      this.sendDevices(tab, before);
    }
  }

  receive(tab, { id, do: what, ...members }) {
    const answer = (found) => this.send(tab, { id, ...found });
    try {
      answer(this.answer(tab, id, what, members));
    } catch (error) {
      answer({ error: { message: error.message } });
    }
  }

  answer(tab, id, what, members) {
    const cause = { tab: tab.number, request: id };
    if (what === "edit") {
      if (this.wire.refuse) throw new Error(this.wire.refuse);
      const json = applied(this.json, members.ops);
      this.steps.length = this.position;
      const last = this.steps.at(-1);
      const paths = (ops) => JSON.stringify(ops.map(({ path }) => path));
      if (members.join && last?.join && paths(last.ops) === paths(members.ops) && Date.now() - last.at < 800) {
        last.ops = last.ops.map((op, k) => ({ ...op, after: members.ops[k].after }));
        last.at = Date.now();
      } else
        this.steps.push({
          label: members.label,
          ops: members.ops,
          join: members.join,
          at: Date.now(),
          time: new Date().toISOString(),
        });
      this.position = this.steps.length;
      this.change(json, { ...cause, ops: members.ops });
      return { revision: this.revision };
    }
    if (what === "undo" || what === "redo" || what === "go") {
      const to = { undo: this.position - 1, redo: this.position + 1, go: members.position }[what];
      if (to < 0 || to > this.steps.length) throw new Error("there is no such step");
      let { json } = this;
      for (; this.position > to; --this.position) json = applied(json, inverse(this.steps[this.position - 1].ops));
      for (; this.position < to; ++this.position) json = applied(json, this.steps[this.position].ops);
      this.change(json, { ...cause, json });
      return { revision: this.revision };
    }
    if (what === "details") return this.details(members.path);
    if (what === "device") {
      const device = this.resolved[members.kind === "label" ? "labels" : "units"][members.index];
      const list = members.kind === "label" ? ["/labels", "/fixtures"] : ["/transceivers/list", "/transceivers/grids"];
      const path = `${list[device.kind]}/${device.source}`;
      return { device: { id: device.id, type: device.type, position: device.at, path, source: path.slice(1) } };
    }
    if (what === "find") return { hits: this.find(members.text.toLowerCase()) };
    if (what === "dissolve") return this.dissolve(members, cause);
    if (what === "restore") {
      this.locked = null;
      this.change(this.json, { ...cause, json: this.json });
      return { revision: this.revision };
    }
    throw new Error(`'${what}' is not known`);
  }

  details(path) {
    const element = tokensOf(path).reduce((value, token) => value?.[token], this.json);
    if (!element) throw new Error("there is no such element");
    const value = effective(this.json, element);
    return {
      effective: value,
      units: {},
      resolved: { ...value, stocking: value.stocking ?? 0.8, goods: value.goods ?? value.material },
    };
  }

  find(text) {
    const { parts, labels, units } = this.resolved;
    const fixtures = parts.filter(({ id }) => id.toLowerCase().includes(text));
    const devices = (kind, list) =>
      list.flatMap(({ id, at }, index) =>
        id.toLowerCase().includes(text) ? [{ kind, id, index, at: at.slice(0, 2) }] : [],
      );
    const hits = fixtures.map(({ kind, id, path, outline }) => ({ kind, id, path, at: outline[0] }));
    return [...hits, ...devices("label", labels), ...devices("unit", units)].slice(0, 50);
  }

  dissolve({ path, label }, cause) {
    const index = Number(path.split("/").pop());
    const { repeat: _repeat, ...value } = effective(this.json, this.json.fixtures[index]);
    const copies = this.resolved.parts.filter((part) => part.path === path);
    const fixtures = copies.map(({ id, footing }) => ({ ...value, id, ...(footing ? { at: footing.at } : {}) }));
    const ops = [
      { path: `/fixtures/${index}`, before: this.json.fixtures[index] },
      ...fixtures.map((after, k) => ({ path: `/fixtures/${index + k}`, after })),
    ];
    this.steps.length = this.position;
    this.steps.push({ label, ops, at: 0, time: new Date().toISOString() });
    this.position = this.steps.length;
    this.change(applied(this.json, ops), { ...cause, ops });
    return { revision: this.revision };
  }
}
