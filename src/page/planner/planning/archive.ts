// The whole project as one file.

import { button, element } from "../../panel/dom";
import type { Planner } from "../planner";
import { say, text } from "../text";

export function archiveOf(planner: Planner, address: string): HTMLElement {
  const status = element("p", { class: "note", role: "status" });
  const save = async () => {
    start.disabled = true;
    status.textContent = text.plans.archive_packing;
    const done = await planner.document.ask<{ archive: { files: number; bytes: number } }>(
      "archive",
      {},
      text.plans.archive,
    );
    start.disabled = false;
    status.textContent = done
      ? say(text.plans.archive_done, String(done.archive.files), (done.archive.bytes / 1e6).toFixed(1))
      : "";
    const href = new URL("archive", address).href;
    if (done) element("a", { href, download: `${planner.title}.zip` }).click();
  };
  const start = button(text.plans.archive, () => void save(), { title: text.plans.archive_says });
  return element("section", {}, start, status);
}
