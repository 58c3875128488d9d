// Elements with the keys of their presets and defaults, which only the server knows. Kept until the store changes.

import type { Connection } from "./connection";
import { isMoving, splitPointer, type EditOp, type JsonObject } from "./json";
import type { Details } from "./messages";

export class DetailsCache {
  private readonly known = new Map<string, Details>();
  private readonly asked = new Map<string, Promise<Details | null>>();
  private generation = 0;

  constructor(
    private readonly connection: Connection,
    /** Converts lengths to the unit of the store. */
    private readonly convert: (effective: JsonObject, units: Record<string, string>) => JsonObject,
    private readonly arrived: () => void,
  ) {}

  forget(): void {
    ++this.generation;
    this.asked.clear();
  }

  has(path: string): boolean {
    return this.known.has(path);
  }

  /** Keeps the details of elements whose paths stay, because a panel that is empty for a moment loses its scroll position. */
  follow(ops: readonly EditOp[]): void {
    const lists = ops.filter(isMoving).map(({ path }) => `${splitPointer(path)[0]}/`);
    const paths = [...this.known.keys(), ...this.asked.keys()];
    if (paths.some((path) => lists.some((list) => path.startsWith(list)))) this.clear();
  }

  clear(): void {
    this.forget();
    this.known.clear();
  }

  /** The details if they are known, perhaps those before the last change; they are asked for if necessary. */
  now(path: string): Details | null {
    if (!this.asked.has(path)) void this.of(path);
    return this.known.get(path) ?? null;
  }

  /** Null if the server has none. */
  of(path: string): Promise<Details | null> {
    const asked = this.asked.get(path);
    if (asked) return asked;
    const { generation } = this;
    const answer = this.connection.request<Details>("details", { path }).then(
      (answer) => {
        const details = {
          ...answer,
          effective: this.convert(answer.effective, answer.units ?? {}),
          inherited: this.convert({ type: answer.effective.type, ...answer.inherited }, answer.inherited_units ?? {}),
        };
        if (generation === this.generation) {
          this.known.set(path, details);
          this.arrived();
        }
        return details;
      },
      () => {
        this.known.delete(path);
        return null;
      },
    );
    this.asked.set(path, answer);
    return answer;
  }
}
