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

/** A text has all these parts; its fixed spaces count as others. */
export function says(text, ...parts) {
  const plain = text.replace(/\u00a0/g, " ");
  for (const part of parts) check(plain.includes(part), `'${part}' is not said: ${plain}`);
}

/** Something that must not hold: a test that cannot fail shows nothing. */
export function fails(run, what) {
  try {
    run();
  } catch {
    return;
  }
  throw new Error(`negative control: ${what} was not noticed`);
}

/** Gives all tests what they may use; `after` follows each of them, however it ends. */
export async function runAll(given, after) {
  let failed = 0;
  for (const { name, run } of tests) {
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
  console.log(`${tests.length - failed} of ${tests.length} passed`);
  return failed === 0;
}
