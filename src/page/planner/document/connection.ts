// The WebSocket to the server: requests with answers, events, and a new connection after a lost one.

import { readFrame, type PageData } from "../../data/page_data";
import type { Refusal, ServerEvent } from "./messages";

/** The server refuses a request. */
export class Refused extends Error {
  constructor(readonly refusal: Refusal) {
    super(refusal.message);
  }
}

/** The connection ended before the answer came. */
export class Lost extends Error {}

interface Waiting {
  /** An answer with arrays is a frame. */
  resolve: (answer: Record<string, unknown> | PageData<unknown>) => void;
  reject: (error: Error) => void;
}

const firstDelay = 300; // ms
const longestDelay = 5000; // ms
/** Attempts to connect again before the page looks whether the program has ended. */
const attempts = 2;

export class Connection {
  onEvent: (event: ServerEvent) => void = () => {};
  onFrame: (frame: PageData<unknown>) => void = () => {};
  onState: (open: boolean) => void = () => {};

  private socket: WebSocket | null = null;
  private readonly waiting = new Map<number, Waiting>();
  private lastId = 0;
  private delay = firstDelay;
  private failures = 0;
  /** Nothing answers at the address, or another program that does not know it. */
  hasEnded = false;

  /** `address`: of the page. */
  constructor(private readonly address: string) {}

  open(): void {
    const url = new URL("socket", this.address);
    url.protocol = url.protocol.replace("http", "ws");
    const socket = new WebSocket(url);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    socket.addEventListener("open", () => {
      this.delay = firstDelay;
      this.failures = 0;
      this.hasEnded = false;
      this.onState(true);
    });
    socket.addEventListener("message", ({ data }) => {
      if (typeof data === "string") this.receive(JSON.parse(data));
      else this.receiveFrame(readFrame(data as ArrayBuffer));
    });
    socket.addEventListener("close", () => this.closed(socket));
  }

  /** Ends the connection; a new one follows. */
  close(): void {
    this.socket?.close();
  }

  get isOpen(): boolean {
    return this.socket?.readyState === WebSocket.OPEN;
  }

  /** The number of the next request. */
  nextId(): number {
    return ++this.lastId;
  }

  /** Rejects with Refused or Lost. */
  request<Answer>(what: string, members: object = {}, id = this.nextId()): Promise<Answer> {
    return new Promise<Answer>((resolve, reject) => {
      if (!this.isOpen) {
        reject(new Lost());
        return;
      }
      this.waiting.set(id, { resolve: resolve as Waiting["resolve"], reject });
      this.socket?.send(JSON.stringify({ id, do: what, ...members }));
    });
  }

  private receive(message: { id?: number; error?: Refusal } & Record<string, unknown>): void {
    if (message.id === undefined) {
      this.onEvent(message as unknown as ServerEvent);
      return;
    }
    const waiting = this.waiting.get(message.id);
    this.waiting.delete(message.id);
    if (message.error) waiting?.reject(new Refused(message.error));
    else waiting?.resolve(message);
  }

  private receiveFrame(frame: PageData<{ id?: number }>): void {
    const { id } = frame.about;
    if (id === undefined) {
      this.onFrame(frame);
      return;
    }
    this.waiting.get(id)?.resolve(frame);
    this.waiting.delete(id);
  }

  private closed(socket: WebSocket): void {
    if (socket !== this.socket) return;
    this.socket = null;
    const lost = [...this.waiting.values()];
    this.waiting.clear();
    for (const { reject } of lost) reject(new Lost());
    this.onState(false);
    setTimeout(() => this.open(), this.delay);
    this.delay = Math.min(2 * this.delay, longestDelay);
    if (++this.failures > attempts) void this.examine();
  }

  private async examine(): Promise<void> {
    const isThere = await fetch(this.address, { cache: "no-store" }).then(
      ({ ok }) => ok,
      () => false,
    );
    if (this.isOpen) return;
    this.hasEnded = !isThere;
    this.onState(false);
  }
}
