// Floor plans, tables, emission profiles and meshes come from a file dialog, from files that are dragged over the page, or
// from the clipboard.

import { button, element } from "../../panel/dom";
import { openDialog } from "../access/dialog";
import { showAll } from "../actions/source";
import type { Planner } from "../planner";
import { say, text } from "../text";
import { drawingPath, type Drawing } from "./drawing";
import { editDrawing } from "./edits";
import { choosePage } from "../sheet/page_choice";
import { chooseUnit } from "../sheet/unit_choice";
import { openDxf, openPdf, pageOf, Unreadable } from "../sheet/open";
import { openDevice, openTable } from "../table/open";
import { contentOf, isDevice, NotAccepted, upload, uploadPicture, type Given } from "./files";
import { replacedBy, type Source } from "./transform";

/** What the dialogs of files offer. */
const planFiles = "image/png,image/jpeg,image/webp,application/pdf,.dxf";
export const tableFiles = ".csv,.tsv,.txt,text/csv,text/tab-separated-values";
export const deviceFiles = ".ies,.ldt,.glb,.obj,.stl,.ply";

export class Arrivals {
  /** Covers the page while a file is dragged over it. */
  readonly root = element("div", { class: "drop", hidden: true }, element("p", { text: text.picture.drop }));
  private isBusy = false;

  constructor(
    private readonly planner: Planner,
    private readonly address: string,
  ) {
    const hasFiles = (event: DragEvent) => event.dataTransfer?.types.includes("Files") === true;
    const show = (event: DragEvent) => {
      if (!hasFiles(event)) return;
      event.preventDefault();
      this.root.hidden = false;
    };
    document.addEventListener("dragenter", show);
    document.addEventListener("dragover", show);
    document.addEventListener("dragleave", (event) => {
      if (event.relatedTarget === null) this.root.hidden = true;
    });
    document.addEventListener("drop", (event) => {
      this.root.hidden = true;
      if (!hasFiles(event)) return;
      event.preventDefault();
      const [file, ...others] = event.dataTransfer?.files ?? [];
      if (others.length > 0) planner.say(say(text.picture.one_file, file.name), true);
      if (file) void this.take(file);
    });
  }

  choose(accept = planFiles): void {
    const input = element("input", {
      type: "file",
      accept,
      on: {
        change: () => {
          const [file] = input.files ?? [];
          if (file) void this.take(file);
        },
      },
    });
    input.click();
  }

  /** Adds or replaces the picture, or imports a table. */
  async take(file: File): Promise<void> {
    const { planner } = this;
    if (planner.document.locked) planner.say(text.why_not.locked, true);
    if (planner.document.locked || !planner.document.isReady) return;
    if (this.isBusy || document.querySelector("dialog[open]") !== null) {
      planner.say(text.picture.busy, true);
      return;
    }
    this.isBusy = true;
    try {
      const given = await contentOf(file);
      if (given.kind === "csv" || isDevice(given.kind)) {
        await (given.kind === "csv" ? openTable : openDevice)(planner, given, this.address);
        return;
      }
      const wanted = planner.drawing ? await askToReplace() : "add";
      if (wanted === null) return;
      planner.say(say(text.picture.uploading, file.name));
      const made = await this.kept(given);
      if (made) this.place(made, wanted === "replace" ? planner.drawing : null);
    } catch (error) {
      planner.say(reasonOf(error, file.name), true);
    } finally {
      this.isBusy = false;
    }
  }

  /** Null if the person does not want it after all. */
  private kept(given: Given): Promise<Source | null> {
    if (given.kind === "pdf") return this.page(given);
    return given.kind === "dxf" ? this.sheet(given) : uploadPicture(this.address, given);
  }

  private async sheet(given: Given): Promise<Source | null> {
    const sheet = await openDxf(given.bytes, this.address);
    const { facts, size } = sheet;
    try {
      const unit = await chooseUnit(facts, given.name);
      const stored = unit === null ? null : await upload(this.address, given);
      if (unit === null || !stored) {
        sheet.close();
        return null;
      }
      this.planner.picture.offer({ file: stored.file, size }, sheet);
      return { file: stored.file, size, unit, origin: facts.origin };
    } catch (error) {
      sheet.close();
      throw error;
    }
  }

  private async page(given: Given): Promise<Source | null> {
    const file = await openPdf(given.bytes, this.address);
    try {
      const page = await choosePage(file, given.name);
      if (page === null) return null;
      const { size } = await pageOf(file, page);
      return { ...(await upload(this.address, given)), page: page === 1 ? undefined : page, size };
    } finally {
      file.close();
    }
  }

  private place(made: Source, before: Drawing | null): void {
    const { planner } = this;
    if (planner.document.locked) {
      planner.say(text.why_not.locked, true);
      return;
    }
    planner.look.set({ isShown: true, isLocked: true });
    if (!planner.isPlan) planner.setPlan(true);
    if (before) {
      const { layers } = planner.look.now;
      planner.look.set({ layers: { ...layers, [made.file]: planner.look.layersOf(before.file) } });
      const after = replacedBy(before, made, planner.document.unit);
      void editDrawing(planner, text.edits.replace_picture, after);
      const hasOwnUnit = after.unit !== undefined && !after.scale && before.unit !== after.unit;
      const isUnchecked = after.scale && !after.check && (before.check || after.unit !== undefined);
      const { replaced, replaced_unit, replaced_unchecked } = text.picture;
      planner.say(say(hasOwnUnit ? replaced_unit : isUnchecked ? replaced_unchecked : replaced, made.file));
      return;
    }
    const { file, page, unit, origin, size } = made;
    const unplaced = { scale: undefined, check: undefined, rotation_deg: undefined, crop: undefined };
    void editDrawing(planner, text.edits.add_picture, { file, page, unit, origin, size, at: [0, 0], ...unplaced });
    const isScaled = unit !== undefined;
    planner.say(say(isScaled ? text.picture.added_scaled : text.picture.added, file));
    showAll(planner);
    if (isScaled) planner.openType(drawingPath);
    else planner.setTool("scale");
  }
}

function reasonOf(error: unknown, name: string): string {
  if (error instanceof Unreadable) return `${name}: ${error.message}`;
  return error instanceof NotAccepted ? error.message : text.notices.no_connection;
}

/** Null: neither. */
function askToReplace(): Promise<"replace" | "anew" | null> {
  return new Promise((done) => {
    const choice = (answer: "replace" | "anew", name: string, says: string) =>
      element(
        "p",
        {},
        button(
          name,
          () => {
            done(answer);
            dialog.close();
          },
          { autofocus: answer === "replace" },
        ),
        says,
      );
    const dialog = openDialog(
      text.picture.ask,
      "question",
      choice("replace", text.picture.replace, text.picture.replace_says),
      choice("anew", text.picture.anew, text.picture.anew_says),
    );
    dialog.addEventListener("close", () => done(null));
  });
}
