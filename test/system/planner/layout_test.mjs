// Tests keyboards of other scripts, AltGr, and input methods.

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
