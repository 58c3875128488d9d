// The weakest of the labels that lie on one point of the plan, and the weakest of all.

/** Labels of one point have one group; `strength`: smaller for weaker labels. The result is 1 for the weakest shown. */
export function weakestOfGroups(
  groups: Uint32Array,
  strength: Float32Array,
  isShown: (label: number) => boolean,
): Uint8Array {
  const count = Math.min(groups.length, strength.length);
  const best = new Int32Array(groups.length).fill(-1);
  for (let label = 0; label < count; ++label) {
    if (!isShown(label)) continue;
    const other = best[groups[label]];
    if (other < 0 || strength[label] < strength[other]) best[groups[label]] = label;
  }
  const front = new Uint8Array(groups.length);
  for (const label of best) if (label >= 0) front[label] = 1;
  return front;
}

/** The `most` weakest labels, the weakest first. */
export function weakestLabels(strength: Float32Array, most: number): number[] {
  const found: number[] = [];
  for (let label = 0; label < strength.length; ++label) {
    if (found.length === most && strength[label] >= strength[found[most - 1]]) continue;
    let at = found.length;
    while (at > 0 && strength[label] < strength[found[at - 1]]) --at;
    found.splice(at, 0, label);
    if (found.length > most) found.pop();
  }
  return found;
}
