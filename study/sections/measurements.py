"""The signal of single transceivers: Figs 2.9 to 2.12 and 2.11.1."""

import numpy as np
from scipy.stats import spearmanr

from study.core import page
from study.core.findings import Section, verdict
from study.core.text import listed, percent, spread
from study.draw.store_map import signal_legend


def maps(study, signals, column, strongest):
    """Two maps per level: all labels, and the labels that the transceiver alone reaches."""
    columns = []
    for level, rows in enumerate(study.levels(signals), 1):
        pair = []
        for words, threshold in (("all", None), ("above the threshold", signals.requirement)):
            picture = study.map.signals(signals, rows, column, strongest, threshold, f"Level {level}, {words}")
            pair.append((f"Level {level}", words, picture))
        columns.append(pair)
    return columns


def section(study):
    signals = study.uniform(study.most_samples)
    sources = study.sources(signals)
    strongest = signals.mean[:, [column for _, _, column in sources]].max()
    result = Section(
        "Signals of four transceivers",
        "2.11.1, Figs 2.9–2.12",
        ("How does the light of one transceiver spread over the three shelf levels, with and without a threshold?"),
    )
    rows, correlations, ratios, shelf_ratios = [], [], [], []
    levels = study.levels(signals)
    for figure, words, column in sources:
        values = signals.mean[:, column]
        apart = np.linalg.norm(signals.labels - signals.units[column], axis=1)
        correlations.append(-spearmanr(apart, values).statistic)
        means = [float(values[level].mean()) for level in levels]
        ratios.append(max(means) / min(means))
        shelves = [
            float(values[[i for i in level if not signals.label_ids[i].startswith("F")]].mean()) for level in levels
        ]
        shelf_ratios.append(max(shelves) / min(shelves))
        reached = [int((values[level] >= signals.requirement[level]).sum()) for level in levels]
        result.add(
            page.figure(
                f"{figure}: transceiver {words} ({signals.unit_ids[column]})",
                page.small_maps(maps(study, signals, column, strongest)) + signal_legend(),
                (
                    f"{signals.samples:,} samples per label. Colours show shares of the strongest signal of "
                    "the four transceivers, on a logarithmic scale. The lower maps show the labels with at least "
                    f"{signals.requirement[0]:g} W/m²."
                ),
            )
        )
        rows += [
            (
                figure,
                words,
                signals.unit_ids[column],
                level + 1,
                label,
                *map(float, (*signals.labels[i], values[i], signals.error[i, column])),
                int(values[i] >= signals.requirement[i]),
            )
            for level, of_level in enumerate(levels)
            for i in of_level
            for label in [signals.label_ids[i]]
        ]
        study_row = (
            figure,
            words,
            f"{correlations[-1]:.2f}",
            *(f"{mean:.4f}" for mean in means),
            f"{ratios[-1]:.2f}",
            *reached,
        )
        result.tables.setdefault(
            "transceivers",
            (
                (
                    "figure",
                    "transceiver",
                    "nearer is stronger (rank correlation)",
                    "mean, level 1",
                    "level 2",
                    "level 3",
                    "highest / lowest",
                    "reached, level 1",
                    "level 2",
                    "level 3",
                ),
                [],
            ),
        )[1].append(study_row)
    result.tables["measurements"] = (
        ("figure", "transceiver", "id", "level", "label", "x", "y", "z", "signal", "standard_error", "above_threshold"),
        rows,
    )
    header, shown = result.tables["transceivers"]
    result.add(
        page.table(header, shown, numeric=range(2, 10), caption="Mean signal (W/m²) and labels reached, by level")
    )
    result.find(
        "Labels near the transceiver receive much more signal",
        "seen in all four figures",
        f"rank correlation {spread(correlations, '{:.2f}'.format)}",
        verdict(min(correlations) > 0.5, max(correlations) > 0.5),
        (
            "The nearer a label, the stronger its signal: the rank correlation is "
            f"{spread(correlations, '{:.2f}'.format)} for the four transceivers."
        ),
    )
    small = [ratio < 1.5 for ratio in ratios]
    result.find(
        "In general there is no considerable difference between levels, in certain cases there is",
        "seen in the figures",
        f"highest over lowest level mean {spread(ratios, '{:.2f}'.format)}",
        verdict(sum(small) >= 2, any(ratio < 2 for ratio in ratios)),
        f"The means of the three levels differ by factors of {spread(ratios, '{:.2f}'.format)}.",
        (
            ""
            if all(small)
            else (
                "The factor is 1.5 or more for"
                f" {listed([w for (_, w, _), s in zip(sources, small) if not s])}; without the freezer, whose"
                f" labels belong to level two, the factors are {spread(shelf_ratios, '{:.2f}'.format)}."
            )
        ),
    )
    _outliers(study, signals, sources[3], result)
    return result


def _outliers(study, signals, source, result):
    """Strong signals far from the transceiver of Fig. 2.12, which the paper explains by direct light."""
    _, words, column = source
    exact = study.reference
    apart = np.linalg.norm(signals.labels - signals.units[column], axis=1)
    far = np.flatnonzero(apart > np.median(apart))
    strong = far[np.argsort(-signals.mean[far, column])[:20]]
    seen = exact.direct[strong, column] > 0
    base = float((exact.direct[far, column] > 0).mean())
    share = float(seen.mean())
    result.find(
        "Distant labels with strong signals are within line of sight",
        "seen in the figure",
        f"{percent(share)} of the 20 strongest",
        verdict(share > 0.75 and share > base, share > base),
        (
            f"Among the labels farther than the median from the transceiver {words}, {percent(share)} of the 20"
            f" with the strongest signal see it ({percent(base)} of all)."
        ),
        reference="Fig. 2.12",
    )
