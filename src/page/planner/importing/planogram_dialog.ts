// The dialog that imports a planogram: its columns and words, the lines that are left out, and the button that adds the
// labels of the others.

import { counted, grouped } from "../../data/format";
import { say } from "../../data/text";
import { button, element, replaceChildren } from "../../panel/dom";
import { EditBuilder } from "../document/edit";
import { isObject, pointerTo, valueAt } from "../document/json";
import { checkPlanogram, type Checked } from "../planogram/check";
import { guessedMapping } from "../planogram/guess";
import { faceOfFixture, faces, missingRoles, wordKinds, type Mapping, type WordKind } from "../planogram/mapping";
import { recalled, remember } from "../planogram/memory";
import { fileOf, ownLabels, sectionOf } from "../planogram/output";
import { lengthOf, type Shop } from "../planogram/shop";
import type { Table } from "../table/table";
import { BadLines } from "./bad_lines";
import { ColumnsForm } from "./columns_form";
import type { Host } from "./host";
import { roleName } from "./names";
import { preview } from "./preview";
import { text } from "./text";
import { WordList, type Choice } from "./word_list";

const section = "/planogram";

/** The type of the present planogram, the usual one, or the first. */
function usualType(shop: Shop, { planner }: Host): string {
  const present = valueAt(planner.document.json, `${section}/type`);
  return [present, "standard", shop.types[0]].find((type) => shop.types.includes(type as string)) as string;
}

class PlanogramDialog {
  private mapping: Mapping;
  private checked: Checked | null = null;
  private readonly form: ColumnsForm;
  private readonly columns = element("section", { class: "columns", "aria-label": text.planogram.columns });
  private readonly rows = element("div", {
    class: "preview",
    tabindex: 0,
    role: "group",
    "aria-label": text.planogram.preview,
  });
  private readonly lists: Record<WordKind, WordList>;
  private readonly bad = new BadLines();
  private readonly says = element("p", { class: "says", role: "status" });
  private readonly clears = element("input", {
    type: "checkbox",
    "data-key": "clear-labels",
    on: { change: () => this.set({ ...this.mapping, clears: this.clears.checked }) },
  });
  private readonly clearsText = element("span");
  private readonly clearsRow = element("label", { class: "clears" }, this.clears, this.clearsText);
  private readonly add = button("", () => void this.finish(), { class: "primary", "data-key": "add-labels" });
  readonly dialog: HTMLDialogElement;
  private readonly project: string;

  constructor(
    private readonly host: Host,
    private readonly name: string,
    private readonly table: Table,
    private readonly shop: Shop,
    private readonly source: readonly HTMLElement[],
  ) {
    const { document } = host.planner;
    this.project = `${document.name}/${document.file}`;
    const longest = Math.max(
      0,
      ...[...shop.holders.values()].flatMap((holder) => holder.faces.map((face) => lengthOf(holder, face))),
    );
    const guessed = guessedMapping(table, { unit: document.unit.name, longest, type: usualType(shop, host) });
    this.mapping = recalled(this.project, table, guessed) ?? guessed;
    if (!shop.types.includes(this.mapping.type)) this.mapping.type = guessed.type;
    this.form = new ColumnsForm(table, shop, (mapping) => this.set(mapping));
    const list = (kind: WordKind) => new WordList(kind, (word, meaning) => this.choose(kind, word, meaning));
    this.lists = { fixture: list("fixture"), face: list("face"), type: list("type") };
    const present = valueAt(document.json, section);
    const replaced = isObject(present) ? say(text.planogram.replaces, String(present.file)) : "";
    this.dialog = host.openDialog(
      say(text.planogram.title, name),
      "planogram",
      element(
        "div",
        { class: "parts" },
        this.columns,
        element(
          "div",
          { class: "content" },
          this.rows,
          ...wordKinds.map((kind) => this.lists[kind].root),
          this.bad.root,
        ),
      ),
      element(
        "footer",
        {},
        element(
          "div",
          {},
          this.says,
          this.clearsRow,
          element("p", { class: "note", text: replaced, hidden: replaced === "" }),
        ),
        this.add,
      ),
    );
    this.dialog.addEventListener("close", () => remember(this.project, this.table, this.mapping));
    this.update();
    this.focusFirst();
  }

  /** What is still unknown, or the button. */
  private focusFirst(): void {
    const unknown = this.dialog.querySelector<HTMLElement>('select[aria-invalid="true"]');
    (unknown ?? this.add).focus();
  }

  private set(mapping: Mapping): void {
    this.mapping = mapping;
    this.update();
  }

  private choose(kind: WordKind, word: string, meaning: string | null | undefined): void {
    const { [word]: _before, ...others } = this.mapping.words[kind];
    const own = meaning === undefined ? others : { ...others, [word]: meaning };
    this.set({ ...this.mapping, words: { ...this.mapping.words, [kind]: own } });
  }

  private get isReplacing(): boolean {
    return valueAt(this.host.planner.document.json, section) !== undefined;
  }

  private update(): void {
    const { mapping, table, shop } = this;
    const missing = missingRoles(mapping);
    this.checked = missing.length === 0 ? checkPlanogram(table, mapping, shop) : null;
    replaceChildren(this.columns, [...this.source, ...this.form.rows(mapping)]);
    this.rows.replaceChildren(preview(table, mapping));
    for (const kind of wordKinds)
      this.lists[kind].show([...(this.checked?.words[kind].values() ?? [])], this.choices(kind));
    this.bad.show(this.checked?.bad ?? []);
    const count = this.checked?.good.length ?? 0;
    this.add.textContent = counted(this.isReplacing ? text.planogram.replace : text.planogram.add, count);
    this.add.disabled = count === 0;
    // Copies in a row share their labels.
    const paths = new Set((this.checked?.good ?? []).flatMap(({ holder }) => (holder.labels ? [holder.path] : [])));
    const labelled = [...this.shop.holders.values()].flatMap(({ id, path }) => (paths.has(path) ? [id] : []));
    const fixtures = new Set(labelled).size;
    this.clearsRow.hidden = fixtures === 0;
    this.clears.checked = mapping.clears;
    this.clearsText.textContent = counted(text.planogram.clears, fixtures);
    this.says.textContent =
      missing.length > 0
        ? say(text.planogram.missing, missing.map((role) => roleName(mapping.form, role)).join(", "))
        : counted(text.planogram.left_out, this.checked?.bad.length ?? 0);
  }

  private choices(kind: WordKind): Choice[] {
    const { holders, types } = this.shop;
    const { form, columns } = this.mapping;
    if (kind === "type") return types.map((type) => ({ value: type, name: type }));
    if (kind === "face") return faces.map((face) => ({ value: face, name: text.planogram.faces[face] }));
    const ids = [...holders.keys()].sort((a, b) => a.localeCompare(b, "en", { numeric: true }));
    if (form === "fixtures" && columns.face !== undefined) return ids.map((id) => ({ value: id, name: id }));
    return ids.flatMap((id) => [
      { value: id, name: id },
      ...(holders.get(id)?.faces ?? []).map((face) => ({
        value: faceOfFixture(id, face),
        name: say(text.planogram.face_of, id, text.planogram.faces[face]),
      })),
    ]);
  }

  private async finish(): Promise<void> {
    const { host, checked, mapping, shop, name } = this;
    if (!checked || checked.good.length === 0) return;
    const { planner } = host;
    this.add.disabled = true;
    try {
      const file = await host.keep(name, fileOf(checked.good, mapping, shop));
      const builder = new EditBuilder(planner.document.json);
      builder.set(section, sectionOf(file, checked.good, mapping, shop, builder.get(section)));
      if (mapping.clears)
        for (const [path, value] of ownLabels(checked.good)) builder.set(pointerTo(path, "labels"), value);
      this.dialog.close();
      const label = text.edits[this.isReplacing ? "replace_planogram" : "add_planogram"];
      if (builder.ops.length > 0 && !(await planner.document.edit({ label, ops: builder.ops }))) return;
      planner.say(
        say(text.planogram.added, counted(text.counted.label, checked.good.length), file, grouped(checked.bad.length)),
      );
    } catch (error) {
      this.says.textContent = error instanceof Error ? error.message : String(error);
      this.add.disabled = false;
    }
  }
}

/** `source`: rows about the file itself. */
export function openPlanogram(
  host: Host,
  name: string,
  table: Table,
  shop: Shop,
  source: readonly HTMLElement[],
): HTMLDialogElement {
  return new PlanogramDialog(host, name, table, shop, source).dialog;
}
