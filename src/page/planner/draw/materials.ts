// The materials of drawn elements.

import { namesIn } from "../form/initial";
import type { Planner } from "../planner";

/** What a material is for. */
export type Purpose = "block" | "door" | "window";

const glass = /glass|glas\b|verre|vetro|pane/i;

/** The one that was chosen last for the purpose: at first glass for windows, and else the first of the store. */
export function materialFor({ document, settings }: Planner, purpose: Purpose): string | undefined {
  const names = namesIn(document.json, "materials", document.shared);
  const usual = purpose === "window" ? names.find((name) => glass.test(name)) : undefined;
  return settings.now.materials[purpose] ?? usual ?? names[0];
}
