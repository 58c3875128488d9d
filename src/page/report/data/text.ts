// The texts of the view in the language of the page, which contains them.

import type { viewer } from "../../../shelfbeam/report/text/english.json";

export const text: typeof viewer = JSON.parse(document.querySelector("#viewer-texts")?.textContent ?? "{}");
export { partsOf, plural, say } from "../../data/text";
