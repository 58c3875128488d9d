// The texts of the planner.

export { default as text } from "./english.json";
export { partsOf, plural, say } from "../data/text";
