// Tests keyboards of other scripts, AltGr, input methods, and what happens to typed text when the tab closes.

import { check, equal } from "../viewer/check.mjs";
import { testPlanner } from "./opened.mjs";

/** Another layout writes `key` with a key. */
async function types(tab, key, code, held = {}) {
  await tab.evaluate(
    (name, place, more) =>
      document.activeElement.dispatchEvent(
        new KeyboardEvent("keydown", { key: name, code: place, bubbles: true, cancelable: true, ...more }),
      ),
    ...[key, code, held],
  );
  await tab.settle();
}

testPlanner("layouts: keys without Latin letters are meant by their place", { smoke: true }, async (tab) => {
  await tab.page.focus(".surface");
  await types(tab, "ц", "KeyW");
  equal(await tab.tool(), "wall");
  await tab.press("Escape", "Escape");
  await types(tab, "ф", "KeyA", { ctrlKey: true });
  check((await tab.selected()).length > 10, "Ctrl+A selects all");
  await tab.press("Escape");
  await tab.click(11, 14.4);
  await tab.press("Delete");
  await tab.steps(1);
  await types(tab, "я", "KeyZ", { ctrlKey: true });
  await tab.steps(0);
  check(await tab.isUntouched(), "Ctrl+Z takes the change back");
});

testPlanner("layouts: AltGr and input methods are for text", {}, async (tab) => {
  await tab.page.focus(".surface");
  for (const held of [{ modifierAltGraph: true }, { isComposing: true }, { keyCode: 229 }]) {
    await types(tab, "w", "KeyW", held);
    equal(await tab.tool(), "select", JSON.stringify(held));
  }
  await types(tab, "w", "KeyW");
  equal(await tab.tool(), "wall", "negative control: the key alone");
  await tab.press("Escape", "Escape");
  // Enter chooses from the list of the input method, and does not leave the field.
  await tab.click(11, 14.4);
  await tab.page.focus('[data-key="field/id"]');
  await types(tab, "Enter", "Enter", { isComposing: true });
  equal(await tab.focused(), "field/id");
  await types(tab, "Enter", "Enter");
  check((await tab.focused()) !== "field/id", "negative control: Enter alone");
});

/** Closes the tab as a person does; the result: what the browser asks. */
async function close({ page }) {
  const asked = [];
  const closed = page.waitForEvent("close");
  page.on("dialog", (dialog) => {
    asked.push(dialog.type());
    void dialog.accept();
  });
  await page.close({ runBeforeUnload: true });
  await closed;
  return asked;
}

testPlanner("closing: a typed length that has not left its field is saved", { keeps: true }, async (tab, given) => {
  const again = await given.tab(tab.server);
  equal(await close(again), [], "negative control: nothing is asked if nothing is typed");
  await tab.click(11, 14.4);
  await tab.type("field/length", "7.25");
  check(await tab.isUntouched(), "negative control: it is not saved before");
  const asked = await close(tab);
  check(
    asked.every((type) => type === "beforeunload"),
    asked.join(),
  );
  const other = await given.tab(tab.server);
  await other.reaches(({ planner }) => planner.document.json.fixtures.some(({ length }) => length === 7.25));
});

testPlanner("closing: the browser asks about what cannot be saved", { keeps: true }, async (tab) => {
  await tab.click(11, 14.4);
  await tab.type("field/length", "long");
  equal(await close(tab), ["beforeunload"]);
  check(tab.server.text === tab.server.first, "the store is untouched");
});
