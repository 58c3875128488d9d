// The entry point of the 3-D view of a report: reads the data of the page and creates the view.

import { readSignals, readStore } from "./data/store";
import { View } from "./view";
import style from "./viewer.css";

declare global {
  interface Window {
    /** For tests: the view, or the error that prevented it. */
    shelfbeamViewer?: Promise<View>;
  }
}

async function start(root: HTMLElement): Promise<View> {
  const text = (id: string) => document.getElementById(id)?.textContent ?? "";
  const store = await readStore(text("viewer-store"));
  const signals = await readSignals(text("viewer-signals"), store);
  const sheet = document.createElement("style");
  sheet.textContent = style;
  document.head.append(sheet);
  return new View(root, store, signals);
}

const root = document.getElementById("viewer-root");
if (root) {
  const note = root.firstElementChild;
  if (note) note.textContent = "Loading the 3-D view …";
  window.shelfbeamViewer = start(root);
  window.shelfbeamViewer.catch((error: unknown) => {
    root.dataset.failed = String(error);
    const text = document.createElement("p");
    text.className = "note";
    text.textContent = `The 3-D view cannot be shown in this browser (${String(error)}). The plans and tables below contain the same results.`;
    root.replaceChildren(text);
  });
}
