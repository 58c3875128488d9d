// Tests keyboards of other scripts, AltGr, input methods, and what happens to typed text when the tab closes.

import { check, equal } from "../viewer/check.mjs";
import { testPlanner } from "./opened.mjs";

/** Another layout writes `key` with a key. */
const types = (tab, key, code, held = {}) =>
  tab.page.evaluate(
    ([name, place, more]) =>
      document.activeElement.dispatchEvent(
        new KeyboardEvent("keydown", { key: name, code: place, bubbles: true, cancelable: true, ...more }),
      ),
    [key, code, held],
  );
const tool = (tab) => tab.page.evaluate(() => window.shelfbeamPlanner.planner.tool);

testPlanner("layouts: keys without Latin letters are meant by their place", { smoke: true }, async (tab) => {
  await tab.page.focus(".surface");
  await types(tab, "ц", "KeyW");
  equal(await tool(tab), "wall");
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
    equal(await tool(tab), "select", JSON.stringify(held));
  }
  await types(tab, "w", "KeyW");
  equal(await tool(tab), "wall", "negative control: the key alone");
  await tab.press("Escape", "Escape");
  // Enter chooses from the list of the input method, and does not leave the field.
  await tab.click(11, 14.4);
  await tab.page.focus('[data-key="field/id"]');
  await types(tab, "Enter", "Enter", { isComposing: true });
  equal(await tab.page.evaluate(() => document.activeElement.dataset.key), "field/id");
  await types(tab, "Enter", "Enter");
  check(
    (await tab.page.evaluate(() => document.activeElement.dataset.key)) !== "field/id",
    "negative control: Enter alone",
  );
});

/** Closes the tab as a person does; the result: what the browser asks. */
async function close(tab) {
  const asked = [];
  const closed = tab.page.waitForEvent("close");
  tab.page.on("dialog", (dialog) => {
    asked.push(dialog.type());
    void dialog.accept();
  });
  await tab.page.close({ runBeforeUnload: true });
  await closed;
  return asked;
}

/** What a tab that the test has closed has saved. */
async function saved(server, expected) {
  const isThere = () => server.json.fixtures.some((fixture) => fixture.length === expected);
  for (const end = Date.now() + 8000; !isThere(); await new Promise((done) => setTimeout(done, 25)))
    check(Date.now() < end, `${expected} m is not saved`);
}

testPlanner("closing: a typed length that has not left its field is saved", { keeps: true }, async (tab, given) => {
  const again = await given.tab(tab.server);
  equal(await close(again), [], "negative control: nothing is asked if nothing is typed");
  await tab.click(11, 14.4);
  await tab.page.focus('[data-key="field/length"]');
  await tab.press("Control+a");
  await tab.page.keyboard.insertText("7.25");
  check(await tab.isUntouched(), "negative control: it is not saved before");
  const asked = await close(tab);
  check(
    asked.every((type) => type === "beforeunload"),
    asked.join(),
  );
  await saved(tab.server, 7.25);
});

testPlanner("closing: the browser asks about what cannot be saved", { keeps: true }, async (tab) => {
  await tab.click(11, 14.4);
  await tab.page.focus('[data-key="field/length"]');
  await tab.page.keyboard.insertText("long");
  equal(await close(tab), ["beforeunload"]);
  check(tab.server.text === tab.server.first, "the store is untouched");
});
