// The values on which a plan rests: the products of labels and units, their price, and which values a person has
// confirmed.

import { button, element, replaceChildren } from "../../panel/dom";
import { counted, plain } from "../../data/format";
import { EditBuilder } from "../document/edit";
import { equal, isObject, pointerTo, splitPointer, valueAt } from "../document/json";
import type { KnownValue, Product } from "../document/messages";
import type { Planner } from "../planner";
import { say, text } from "../text";

type List = "label_types" | "transceiver_types";

/** Keys of a type whose values are those of its product. */
const keysOfProducts: Record<List, readonly string[]> = {
  label_types: ["threshold", "responsivity", "size", "name", "source", "order_number", "picture", "price"],
  transceiver_types: ["emission", "radius", "name", "source", "order_number", "picture", "fixing"],
};

export class Values {
  readonly root = element("details", { class: "plan-values" });
  private readonly summary = element("summary");
  private readonly body = element("div");
  private wasAsked = false;
  private version = "";

  constructor(private readonly planner: Planner) {
    this.root.append(this.summary, this.body);
  }

  update(): void {
    const { document, plans } = this.planner;
    const { values } = document;
    this.root.hidden = values.length === 0;
    const open = values.filter(({ state }) => state === "assumed");
    const rest = values.filter(({ state }) => state === "given");
    this.summary.textContent =
      open.length > 0
        ? counted(text.values.assumed, open.length)
        : rest.length > 0
          ? counted(text.values.given, rest.length)
          : text.values.all_confirmed;
    // It is asked once, before the first plan.
    if (!this.wasAsked && document.isReady && open.length > 0 && plans.runs.length === 0) {
      this.wasAsked = true;
      this.root.open = true;
    }
    // A price that is being typed stays until the values change.
    const version = JSON.stringify([values, document.products, document.locked, valueAt(document.json, "/currency")]);
    if (version === this.version) return;
    this.version = version;
    const unconfirmed = [...open, ...rest];
    replaceChildren(this.body, [
      element("p", { class: "note", text: text.values.lead }),
      ...(Object.values(document.products).every((list) => list.length === 0)
        ? [element("p", { class: "note", text: text.values.no_products })]
        : []),
      ...this.types("label_types", "threshold"),
      ...this.types("transceiver_types", "power"),
      ...this.prices(),
      ...values.map((value) => this.row(value)),
      ...(unconfirmed.length > 1
        ? [
            button(text.values.confirm_all, () => this.confirm(unconfirmed, text.values.confirm_all), {
              disabled: document.locked !== null,
              "data-key": "confirm-all",
            }),
          ]
        : []),
    ]);
  }

  private edit(label: string, change: (builder: EditBuilder) => void): void {
    const { document } = this.planner;
    const builder = new EditBuilder(document.json);
    change(builder);
    if (builder.ops.length > 0) void document.edit({ label, ops: builder.ops });
  }

  private confirm(values: readonly KnownValue[], label: string): void {
    this.edit(label, (builder) => {
      for (const { mark, value } of values) builder.set(`/confirmed${mark}`, value);
    });
  }

  private row(value: KnownValue): HTMLElement {
    const { words, mark, state } = value;
    // A confirmed distance of a label is only as well known as the power of its unit.
    const held = valueAt(this.planner.document.json, `/confirmed${mark}`);
    const isConfirmed = state === "confirmed" || (held !== undefined && equal(held, value.value));
    const change = () => {
      if (isConfirmed)
        this.edit(say(text.values.take_back, words), (builder) => builder.set(`/confirmed${mark}`, undefined));
      else this.confirm([value], say(text.values.confirm, words));
    };
    const place = this.placeOf(value);
    return element(
      "div",
      { class: "value" },
      element("input", {
        type: "checkbox",
        checked: isConfirmed,
        disabled: this.planner.document.locked !== null,
        title: text.values.confirm_says,
        "aria-label": say(text.values.confirm, words),
        "data-key": `confirm-${mark}`,
        on: { change },
      }),
      place === null
        ? element("span", { text: words })
        : button(words, () => this.go(place), {
            class: "plain",
            title: text.values.change,
            "data-key": `change-${mark}`,
          }),
      element("small", { class: `state ${state}`, text: text.values.states[state] }),
    );
  }

  /** Leaves its place to the plan that begins. */
  close(): void {
    this.root.open = false;
  }

  /** Where the store has the value; null: in a catalogue. */
  private placeOf({ kind, mark }: KnownValue): string | null {
    const path = kind === "height" ? "/room" : splitPointer(mark)[0];
    return valueAt(this.planner.document.json, path) === undefined ? null : path;
  }

  private go(path: string): void {
    const { selection } = this.planner;
    if (path === "/room") selection.setPaths([path]);
    else this.planner.openType(path);
  }

  /** The types in use, and the products of which they can be made. */
  private types(list: List, kind: KnownValue["kind"]): HTMLElement[] {
    const { document } = this.planner;
    const products = document.products[list];
    return document.values.flatMap(({ kind: other, of }) => {
      const path = pointerTo("", list, of);
      const own = valueAt(document.json, path);
      // A type of a catalogue is a product itself.
      if (other !== kind || !isObject(own) || products.length === 0) return [];
      const chosen = typeof own.product === "string" ? own.product : "";
      const select = element(
        "select",
        {
          disabled: document.locked !== null,
          "data-key": `product-${list}-${of}`,
          on: {
            change: ({ target }) => this.choose(list, path, (target as HTMLSelectElement).value),
          },
        },
        chosen === "" ? element("option", { value: "", text: text.values.own, selected: true }) : null,
        ...products.map((product) =>
          element("option", { value: product.name, text: wordsOf(product, list), selected: product.name === chosen }),
        ),
      );
      const picture = products.find(({ name }) => name === chosen)?.picture;
      return [
        element(
          "label",
          { class: "product" },
          element("span", { text: say(text.values.product[list], of) }),
          select,
          picture ? element("img", { src: picture, alt: "" }) : null,
        ),
      ];
    });
  }

  private choose(list: List, path: string, name: string): void {
    const product = this.planner.document.products[list].find((one) => one.name === name);
    if (!product) return;
    this.edit(say(text.values.choose, name), (builder) => {
      builder.set(pointerTo(path, "product"), name);
      for (const key of keysOfProducts[list]) builder.set(pointerTo(path, key), undefined);
      if (list === "transceiver_types" && product.price !== null) builder.set(pointerTo(path, "cost"), undefined);
    });
  }

  /** An empty field: the type has no price. */
  private prices(): HTMLElement[] {
    const { document } = this.planner;
    const isLocked = document.locked !== null;
    const units = document.values.filter(({ kind }) => kind === "power");
    const field = (name: string, value: string, key: string, type: string, write: (typed: string) => void) =>
      element(
        "label",
        { class: "row" },
        element("span", { text: name }),
        element("input", {
          type,
          value,
          ...(type === "number" ? { min: 0, step: "any" } : { maxlength: 8 }),
          disabled: isLocked,
          placeholder: type === "number" ? text.values.no_price : "",
          "data-key": key,
          on: { change: ({ target }) => write((target as HTMLInputElement).value.trim()) },
        }),
      );
    const rows = units.flatMap(({ of }) => {
      const path = pointerTo("/transceiver_types", of);
      const own = valueAt(document.json, path);
      if (!isObject(own)) return [];
      const product = document.products.transceiver_types.find(({ name }) => name === own.product);
      const cost = own.cost ?? product?.price ?? "";
      return [
        field(say(text.values.price, of), String(cost), `price-${of}`, "number", (typed) => {
          const amount = Number(typed);
          if (typed !== "" && !(amount >= 0)) return;
          this.edit(say(text.values.price, of), (builder) =>
            builder.set(pointerTo(path, "cost"), typed === "" ? undefined : amount),
          );
        }),
      ];
    });
    if (rows.length === 0) return [];
    const currency = valueAt(document.json, "/currency");
    return [
      ...rows,
      field(text.fields.currency, typeof currency === "string" ? currency : "", "currency", "text", (typed) =>
        this.edit(text.fields.currency, (builder) => builder.set("/currency", typed === "" ? undefined : typed)),
      ),
    ];
  }
}

function wordsOf({ name, source, order_number, amount, price }: Product, list: List): string {
  return [
    name,
    ...(order_number === "" ? [] : [order_number]),
    say(text.values.amounts[list], plain(amount)),
    ...(price === null ? [] : [say(text.values.price_each, plain(price))]),
    ...(source === null ? [] : [text.values.sources[source]]),
  ].join(", ");
}
