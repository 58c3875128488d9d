// Tests the verdicts of a certificate in the 3-D view.

import { equal, says } from "./check.mjs";
import { verdictOf } from "./files.mjs";
import { testReport } from "./report.mjs";

const verdictsOf = (page) => page.run(({ model }) => model.store.labels.ids.map((_, label) => model.verdict(label)));
const selectLabel = (page, label) => page.run((view, index) => view.model.select({ kind: "label", index }), label);

// Changes after which the plan is no longer the certified one.
const changes = {
  "a unit less": (view) => view.model.switchUnit(view.model.store.units.selected[0], false),
  "changed requirements": (view) => {
    view.model.state.requirements[0] *= 2;
    view.model.recount();
  },
};

testReport("verdicts are shown for the original plan", { of: "certified" }, async (page, plan, given) => {
  const { labels, placement } = plan;
  const { reached, missed, undecided } = placement.certificate;
  const { open, picture } = given;
  const expected = labels.map(({ id }) => verdictOf(placement.certificate, id));
  equal(await verdictsOf(page), expected, "verdicts");
  const counts = `${reached} reached, ${missed.length} missed, ${undecided.length} undecided.`;
  says(await page.text(".v3-head"), `97.5 % confidence: ${counts}`);
  await page.evaluate(() => document.querySelector("input[name=v3-colour][value=certificate]").click());
  await page.settle();
  const legend = [`reached: ${reached}`, `missed: ${missed.length}`, `undecided: ${undecided.length}`];
  says(await page.text(".v3-legend"), "97.5 % confidence", ...legend);
  await picture(page, "certificate");
  const inCard = async (verdict) => equal(await page.text(".v3-card [data-fact=verdict]"), verdict, "in the card");
  for (const verdict of ["missed", "undecided", "reached"]) {
    await selectLabel(page, expected.indexOf(verdict));
    await inCard(verdict);
  }
  for (const [what, change] of Object.entries(changes)) {
    await page.run(change);
    equal([...new Set(await verdictsOf(page))], [null], `verdicts with ${what}`);
    await inCard("for the original plan only");
    says(await page.text(".v3-legend"), `no verdict: ${labels.length}`);
    says(await page.text(".v3-head"), "The certificate does not cover these changes.");
    await picture(page, "certificate-changed");
    await page.run((view) => view.restore(null));
    equal(await verdictsOf(page), expected, "verdicts after reset");
    await page.run((view) => (view.model.state.mode = "certificate"));
    await selectLabel(page, 0);
  }
  const again = await open(plan, { hash: await page.run((view) => view.link()), dark: true });
  equal(await again.run((view) => view.model.state.mode), "certificate", "colour in the link");
  await picture(again, "certificate-dark");
});

const asked = { of: "grocery", hash: "#view=1&colour=certificate" };
testReport("a plan without a certificate does not offer its colour", asked, async (page) => {
  equal(await page.run((view) => view.model.state.mode), "margin", "colour without a certificate");
  equal((await page.texts("input[name=v3-colour]")).length, 3, "colours");
});
