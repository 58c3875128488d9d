// The dialog that makes a transceiver type of an emission profile: its polar picture, its name, and its flux.

import { say } from "../../data/text";
import { element } from "../../panel/dom";
import { EditBuilder } from "../document/edit";
import { isObject, pointerTo, valueAt, type JsonObject } from "../document/json";
import { numbersOf } from "../geometry/lengths";
import { firstFree } from "../elements/row_ids";
import type { Host } from "./host";
import { polarPicture, type Photometry } from "./polar";
import { text } from "./text";

const list = "/transceiver_types";

const field = (label: string, control: HTMLElement) =>
  element("label", { class: "field" }, element("span", { text: label }), control);

/** `file`: its name in the folder of the project. */
export function openProfile(host: Host, file: string, photometry: Photometry): void {
  const { planner } = host;
  const { document } = planner;
  const own = valueAt(document.json, list);
  const types = isObject(own) ? own : {};
  const stem = file.replace(/\.\w+$/, "");
  const taken = new Set([...Object.keys(types), ...(document.shared.transceiver_types ?? [])]);
  const free = taken.has(stem) ? `${stem}-${firstFree(taken, `${stem}-{n}`, 2)}` : stem;
  const name = element("input", { type: "text", value: free, "data-key": "profile-name" });
  const model = element(
    "select",
    { "data-key": "profile-model" },
    element("option", { value: "", text: text.profile.no_model }),
    ...Object.keys(types).map((type, k) => element("option", { value: type, text: type, selected: k === 0 })),
  );
  const fluxOf = (type: string) => valueAt(types, `${pointerTo("", type)}/emission/flux`);
  const flux = element("input", { type: "text", inputmode: "decimal", "data-key": "profile-flux" });
  const show = () => {
    const known = fluxOf(model.value);
    flux.value = typeof known === "number" ? String(known) : "1";
  };
  model.addEventListener("change", show);
  show();
  const says = element("p", { class: "says problem", role: "status" });
  const add = async () => {
    const type = name.value.trim();
    const found = numbersOf(flux.value).filter((watts) => watts > 0);
    const [watts] = found;
    says.textContent =
      type === "" || taken.has(type)
        ? text.profile.taken
        : found.length === 0
          ? text.profile.not_flux
          : found.length > 1
            ? say(text.form.unclear, ...found.map((one) => `${one} W`))
            : "";
    if (says.textContent !== "") return;
    const copied = types[model.value];
    const { picture: _, ...rest } = isObject(copied) ? copied : ({} as JsonObject);
    const builder = new EditBuilder(document.json);
    const emission: JsonObject = { type: photometry.type, file, flux: watts };
    builder.set(pointerTo(list, type), { ...rest, emission });
    dialog.close();
    if (!(await document.edit({ label: say(text.edits.add_type, type), ops: builder.ops }))) return;
    planner.openType(pointerTo(list, type));
    planner.say(say(text.profile.added, type));
  };
  const submit = (event: Event) => {
    event.preventDefault();
    void add();
  };
  const form = element(
    "form",
    { class: "fields", on: { submit } },
    field(text.profile.name, name),
    field(text.profile.model, model),
    field(text.profile.flux, flux),
    element("p", { class: "note", text: text.profile.flux_says }),
    says,
    element("footer", {}, element("button", { class: "primary", "data-key": "profile-add", text: text.profile.add })),
  );
  const dialog = host.openDialog(
    say(text.profile.title, file),
    "profile",
    element("div", { class: "halves" }, polarPicture(photometry, text.profile.polar), form),
  );
  name.select();
}
