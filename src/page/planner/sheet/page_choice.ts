// Asks which page of a PDF file is the floor plan: by small pictures, drawn as they come into view, or by its number.

import { button, element } from "../../panel/dom";
import { openDialog } from "../access/dialog";
import { say, text } from "../text";
import type { PdfFile } from "./open";

const side = 150; // pixels

/** Pictures are drawn one after the other, and only those that are still in view. */
class Thumbnails {
  private readonly wanted = new Set<HTMLElement>();
  private readonly observer: IntersectionObserver;
  private isBusy = false;

  constructor(
    private readonly file: PdfFile,
    root: HTMLElement,
  ) {
    this.observer = new IntersectionObserver(
      (entries) => {
        for (const { target, isIntersecting } of entries)
          if (isIntersecting) this.wanted.add(target as HTMLElement);
          else this.wanted.delete(target as HTMLElement);
        void this.work();
      },
      { root, rootMargin: "200px" },
    );
  }

  watch(choice: HTMLElement): void {
    this.observer.observe(choice);
  }

  private async work(): Promise<void> {
    if (this.isBusy) return;
    this.isBusy = true;
    for (let [choice] = this.wanted; choice; [choice] = this.wanted) {
      this.wanted.delete(choice);
      this.observer.unobserve(choice);
      // A page that cannot be drawn keeps its number.
      await this.draw(choice).catch(() => {});
    }
    this.isBusy = false;
  }

  private async draw(choice: HTMLElement): Promise<void> {
    const bitmap = await this.file.thumbnail(Number(choice.dataset.page), side * devicePixelRatio);
    const canvas = element("canvas", { "aria-hidden": "true" });
    Object.assign(canvas, { width: bitmap.width, height: bitmap.height });
    canvas.getContext("2d")?.drawImage(bitmap, 0, 0);
    bitmap.close();
    choice.querySelector(".sheet")?.replaceChildren(canvas);
  }

  close(): void {
    this.wanted.clear();
    this.observer.disconnect();
  }
}

/** Null: none. */
export function choosePage(file: PdfFile, name: string): Promise<number | null> {
  if (file.pages === 1) return Promise.resolve(1);
  return new Promise((done) => {
    const choose = (page: number) => {
      done(page);
      dialog.close();
    };
    const number = element("input", {
      type: "number",
      min: 1,
      max: file.pages,
      value: 1,
      "aria-label": text.pdf.page,
      "data-key": "page-number",
    });
    const show = () => {
      if (number.checkValidity()) choose(number.valueAsNumber);
    };
    number.addEventListener("keydown", ({ key }) => key === "Enter" && show());
    const list = element(
      "div",
      { class: "sheets", role: "group", "aria-label": text.pdf.pages },
      ...Array.from({ length: file.pages }, (_, k) =>
        element(
          "button",
          {
            type: "button",
            "data-page": k + 1,
            "aria-label": say(text.pdf.page_number, k + 1),
            on: { click: () => choose(k + 1) },
          },
          element("span", { class: "sheet" }),
          element("span", { text: String(k + 1) }),
        ),
      ),
    );
    const dialog = openDialog(
      say(text.pdf.choose, name),
      "pages",
      element(
        "p",
        { class: "by-number" },
        element("label", {}, `${text.pdf.page} `, number),
        ` ${say(text.pdf.of, file.pages)} `,
        button(text.pdf.take, show, { "data-key": "page-take" }),
      ),
      list,
    );
    const thumbnails = new Thumbnails(file, list);
    for (const choice of list.children) thumbnails.watch(choice as HTMLElement);
    number.select();
    dialog.addEventListener("close", () => {
      thumbnails.close();
      done(null);
    });
  });
}
