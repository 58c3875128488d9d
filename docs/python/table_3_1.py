"""Table 3.1 of the paper: non-cooperative placements at four numbers of samples, with two objectives."""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import shelfbeam as sb

PAPER = {5000: (8, 8), 25000: (6, 6), 50000: (6, 6), 100000: (5, 5)}  # transceivers; transceivers and links
samples = [int(one) for one in sys.argv[2:]] or list(PAPER)
shop = sb.Store.read(Path(__file__).parents[2] / "examples" / "thesis" / "store.json").scene()
counts = []
for number in samples:
    signals = sb.simulate(shop, samples=number, estimator="uniform", seed=1)
    answers = [sb.place(signals, model="non-cooperative", objective=one, time_limit=20) for one in ("count", "links")]
    shares = [answer.to_dict()["redundant_share"] for answer in answers]
    counts.append([answer.count for answer in answers])
    print(number, *(f"{answer.count} units, {share:.0%} redundant" for answer, share in zip(answers, shares)), sep="; ")

figure, axes = plt.subplots(layout="constrained")
place = np.arange(len(samples))
axes.bar(place - 0.2, [count for count, _ in counts], 0.35, label="this program")
axes.bar(place + 0.2, [PAPER.get(number, (0, 0))[0] for number in samples], 0.35, label="paper")
axes.set(xticks=place, xticklabels=samples, xlabel="samples per label", ylabel="transceivers")
axes.legend()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "table_3_1.png", dpi=150)
