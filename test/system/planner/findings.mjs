/** The findings of axe-core. The test injects it through the driver, past the content security policy. */
export async function findings(tab, axe) {
  await tab.page.evaluate(axe);
  return tab.page.evaluate(async () => {
    const { violations } = await window.axe.run(document, { resultTypes: ["violations"] });
    return violations.map(
      ({ id, nodes }) =>
        `${id}: ${nodes.map(({ target, failureSummary }) => `${target} ${failureSummary}`).join("; ")}`,
    );
  });
}
