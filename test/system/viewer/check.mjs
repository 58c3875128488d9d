// A list of tests, each with a name.

const tests = [];
export const test = (name, run, options = {}) => tests.push({ name, run, ...options });

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

/**
 * Runs tests, `lanes` at a time. Each gets a context of its own from `make`, which is closed after it, even if it fails.
 * Tests that are alone wait for each other.
 */
export async function runAll(make, { chosen = () => true, lanes = 1 } = {}) {
  const queue = tests.filter(chosen);
  const { length } = queue;
  let failed = 0;
  let free = Promise.resolve();
  const runOne = async ({ name, run }) => {
    const begin = Date.now();
    const given = await make();
    try {
      await run(given);
      console.log(`ok      ${name} (${Date.now() - begin} ms)`);
    } catch (error) {
      ++failed;
      console.log(`FAILED  ${name}\n        ${error.stack}`);
    }
    await given.close?.();
  };
  const work = async () => {
    for (let next = queue.shift(); next; next = queue.shift()) {
      const run = () => runOne(next);
      if (next.isAlone) free = free.then(run);
      await (next.isAlone ? free : run());
    }
  };
  await Promise.all(Array.from({ length: lanes }, work));
  console.log(`${length - failed} of ${length} passed`);
  return failed === 0;
}
