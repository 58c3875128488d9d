// What the page gives to the module that imports tables.

import type { openDialog } from "../access/dialog";
import type { Planner } from "../planner";
import type { text } from "../text";

export interface Host {
  planner: Planner;
  text: typeof text;
  openDialog: typeof openDialog;
  /** Keeps a file in the folder of the project; the result is its name there. */
  keep: (name: string, content: string) => Promise<string>;
}
