"""A heuristic of your own against the exact placement, on the same signals and with the same judge."""

import sys
from pathlib import Path

import numpy as np
import shelfbeam as sb


def greedy(signal, requirement):
    """Adds the unit with the largest gain until every label is reached."""
    missing, chosen = requirement.astype(float), []
    while missing.max() > 0:
        gain = np.minimum(signal, missing[:, None]).sum(axis=0)
        gain[chosen] = 0
        chosen.append(int(gain.argmax()))
        missing = np.maximum(missing - signal[:, chosen[-1]], 0)
    return chosen


shop = Path(__file__).parents[2] / "examples" / "grocery" / "store.json"
signals = sb.simulate(shop, samples=2000)
mine, best = greedy(signals.mean.astype(float), signals.requirement), sb.place(signals)
print(f"greedy: {len(mine)} units; exact: {best.count}, at least {best.bound:g}")
for name, selection in (("greedy", mine), ("exact", best)):
    print(f"{name}: weakest margin {sb.evaluate(signals, selection).margin_db.min():.2f} dB")
check = sb.verify(shop, mine, confidence=0.99, budget=60)  # independent samples
print(check.answer)
signals.plot_coverage(mine).savefig(sys.argv[1] if len(sys.argv) > 1 else "own_heuristic.png", dpi=150)
