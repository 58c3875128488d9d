"""The distribution of the entries of M: Fig. 3.7."""

import numpy as np

from study.core import page
from study.core.findings import Section, verdict
from study.core.text import grouped, percent
from study.draw.charts import histogram


def section(study):
    signals = study.uniform(study.most_samples)
    result = Section("Distribution of the signals", "3.5.4, Fig. 3.7", "How large are the entries of M?")
    values = signals.mean.ravel()
    threshold = signals.requirement[0]
    top = 4 * threshold
    linear = list(np.linspace(0, top, 41))
    counts = [int(c) for c in np.histogram(np.clip(values, 0, 0.999999 * top), linear)[0]]
    low, high = np.floor(np.log10(max(values.min(), 1e-6))), np.ceil(np.log10(values.max()))
    log_edges = list(10 ** np.arange(low, high + 0.01, 0.1))
    log_counts = [int(c) for c in np.histogram(np.clip(values, log_edges[0], None), log_edges)[0]]
    mark = (threshold, "threshold")
    result.add(
        page.row_of(
            [
                page.figure(
                    "All entries",
                    histogram(linear, counts, "signal, W/m²", "pairs", "Histogram of M", mark),
                    f"{grouped(study.most_samples)} samples. Entries beyond the axis are in the last bar.",
                    "as Fig. 3.7",
                ),
                page.figure(
                    "The same on a logarithmic axis",
                    histogram(log_edges, log_counts, "signal, W/m²", "pairs", "Histogram of M, logarithmic", mark, "x"),
                ),
            ]
        )
    )
    quantiles = [
        (f"{100 * q:g} %", f"{np.quantile(values, q):.5f}", percent(np.quantile(values, q) / threshold, 1))
        for q in (0.01, 0.1, 0.25, 0.5, 0.75, 0.9, 0.99)
    ]
    result.tables["matrix_quantiles"] = (("quantile", "signal, W/m²", "share of the requirement"), quantiles)
    result.tables["matrix_histogram"] = (
        ("from", "to", "pairs"),
        list(zip(map(float, log_edges), map(float, log_edges[1:]), log_counts)),
    )
    result.add(page.table(*result.tables["matrix_quantiles"], numeric=(1, 2)))
    below = float(np.mean(values < threshold / 4))
    result.find(
        "Most signals are small",
        "seen in Fig. 3.7",
        f"{percent(below)} below a quarter of the threshold",
        verdict(below > 0.5),
        (
            f"{percent(below)} of all signals are below a quarter of the threshold, and "
            f"{percent(np.mean(values >= threshold))} reach it."
        ),
    )
    return result
