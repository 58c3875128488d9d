// Tells the server when the pointer is down: it then leaves both processors to the gesture.

import type { Connection } from "../document/connection";

export class Hold {
  private isHeld = false;

  constructor(private readonly connection: Pick<Connection, "request">) {
    for (const end of ["pointerup", "pointercancel"] as const)
      addEventListener(end, ({ buttons }) => buttons === 0 && this.set(false), true);
    addEventListener("blur", () => this.set(false));
  }

  /** Gestures begin on these. */
  listen(...surfaces: HTMLElement[]): void {
    for (const surface of surfaces) surface.addEventListener("pointerdown", () => this.set(true));
  }

  private set(isHeld: boolean): void {
    if (this.isHeld === isHeld) return;
    this.isHeld = isHeld;
    // A new connection begins without a hold.
    this.connection.request(isHeld ? "hold" : "release").catch(() => {});
  }
}
