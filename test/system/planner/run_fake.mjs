// node run_fake.mjs PACKAGES PAGE STORE [PORT]: serves the page with a store, for a look at it.

import { FakeServer } from "./fake_server.mjs";

const [packages, page, store, port] = process.argv.slice(2);
console.log(await new FakeServer(store, page, packages).listen(Number(port ?? 0)));
