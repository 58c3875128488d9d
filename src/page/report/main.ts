// The entry point of the 3-D view of a report: reads the data of the page and creates the view.

import { MissingArray } from "../data/page_data";
import { readSignals, readStore } from "./data/store";
import { say, text } from "./data/text";
import { View } from "./view";
import style from "./viewer.css";

declare global {
  interface Window {
    /** For tests: the view, or the error that prevented it. */
    shelfbeamViewer?: Promise<View>;
  }
}

async function start(root: HTMLElement): Promise<View> {
  const contentOf = (id: string) => document.getElementById(id)?.textContent ?? "";
  const store = await readStore(contentOf("viewer-store"));
  const signals = await readSignals(contentOf("viewer-signals"), store);
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(style);
  document.adoptedStyleSheets.push(sheet);
  return new View(root, store, signals);
}

const root = document.getElementById("viewer-root");
if (root) {
  const note = root.firstElementChild;
  if (note) note.textContent = text.start.loading;
  window.shelfbeamViewer = start(root);
  window.shelfbeamViewer.catch((error: unknown) => {
    root.dataset.failed = String(error);
    const reason = document.createElement("p");
    reason.className = "note";
    const cause = error instanceof MissingArray ? say(text.start.no_data, error.message) : String(error);
    reason.textContent = say(text.start.failed, cause);
    root.replaceChildren(reason);
  });
}
