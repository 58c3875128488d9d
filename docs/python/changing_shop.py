"""People in the aisles: how often each label is reached, over random states of the shop."""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import shelfbeam as sb

store = sb.Store.read(Path(__file__).parents[2] / "examples" / "thesis" / "store.json").with_people(8)
best = sb.place(sb.simulate(store, samples=2000))
signals = sb.simulate(store, states=40, hard_labels=2000)
states = signals.states
received = states.signal[:, :, best.selected].sum(axis=2)  # states x labels
share = (received >= signals.requirement[states.labels]).mean(axis=0)
print(f"{best.count} units; the worst label is reached in {share.min():.0%} of {states.count} states")
for number, state in enumerate(store.scene().states(3)):
    print(f"state {number}: {sum(outline[0].startswith('person') for outline in state.outlines)} people")

figure, axes = plt.subplots(layout="constrained")
axes.hist(share, bins=np.linspace(0.8, 1, 21))
axes.set(xlabel="share of the states in which a label is reached", ylabel="labels", yscale="log")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "changing_shop.png", dpi=150)
