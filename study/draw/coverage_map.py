"""Floor plans of placements with the labels that they reach."""

import numpy as np

from study.core import page
from study.draw.store_map import legend

ALONE = [("often", "reached by two or more"), ("once", "reached by one"), ("missed", "not reached")]
TOGETHER = [("often", "reached by one alone"), ("once", "reached only together"), ("missed", "not reached")]


def coverage_map(study, signals, selected, title, note="", reference="", cooperative=False):
    """Draws all labels. Among labels above each other, the one that the fewest transceivers reach is on top."""
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
