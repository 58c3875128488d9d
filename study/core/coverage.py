"""What placements do on a matrix: the labels they miss, and maps of the labels they reach."""

import numpy as np

from study.core import page
from study.draw.store_map import legend
from study.core.text import grouped

LEGEND = [
    ("often", "reached by two or more"),
    ("once", "by one"),
    ("missed", "by none"),
    ("unit", "chosen transceiver"),
]


def missed(signals, selected, model):
    """Labels that a placement does not meet on a matrix."""
    chosen = signals.mean[:, signals.columns(selected)]
    got = chosen.sum(axis=1) if model == "cooperative" else chosen.max(axis=1)
    return int((got < signals.requirement).sum())


def coverage_map(study, signals, selected, title, note="", reference="", cooperative=False):
    """All labels; of those above each other the one that fewest reach is drawn on top."""
    columns = signals.columns(selected)
    serving = (signals.mean[:, columns] >= signals.requirement[:, None]).sum(axis=1)
    if cooperative:
        serving = np.where(signals.mean[:, columns].sum(axis=1) >= signals.requirement, serving + 1, 0)
    order = np.argsort(-serving, kind="stable")
    symbols = ["missed" if serving[i] == 0 else "once" if serving[i] == 1 else "often" for i in order]
    marks = study.map.labels(signals, order, symbols) + study.map.units(signals.units[columns])
    shown = [("often", "one alone suffices"), ("once", "only together"), ("missed", "not reached"), LEGEND[3]]
    return page.figure(
        title, study.map.picture(marks, title) + legend(shown if cooperative else LEGEND), note, reference
    )


def noise(study):
    """How noise moves entries across the threshold with the fewest samples."""
    noisy, truth = (
        one.mean >= one.requirement[:, None]
        for one in (study.uniform(study.effort.samples[0]), study.reference)
    )
    return (
        f"With {grouped(study.effort.samples[0])} samples noise takes"
        f" {grouped(int((truth & ~noisy).sum()))} pairs below the threshold and lifts"
        f" {grouped(int((noisy & ~truth).sum()))} above it: it opens gaps, and it closes some."
    )
