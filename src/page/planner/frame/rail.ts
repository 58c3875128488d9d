// The panel at the left: one of several lists, chosen by tabs.

import { element } from "../../panel/dom";
import { icon, type IconName } from "../access/icons";
import { text } from "../text";

export type TabId = keyof typeof text.tabs;

export interface Tab {
  id: TabId;
  icon: IconName;
  content: { root: HTMLElement; update: () => void };
}

export class Rail {
  private active: TabId | null;
  private readonly buttons = new Map<TabId, HTMLButtonElement>();
  private readonly badge = element("span", { class: "badge", hidden: true });
  readonly root: HTMLElement;
  readonly side = element("aside", { class: "side", tabindex: -1 });

  constructor(
    private readonly tabs: readonly Tab[],
    private readonly changed: () => void,
  ) {
    this.active = tabs[0].id;
    this.root = element("div", {
      class: "rail",
      role: "tablist",
      "aria-orientation": "vertical",
      "aria-label": text.access.lists,
    });
    for (const tab of tabs) {
      const made = element("button", {
        type: "button",
        role: "tab",
        id: `tab-${tab.id}`,
        "aria-controls": `panel-${tab.id}`,
        title: text.tabs[tab.id],
        on: { click: () => this.open(this.active === tab.id ? null : tab.id) },
      });
      made.append(icon(tab.icon), element("span", { text: text.tabs[tab.id] }));
      if (tab.id === "problems") made.append(this.badge);
      this.buttons.set(tab.id, made);
      this.root.append(made);
      this.side.append(
        element(
          "section",
          { class: "tab", role: "tabpanel", id: `panel-${tab.id}`, "aria-labelledby": `tab-${tab.id}`, hidden: true },
          element("h2", { text: text.tabs[tab.id] }),
          tab.content.root,
        ),
      );
    }
    this.root.addEventListener("keydown", (event) => this.key(event as KeyboardEvent));
    this.show();
  }

  private key(event: KeyboardEvent): void {
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step === undefined) return;
    const all = this.tabs.map(({ id }) => id);
    const focused = all.findIndex((id) => this.buttons.get(id) === document.activeElement);
    const next = all[(focused + step + all.length) % all.length];
    this.open(next);
    this.buttons.get(next)?.focus();
    event.preventDefault();
    event.stopPropagation();
  }

  open(id: TabId | null): void {
    this.active = id;
    this.show();
    this.update();
    this.changed();
  }

  isOpen(id: TabId): boolean {
    return this.active === id;
  }

  private show(): void {
    this.side.hidden = this.active === null;
    for (const [id, made] of this.buttons) {
      const isActive = id === this.active;
      made.setAttribute("aria-selected", String(isActive));
      made.tabIndex = isActive || (this.active === null && id === this.tabs[0].id) ? 0 : -1;
      const panel = this.side.querySelector<HTMLElement>(`#panel-${id}`);
      if (panel) panel.hidden = !isActive;
    }
  }

  update(): void {
    this.tabs.find(({ id }) => id === this.active)?.content.update();
  }

  showProblems(count: number, isWrong: boolean): void {
    this.badge.hidden = count === 0;
    this.badge.textContent = String(count);
    this.badge.classList.toggle("wrong", isWrong);
  }
}
