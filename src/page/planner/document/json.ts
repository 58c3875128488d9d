// JSON values, JSON pointers (RFC 6901) and changes of values. Values are never changed in place.

export type Json = null | boolean | number | string | Json[] | JsonObject;
export interface JsonObject {
  [key: string]: Json;
}

/**
 * One change of a value. Without `before`, the value is inserted (in a list before that index, which may be its size);
 * without `after`, it is removed.
 */
export interface EditOp {
  path: string;
  before?: Json;
  after?: Json;
}

/** The value is not as the change expects. */
export class Conflict extends Error {}

export function isObject(value: Json | undefined): value is JsonObject {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

export function tokensOf(pointer: string): string[] {
  if (pointer === "") return [];
  return pointer
    .slice(1)
    .split("/")
    .map((token) => token.replaceAll("~1", "/").replaceAll("~0", "~"));
}

export function pointerTo(parent: string, ...tokens: (string | number)[]): string {
  return tokens.reduce<string>(
    (pointer, token) => `${pointer}/${String(token).replaceAll("~", "~0").replaceAll("/", "~1")}`,
    parent,
  );
}

/** The pointer to the container, and the key in it. */
export function splitPointer(pointer: string): [string, string] {
  const cut = pointer.lastIndexOf("/");
  return [pointer.slice(0, cut), tokensOf(pointer.slice(cut))[0]];
}

export function child(value: Json | undefined, token: string): Json | undefined {
  if (Array.isArray(value)) return /^(0|[1-9]\d*)$/.test(token) ? value[Number(token)] : undefined;
  return isObject(value) && Object.hasOwn(value, token) ? value[token] : undefined;
}

export function valueAt(root: Json | undefined, pointer: string): Json | undefined {
  return tokensOf(pointer).reduce<Json | undefined>(child, root);
}

export function equal(a: Json | undefined, b: Json | undefined): boolean {
  if (a === b) return true;
  if (Array.isArray(a) && Array.isArray(b)) return a.length === b.length && a.every((value, k) => equal(value, b[k]));
  if (!isObject(a) || !isObject(b)) return false;
  const keys = Object.keys(a);
  return keys.length === Object.keys(b).length && keys.every((key) => Object.hasOwn(b, key) && equal(a[key], b[key]));
}

function applyToList(list: Json[], token: string, { path, before, after }: EditOp): Json[] {
  const index = Number(token);
  if (!Number.isInteger(index) || index < 0 || index > list.length) throw new Conflict(path);
  if (before === undefined) return [...list.slice(0, index), after as Json, ...list.slice(index)];
  if (!equal(list[index], before)) throw new Conflict(path);
  return after === undefined
    ? list.filter((_, k) => k !== index)
    : list.map((value, k) => (k === index ? after : value));
}

function applyToObject(object: JsonObject, key: string, { path, before, after }: EditOp): JsonObject {
  const has = Object.hasOwn(object, key);
  if (before === undefined ? has : !has || !equal(object[key], before)) throw new Conflict(path);
  if (after !== undefined) return { ...object, [key]: after };
  const { [key]: _removed, ...rest } = object;
  return rest;
}

function applyAt(value: Json | undefined, tokens: string[], op: EditOp): Json {
  const [token, ...rest] = tokens;
  if (tokens.length === 0) {
    if (op.before !== undefined && !equal(value, op.before)) throw new Conflict(op.path);
    return op.after ?? null;
  }
  if (!Array.isArray(value) && !isObject(value)) throw new Conflict(op.path);
  if (rest.length === 0) return Array.isArray(value) ? applyToList(value, token, op) : applyToObject(value, token, op);
  const inner = child(value, token);
  if (inner === undefined) throw new Conflict(op.path);
  const changed = applyAt(inner, rest, op);
  if (Array.isArray(value)) return value.map((old, k) => (k === Number(token) ? changed : old));
  return { ...value, [token]: changed };
}

/** Applies changes one after the other, as JSON Patch does. Throws Conflict. */
export function applyOps(root: Json, ops: readonly EditOp[]): Json {
  return ops.reduce((value, op) => applyAt(value, tokensOf(op.path), op), root);
}

/** The changes that take others back. */
export const inverseOf = (ops: readonly EditOp[]): EditOp[] =>
  [...ops].reverse().map(({ path, before, after }) => ({ path, before: after, after: before }));

/** Whether a change makes or removes a value, so that values after it in a list move. */
export const isMoving = ({ before, after }: EditOp): boolean => before === undefined || after === undefined;

/** The place of a value after the change of a list; null if the value is removed. */
type Move = (pointer: string) => string | null;

function moveOf({ path, after }: EditOp, root: Json): Move {
  const isRemoval = after === undefined;
  const [list, token] = splitPointer(path);
  const isList = Array.isArray(valueAt(root, list));
  return (pointer) => {
    if (isRemoval && (pointer === path || pointer.startsWith(`${path}/`))) return null;
    if (!isList || !pointer.startsWith(`${list}/`)) return pointer;
    const [own, ...rest] = pointer.slice(list.length + 1).split("/");
    if (Number(own) < Number(token)) return pointer;
    return [list, String(Number(own) + (isRemoval ? -1 : 1)), ...rest].join("/");
  };
}

/** The places of values after changes. `root`: before them. Throws Conflict. */
export function placesAfter(ops: readonly EditOp[], root: Json): Move {
  const moves: Move[] = [];
  let value = root;
  for (const op of ops.some(isMoving) ? ops : []) {
    if (isMoving(op)) moves.push(moveOf(op, value));
    value = applyOps(value, [op]);
  }
  return (pointer) => moves.reduce<string | null>((at, move) => (at === null ? null : move(at)), pointer);
}
