// The entry point of the planner.

import { newsOf } from "./actions/news";
import { isTyping } from "./form/inputs";
import { Page } from "./frame/page";
import { Planner } from "./planner";
import { say, text } from "./text";

declare global {
  interface Window {
    /** For tests: the planner and its page. */
    shelfbeamPlanner?: { planner: Planner; page: Page };
  }
}

const address = location.href.replace(/[?#].*$/, "");
const root = document.createElement("div");
root.className = "app";
document.body.replaceChildren(root);
try {
  const planner = new Planner(address);
  const page = new Page(root, planner, address);
  planner.document.onRefused = (what, { message }) => {
    const label = (text.requests as Record<string, string>)[what] ?? what;
    planner.say(say(text.notices.refused, label, message || text.notices.changed_meanwhile), true);
  };
  planner.document.onOthers = (others) => planner.say(newsOf(others));
  // A text that has not left its field is saved; the browser asks about what has not reached the server.
  addEventListener("beforeunload", (event) => {
    const field = document.activeElement;
    if (field instanceof HTMLElement && isTyping(field)) field.blur();
    const { saving } = planner.document;
    const isWaiting = saving.state === "saving" || (saving.state === "lost" && saving.edits > 0);
    const isUnread = field instanceof HTMLElement && isTyping(field);
    // A length at a line that is being drawn waits for a button or for Enter.
    const isOpen =
      field instanceof HTMLInputElement && field.value !== "" && field.closest(".length-field, .edge-fields");
    if (isWaiting || isUnread || isOpen) event.preventDefault();
  });
  window.shelfbeamPlanner = { planner, page };
  planner.connection.open();
} catch (error) {
  const reason = document.createElement("p");
  reason.className = "failure";
  reason.textContent = say(text.access.failed, String(error));
  root.replaceChildren(reason);
}
