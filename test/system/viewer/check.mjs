// A list of tests that run one after the other, each with a name.

const tests = [];
export const test = (name, run) => tests.push({ name, run });

export function check(condition, message) {
  if (!condition) throw new Error(message);
}

export function equal(found, expected, what = "value") {
  const [a, b] = [JSON.stringify(found), JSON.stringify(expected)];
  check(a === b, `${what}: found ${a}, expected ${b}`);
}

export function near(found, expected, relative, what = "value") {
  check(
    Math.abs(found - expected) <= relative * Math.abs(expected),
    `${what}: found ${found}, expected ${expected} within ${relative} of it`,
  );
}

/** Expects that a text contains all parts; no-break spaces count as spaces. */
export function says(text, ...parts) {
  const plain = text.replace(/\u00a0/g, " ");
  for (const part of parts) check(plain.includes(part), `'${part}' is not said: ${plain}`);
}

/** A control that must not hold, because a test that cannot fail proves nothing. */
export function fails(run, what) {
  try {
    run();
  } catch {
    return;
  }
  throw new Error(`negative control: ${what} was not noticed`);
}

/** Passes the context to all tests with a text in their names; `after` runs after each of them, even if it fails. */
export async function runAll(given, after, text = "") {
  let failed = 0;
  const chosen = tests.filter(({ name }) => name.includes(text));
  for (const { name, run } of chosen) {
    const begin = Date.now();
    try {
      await run(given);
      console.log(`ok      ${name} (${Date.now() - begin} ms)`);
    } catch (error) {
      ++failed;
      console.log(`FAILED  ${name}\n        ${error.stack}`);
    }
    await after();
  }
  console.log(`${chosen.length - failed} of ${chosen.length} passed`);
  return failed === 0;
}
