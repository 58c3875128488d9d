"""The margin of a placement if walls, floor and goods reflect more or less than assumed."""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import shelfbeam as sb

store = sb.Store.read(Path(__file__).parents[2] / "examples" / "thesis" / "store.json")
best = sb.place(sb.simulate(store, samples=2000))
reflectances = [0.3, 0.5, 0.6, 0.7, 0.8]
margins = []
for reflectance in reflectances:
    store.document["materials"]["paper"]["reflectance"] = reflectance
    margins.append(sb.evaluate(sb.simulate(store, samples=2000), best).margin_db)
    print(f"reflectance {reflectance}: {np.sum(margins[-1] < 0)} labels below their requirement")

figure, axes = plt.subplots(layout="constrained")
axes.boxplot(margins, labels=reflectances, whis=(0, 100))
axes.axhline(0, color="crimson", linewidth=1)
axes.set(xlabel="reflectance of all surfaces", ylabel="margin of the labels (dB)")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "sensitivity.png", dpi=150)
