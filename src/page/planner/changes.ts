// Notifies the parts of the page of changes, at most once per frame of the screen.

export type Topic =
  | "document"
  | "devices"
  | "warnings"
  | "light"
  | "plans"
  | "proposed"
  | "selection"
  | "layers"
  | "picture"
  | "presets"
  | "viewport"
  | "preview"
  | "tool"
  | "status";

interface Listener {
  topics: readonly Topic[];
  update: (changed: ReadonlySet<Topic>) => void;
}

export class Changes {
  /** All listeners know of the changes. */
  onFlushed: () => void = () => {};
  private changed = new Set<Topic>();
  private readonly listeners: Listener[] = [];
  private isScheduled = false;

  listen(topics: readonly Topic[], update: Listener["update"]): void {
    this.listeners.push({ topics, update });
  }

  note(...topics: Topic[]): void {
    for (const topic of topics) this.changed.add(topic);
    if (this.isScheduled) return;
    this.isScheduled = true;
    requestAnimationFrame(() => this.flush());
  }

  private flush(): void {
    this.isScheduled = false;
    const { changed } = this;
    this.changed = new Set();
    for (const { topics, update } of this.listeners) if (topics.some((topic) => changed.has(topic))) update(changed);
    this.onFlushed();
  }
}
