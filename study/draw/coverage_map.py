"""Floor plans of placements with the labels that they reach."""

import numpy as np

from study.core import page
from study.draw.store_map import legend

ALONE = [("often", "reached by two or more"), ("once", "by one"), ("missed", "by none")]
TOGETHER = [("often", "one alone suffices"), ("once", "only together"), ("missed", "not reached")]


def coverage_map(study, signals, selected, title, note="", reference="", cooperative=False):
    """All labels; of those above each other the one that fewest reach is drawn on top."""
    columns = signals.columns(selected)
    serving = (signals.mean[:, columns] >= signals.requirement[:, None]).sum(axis=1)
    if cooperative:
        serving = np.where(signals.mean[:, columns].sum(axis=1) >= signals.requirement, serving + 1, 0)
    places = study.map.places(signals)
    layers = [
        ("often", places[serving >= 2]),
        ("once", places[serving == 1]),
        ("missed", places[serving == 0]),
        ("unit", signals.units[columns, :2]),
    ]
    shown = [*(TOGETHER if cooperative else ALONE), ("unit", "chosen transceiver")]
    return page.figure(title, study.map.picture(layers, title) + legend(shown), note, reference)
