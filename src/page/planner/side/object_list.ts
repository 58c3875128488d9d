// The list of all elements. Only rows in view are in the page; arrow keys move through all of them.

import { element } from "../../panel/dom";
import { isOn } from "../document/devices";
import { elementsOf, kinds, type ElementKind } from "../elements/kinds";
import { nameOf } from "../elements/names";
import type { Planner } from "../planner";
import { say, text } from "../text";
import { grouped } from "../../data/format";
import { markedOf } from "../plan/shapes";
import { stateOf, stateWords } from "../units/chosen";
import { deviceItem } from "../view/hit";
import type { Item } from "../view/selection";

/** An element, or a unit on the plan that is none. */
interface Row {
  item: Item;
  kind: ElementKind;
  name: string;
  /** The type or kind, in small letters. */
  note: string;
  isOnPlan: boolean;
}

/** Of the choice of kinds. */
const onPlan = "on_plan";

const rowHeight = 28; // pixels
const spare = 6; // rows beyond the view

export class ObjectList {
  private readonly search = element("input", {
    type: "search",
    placeholder: text.objects.search_short,
    "aria-label": text.objects.search,
    on: { input: () => this.update() },
  });
  private readonly kindChoice = element("select", {
    "aria-label": text.objects.kind,
    on: { change: () => this.update() },
  });
  private readonly rows = element("div", { class: "rows" });
  private readonly list = element(
    "div",
    {
      class: "object-list",
      role: "listbox",
      tabindex: 0,
      "aria-multiselectable": "true",
      "aria-label": text.objects.title,
    },
    this.rows,
  );
  private readonly note = element("p", { class: "note" });
  readonly root = element(
    "div",
    { class: "objects" },
    element("div", { class: "filter" }, this.search, this.kindChoice),
    this.list,
    this.note,
  );

  private elements: Row[] = [];
  private active = 0;
  private anchor = 0;
  private units = "";

  constructor(private readonly planner: Planner) {
    this.kindChoice.append(element("option", { value: "", text: text.objects.all }));
    this.kindChoice.append(element("option", { value: onPlan, text: text.objects.on_plan }));
    for (const kind of kinds) this.kindChoice.append(element("option", { value: kind, text: text.layers.names[kind] }));
    this.list.addEventListener("scroll", () => this.draw());
    this.list.addEventListener("keydown", (event) => {
      if (this.key(event as KeyboardEvent)) event.preventDefault();
    });
    this.list.addEventListener("pointerdown", (event) => this.press(event as PointerEvent));
    new ResizeObserver(() => this.draw()).observe(this.list);
  }

  update(): void {
    const wanted = this.search.value.trim().toLowerCase();
    const kind = this.kindChoice.value;
    const all = this.all();
    this.elements = all.filter(
      (found) =>
        (kind === "" || (kind === onPlan ? found.isOnPlan : found.kind === kind)) &&
        (wanted === "" || `${found.name} ${found.note}`.toLowerCase().includes(wanted)),
    );
    this.active = Math.min(this.active, Math.max(this.elements.length - 1, 0));
    this.rows.style.height = `${this.elements.length * rowHeight}px`;
    this.note.textContent = say(text.objects.count, grouped(this.elements.length), grouped(all.length));
    this.draw();
  }

  private all(): Row[] {
    const { document, light } = this.planner;
    const { units, parts } = document;
    const elements = elementsOf(document.json).map((found): Row => {
      const { kind, path, value } = found;
      const unit = kind === "unit" ? units.withPath(path) : undefined;
      const type = value.preset ?? value.type;
      const words = typeof type === "string" ? type : text.kinds[kind];
      const copies = parts.of(path).length;
      const isOnPlan = unit !== undefined && isOn(stateOf(units, unit));
      return {
        item: { kind: "element", path },
        kind,
        name: nameOf(found),
        note: isOnPlan
          ? stateWords(units, unit as number)
          : copies > 1
            ? say(text.objects.copies, words, copies)
            : words,
        isOnPlan,
      };
    });
    // The event of light may be older than the units.
    const known = light.units.filter(({ index }) => index < units.count && !units.isListed(index));
    return [
      ...elements,
      ...known.map(({ index, id }): Row => {
        const note = stateWords(units, index);
        return { item: deviceItem(units, index), kind: "unit", name: id, note, isOnPlan: true };
      }),
    ];
  }

  /** After a change of light: the server may know other units on the plan. */
  followUnits(): void {
    const units = this.planner.light.units.map(({ index, id }) => `${index} ${id}`).join();
    if (units === this.units) return;
    this.units = units;
    this.update();
  }

  /** After a selection elsewhere: shows the first selected row. */
  follow(): void {
    const { selection } = this.planner;
    const index = this.elements.findIndex(({ item }) => selection.has(item));
    if (index >= 0 && document.activeElement !== this.list) {
      this.active = index;
      this.anchor = index;
      this.reveal();
    }
    this.draw();
  }

  private reveal(): void {
    const { scrollTop, clientHeight } = this.list;
    const top = this.active * rowHeight;
    if (top < scrollTop) this.list.scrollTop = top;
    else if (top + rowHeight > scrollTop + clientHeight) this.list.scrollTop = top + rowHeight - clientHeight;
  }

  private draw(): void {
    const { scrollTop, clientHeight } = this.list;
    const first = Math.max(Math.floor(scrollTop / rowHeight) - spare, 0);
    const last = Math.min(Math.ceil((scrollTop + clientHeight) / rowHeight) + spare, this.elements.length);
    const shown = new Set(Array.from({ length: Math.max(last - first, 0) }, (_, k) => first + k));
    if (this.elements.length > 0) shown.add(this.active);
    const marked = markedOf(this.planner);
    this.rows.replaceChildren(...[...shown].map((index) => this.row(index, marked)));
    if (this.elements.length > 0) this.list.setAttribute("aria-activedescendant", `object${this.active}`);
    else this.list.removeAttribute("aria-activedescendant");
  }

  private row(index: number, { problems, warnings }: ReturnType<typeof markedOf>): HTMLElement {
    const { item, kind, name, note } = this.elements[index];
    const path = item.kind === "element" ? item.path : "";
    const { layers, selection } = this.planner;
    const state = problems.has(path) ? "wrong" : warnings.has(path) ? "doubtful" : "";
    const row = element(
      "div",
      {
        class: `object ${state} ${layers.isFree(kind) ? "" : "unfree"} ${index === this.active ? "active" : ""}`,
        role: "option",
        id: `object${index}`,
        "data-index": index,
        "aria-selected": String(selection.has(item)),
        "aria-setsize": this.elements.length,
        "aria-posinset": index + 1,
        "aria-disabled": layers.isFree(kind) ? undefined : "true",
      },
      element("span", { class: "name", text: name }),
      element("small", { text: note }),
    );
    if (state) row.append(element("span", { class: "state", text: text.problems.marks[state] }));
    row.style.top = `${index * rowHeight}px`;
    return row;
  }

  private select(index: number, { toggle, extend }: { toggle: boolean; extend: boolean }): void {
    const { selection, layers } = this.planner;
    const free = (k: number) => (layers.isFree(this.elements[k].kind) ? [this.elements[k].item] : []);
    this.active = index;
    if (!extend) this.anchor = index;
    if (toggle) for (const item of free(index)) selection.toggle(item);
    else if (extend) {
      const [a, b] = [Math.min(this.anchor, index), Math.max(this.anchor, index)];
      selection.set(Array.from({ length: b - a + 1 }, (_, k) => a + k).flatMap(free));
    } else selection.set(free(index));
    this.reveal();
    this.draw();
  }

  private press(event: PointerEvent): void {
    const row = event.target instanceof Element ? event.target.closest<HTMLElement>("[data-index]") : null;
    if (!row || event.button !== 0) return;
    this.select(Number(row.dataset.index), { toggle: event.ctrlKey || event.metaKey, extend: event.shiftKey });
  }

  private key(event: KeyboardEvent): boolean {
    const { key, ctrlKey, shiftKey } = event;
    const last = this.elements.length - 1;
    const page = Math.max(Math.floor(this.list.clientHeight / rowHeight) - 1, 1);
    const steps: Record<string, number> = {
      ArrowDown: this.active + 1,
      ArrowUp: this.active - 1,
      PageDown: this.active + page,
      PageUp: this.active - page,
      Home: 0,
      End: last,
    };
    if (last < 0 || event.altKey) return false;
    if (key === " " || key === "Enter") {
      this.select(this.active, { toggle: ctrlKey || key === " ", extend: shiftKey });
      return true;
    }
    if (steps[key] === undefined) return false;
    const index = Math.min(Math.max(steps[key], 0), last);
    if (ctrlKey) {
      this.active = index;
      this.reveal();
      this.draw();
    } else this.select(index, { toggle: false, extend: shiftKey });
    return true;
  }
}
