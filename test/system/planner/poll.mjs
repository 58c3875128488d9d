// Waits for other processes.

const patience = 30_000; // ms, on a loaded machine

/** Calls `look` until its value is right, and returns that value. `why` names the missing event. */
export async function poll(look, isRight, why, limit = patience) {
  for (const end = Date.now() + limit; ; await new Promise((done) => setTimeout(done, 20))) {
    const found = await look();
    if (isRight(found)) return found;
    if (Date.now() > end) throw new Error(`did not happen: ${await why(found)}`);
  }
}
