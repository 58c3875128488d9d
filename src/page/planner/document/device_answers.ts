// What the server says of single labels and units. Kept until the store changes.

import type { Changes } from "../changes";
import type { DeviceKind } from "./devices";
import type { StoreDocument } from "./document";
import type { DeviceAnswer } from "./messages";

export class DeviceAnswers {
  private readonly answered = new Map<string, DeviceAnswer>();
  private readonly asked = new Map<string, Promise<DeviceAnswer | null>>();
  private revision = -1;

  constructor(
    private readonly document: StoreDocument,
    private readonly changes: Changes,
  ) {}

  /** Null until the answer has come, which is noted as a change of the selection. */
  now(kind: DeviceKind, index: number): DeviceAnswer | null {
    void this.of(kind, index);
    return this.answered.get(`${kind}${index}`) ?? null;
  }

  /** Without a question to the server. */
  known(kind: DeviceKind, index: number): DeviceAnswer | null {
    return this.revision === this.document.revision ? (this.answered.get(`${kind}${index}`) ?? null) : null;
  }

  /** Null if the server does not answer. */
  of(kind: DeviceKind, index: number): Promise<DeviceAnswer | null> {
    const { revision } = this.document;
    if (revision !== this.revision) {
      this.revision = revision;
      this.answered.clear();
      this.asked.clear();
    }
    const name = `${kind}${index}`;
    const asked = this.asked.get(name) ?? this.ask(kind, index, revision);
    this.asked.set(name, asked);
    return asked;
  }

  private async ask(kind: DeviceKind, index: number, revision: number): Promise<DeviceAnswer | null> {
    try {
      const { device } = await this.document.request<{ device: DeviceAnswer }>("device", { kind, index });
      if (revision === this.revision) this.answered.set(`${kind}${index}`, device);
      this.changes.note("selection");
      return device;
    } catch {
      if (revision === this.revision) this.asked.delete(`${kind}${index}`); // it may answer later
      return null;
    }
  }
}
