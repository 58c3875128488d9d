// Runs `shelfbeam serve` for a folder without opening a browser, for measurements.

import { spawn } from "node:child_process";

/** `end` interrupts the server and waits until it has ended. */
export async function serve(program, folder, ...options) {
  const server = spawn(program, ["serve", folder, "--no-browser", "--json", ...options]);
  const address = await new Promise((resolve) => {
    let out = "";
    server.stdout.on("data", (bytes) => {
      out += bytes;
      if (out.includes("}")) resolve(JSON.parse(out).address);
    });
  });
  const end = () => {
    server.kill("SIGINT");
    return new Promise((resolve) => server.on("exit", resolve));
  };
  return { address, pid: server.pid, end };
}
