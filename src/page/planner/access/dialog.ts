// A dialog with a title; Esc and a click beside it close it.

import { button, element } from "../../panel/dom";
import { text } from "../text";

export function openDialog(title: string, kind: string, ...content: (Node | string)[]): HTMLDialogElement {
  const dialog = element(
    "dialog",
    { class: `dialog ${kind}`, "aria-label": title },
    element(
      "header",
      {},
      element("h2", { text: title }),
      button("×", () => dialog.close(), { class: "close", "aria-label": text.access.close }),
    ),
    ...content,
  );
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
  dialog.addEventListener("keydown", (event) => event.stopPropagation());
  dialog.addEventListener("close", () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
  return dialog;
}
