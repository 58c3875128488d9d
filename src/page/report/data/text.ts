// The texts of the view, from the text catalogue of the report.

export { viewer as text } from "../../../shelfbeam/report/text/english.json";
export { partsOf, plural, say } from "../../data/text";
