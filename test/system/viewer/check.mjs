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

/** Something that must not hold: a test that cannot fail shows nothing. */
export function fails(run, what) {
  try {
    run();
  } catch {
    return;
  }
  throw new Error(`negative control: ${what} was not noticed`);
}

export async function runAll() {
  let failed = 0;
  for (const { name, run } of tests) {
    const begin = Date.now();
    try {
      await run();
      console.log(`ok      ${name} (${Date.now() - begin} ms)`);
    } catch (error) {
      ++failed;
      console.log(`FAILED  ${name}\n        ${error.stack}`);
    }
  }
  console.log(`${tests.length - failed} of ${tests.length} passed`);
  return failed === 0;
}
