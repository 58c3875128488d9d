// Requests that follow the pointer: one at a time, and then the newest.

interface Waiting<Wanted, Answer> {
  wanted: Wanted;
  done: (answer: Answer | null) => void;
}

export class Newest<Wanted, Answer> {
  private next: Waiting<Wanted, Answer> | null = null;
  private isBusy = false;
  /** A stop begins another round, in which answers to earlier requests have no effect. */
  private round = 0;

  /** `rest`: passes between an answer and the next request; without it, the next one is sent before the answer is used. */
  constructor(
    private readonly ask: (wanted: Wanted) => Promise<Answer | null>,
    private readonly rest?: () => Promise<void>,
  ) {}

  /** Null if a newer request overtakes this one, or after a stop. */
  get(wanted: Wanted): Promise<Answer | null> {
    this.next?.done(null);
    return new Promise((done) => {
      this.next = { wanted, done };
      void this.send();
    });
  }

  /** Answers that are still to come have no effect. */
  stop(): void {
    ++this.round;
    this.next?.done(null);
    this.next = null;
  }

  private async send(): Promise<void> {
    const { next, round } = this;
    if (this.isBusy || !next) return;
    this.next = null;
    this.isBusy = true;
    const answer = await this.ask(next.wanted).catch(() => null);
    const sendNext = () => {
      this.isBusy = false;
      void this.send();
    };
    if (this.rest) void this.rest().then(sendNext);
    else sendNext(); // the server works while the page uses the answer
    next.done(round === this.round ? answer : null);
  }
}
