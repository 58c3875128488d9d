// Runs `shelfbeam serve` for a folder without opening a browser.

import { spawn } from "node:child_process";

/** `end` interrupts the server and waits until it has ended. */
export async function serve(program, folder, ...options) {
  const server = spawn(program, ["serve", folder, "--no-browser", "--json", ...options]);
  const address = await new Promise((resolve, reject) => {
    let [out, error] = ["", ""];
    server.stdout.on("data", (bytes) => {
      out += bytes;
      if (out.includes("}")) resolve(JSON.parse(out).address);
    });
    server.stderr.on("data", (bytes) => {
      error += bytes;
    });
    server.on("exit", () => reject(new Error(error)));
  });
  const end = () => {
    const ended = new Promise((resolve) => server.on("exit", resolve));
    server.kill("SIGINT");
    return ended;
  };
  return { address, pid: server.pid, end };
}
