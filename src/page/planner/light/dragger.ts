// Asks the server for the light of a dragged unit.

import type { PageData } from "../../data/page_data";
import { type Connection, Lost, Refused } from "../document/connection";
import type { DragAbout, DragRequest } from "../document/messages";
import { Newest } from "../document/newest";
import { Column } from "./field";

/** Where the unit is mounted, and what it sends to each label. */
export interface DragAnswer {
  about: DragAbout;
  column: Column;
}

const longest = 100; // ms that drawing delays a request

/** Until the page has drawn an answer: where the processor draws, this would slow the next answer down. */
const drawn = (): Promise<void> =>
  new Promise((done) => {
    requestAnimationFrame(() => setTimeout(done));
    setTimeout(done, longest); // the tab may be hidden
  });

export class Dragger {
  private readonly requests: Newest<DragRequest, DragAnswer | Refused>;

  /** `onAnswer` comes before the result of `move`. `unit`: its index. `isSoftware`: the processor draws the page. */
  constructor(
    private readonly connection: Pick<Connection, "request">,
    private readonly onAnswer: (unit: number, answer: DragAnswer) => void,
    isSoftware: boolean,
  ) {
    this.requests = new Newest((request) => this.ask(request), isSoftware ? drawn : undefined);
  }

  /** The result is null if a newer request overtakes this one, or the drag ends. */
  async move(request: DragRequest): Promise<DragAnswer | Refused | null> {
    const result = await this.requests.get(request);
    if (result && !(result instanceof Refused)) this.onAnswer(request.unit, result);
    return result;
  }

  /** Answers that are still to come have no effect. */
  stop(): void {
    this.requests.stop();
  }

  private async ask(request: DragRequest): Promise<DragAnswer | Refused | null> {
    try {
      const frame = await this.connection.request<PageData<DragAbout>>("drag", request);
      return { about: frame.about, column: Column.of(frame, frame.about) };
    } catch (error) {
      if (error instanceof Refused) return error;
      if (error instanceof Lost) return null;
      throw error;
    }
  }
}
