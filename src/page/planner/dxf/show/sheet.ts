// A DXF drawing, which a worker reads and draws.

import type { Point } from "../../document/messages";
import { inTime, type Lines, type Region, type Sheet, type SheetLayer } from "../../sheet/sheet";
import type { Answer, DxfFacts, Request } from "./messages";

type Fault = Extract<Answer, { fault: unknown }>;

/** The file cannot be read. */
export class DxfFault extends Error {
  constructor(readonly given: Fault) {
    super(given.fault);
  }
}

/** Questions are answered one after the other, until one takes too long. */
class Reader {
  private readonly worker: Worker;
  private isLate = false;
  private last: Promise<unknown> = Promise.resolve();

  constructor(address: string) {
    this.worker = new Worker(`${address}dxf/worker.js`, { type: "module" });
  }

  ask<Kind extends Exclude<Answer, Fault>>(request: Request, transferred: Transferable[] = []): Promise<Kind> {
    const given = (): Promise<Kind> =>
      new Promise<Kind>((done, failed) => {
        this.worker.onmessage = ({ data }: MessageEvent<Answer>) =>
          "fault" in data ? failed(new DxfFault(data)) : done(data as Kind);
        this.worker.onerror = () => failed(new DxfFault({ fault: "stopped", values: {} }));
        this.worker.postMessage(request, transferred);
      });
    const answer = this.last.then(() => {
      if (this.isLate) throw this.late();
      return inTime(given(), () => this.late());
    });
    this.last = answer.catch(() => {});
    return answer;
  }

  private late(): DxfFault {
    this.isLate = true;
    this.close();
    return new DxfFault({ fault: "slow", values: {} });
  }

  close(): void {
    this.worker.terminate();
  }
}

export class DxfSheet implements Sheet {
  readonly size: Point;
  readonly layers: readonly SheetLayer[];
  private hidden: number[];

  private constructor(
    private readonly reader: Reader,
    readonly facts: DxfFacts,
  ) {
    this.size = facts.size;
    this.layers = facts.layers;
    this.hidden = [...facts.layers.keys()].filter((k) => !facts.layers[k].isOn);
  }

  /** `address`: of the page. Throws DxfFault. */
  static async open(bytes: ArrayBuffer, address: string): Promise<DxfSheet> {
    const reader = new Reader(address);
    try {
      const { facts } = await reader.ask<{ facts: DxfFacts }>({ read: bytes }, [bytes]);
      return new DxfSheet(reader, facts);
    } catch (error) {
      reader.close();
      throw error;
    }
  }

  hide(layers: ReadonlySet<number>): void {
    this.hidden = [...layers];
  }

  async render(region: Region, scale: number): Promise<ImageBitmap> {
    const { hidden } = this;
    const { bitmap } = await this.reader.ask<{ bitmap: ImageBitmap }>({ render: region, scale, hidden });
    return bitmap;
  }

  async lines(): Promise<Lines> {
    const { lines } = await this.reader.ask<{ lines: Lines }>({ lines: true });
    return lines;
  }

  close(): void {
    this.reader.close();
  }
}
