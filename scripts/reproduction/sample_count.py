"""The number of samples: 2.11.2 and Fig. 2.13."""

import math

import numpy as np

from reproduction import page
from reproduction.charts import Chart, decades, round_step, series_legend
from reproduction.findings import Section, verdict
from reproduction.store_map import signal_legend
from reproduction.text import grouped, minus, percent

ABOVE = 0.3  # entries from this share of the requirement on count for errors


def relative_error(signals, reference):
    """Root mean square of the relative difference from the reference, of the entries that matter."""
    matter = reference.mean >= ABOVE * reference.requirement[:, None]
    return float(np.sqrt(np.mean((signals.mean[matter] / reference.mean[matter] - 1) ** 2)))


def links(signals):
    return signals.mean >= signals.requirement[:, None]


def _wrong_side(study, truth):
    """A chart of the pairs that noise takes across the threshold."""
    counts = [
        (int((links(study.uniform(n)) & ~truth).sum()), int((~links(study.uniform(n)) & truth).sum()))
        for n in study.effort.samples
    ]
    most = max(map(max, counts))
    step = round_step(most)
    chart = Chart((3000, 200000), (0, 1.1 * most), "samples a label", "pairs", log_x=True)
    chart.ticks([5000, 25000, 100000], [k * step for k in range(int(1.1 * most / step) + 1)])
    for k in range(2):
        chart.line([(n, pair[k]) for n, pair in zip(study.effort.samples, counts)], k)
    return page.figure(
        "Pairs on the wrong side of the threshold",
        chart.svg("Pairs on the wrong side against samples")
        + series_legend(["wrongly above", "wrongly below"]),
        f"Of {grouped(truth.size)}.",
    )


def section(study):
    reference = study.reference
    result = Section(
        "Number of samples", "2.11.2, Fig. 2.13", "What do more samples change, and when are there enough?"
    )
    _, _, column = study.sources(reference)[2]
    level_two = study.levels(reference)[1]
    strongest = reference.mean[level_two, column].max()
    counts = [n for n in study.effort.samples if n != 50000]
    columns, rows = [], []
    truth = links(reference)
    for samples in counts:
        signals = study.uniform(samples)
        columns.append(
            [
                (
                    f"{grouped(samples)} samples",
                    words,
                    study.map.picture(
                        study.map.signals(signals, level_two, column, strongest, threshold), words
                    ),
                )
                for words, threshold in (("all", None), ("above the threshold", signals.requirement))
            ]
        )
    columns.append(
        [
            (
                "Reference",
                words,
                study.map.picture(
                    study.map.signals(reference, level_two, column, strongest, threshold), words
                ),
            )
            for words, threshold in (
                ("path reuse, all", None),
                ("above the threshold", reference.requirement),
            )
        ]
    )
    result.add(
        page.figure(
            f"Level two, transceiver at the centre ({reference.unit_ids[column]})",
            page.small_maps(columns, {4: "four", 2: "two"}.get(len(columns), "")) + signal_legend(),
            f"The reference is path reuse with {reference.samples:,} samples a label and a seed of its own.",
            "as Fig. 2.13",
        )
    )
    errors, false_above = [], []
    for samples in study.effort.samples:
        signals = study.uniform(samples)
        ours = links(signals)
        errors.append(relative_error(signals, reference))
        false_above.append(int((ours & ~truth)[level_two, column].sum()))
        rows.append(
            (
                grouped(samples),
                int(ours[level_two, column].sum()),
                false_above[-1],
                int((~ours & truth)[level_two, column].sum()),
                grouped(int(ours.sum())),
                grouped(int((ours & ~truth).sum())),
                grouped(int((~ours & truth).sum())),
                percent(errors[-1], 1),
            )
        )
    rows.append(("reference", int(truth[level_two, column].sum()), 0, 0, grouped(int(truth.sum())), 0, 0, ""))
    header = (
        "samples a label",
        "centre, level two: above",
        "of these wrongly",
        "wrongly below",
        "all pairs: above",
        "of these wrongly",
        "wrongly below",
        "rms relative error",
    )
    result.tables["samples"] = (header, rows)
    guide = [(x, errors[0] * math.sqrt(study.effort.samples[0] / x)) for x in (3000, 200000)]
    low, high = 10 ** math.floor(math.log10(guide[1][1])), 10 ** math.ceil(math.log10(max(errors)))
    chart = Chart(
        (3000, 200000), (low, high), "samples a label", "rms relative error", log_x=True, log_y=True
    )
    chart.ticks(
        [5000, 25000, 100000],
        decades(low, high),
        y_words=[percent(v, 0 if v >= 0.01 else 1) for v in decades(low, high)],
    )
    chart.guide(guide)
    chart.line(list(zip(study.effort.samples, errors)), 0)
    result.add(
        page.row_of(
            [
                page.figure(
                    "Error against samples",
                    chart.svg("Relative error against samples")
                    + series_legend(["uniform estimator; dotted: 1/√samples"]),
                    f"Entries from {percent(ABOVE)} of the requirement on, against the reference.",
                ),
                _wrong_side(study, truth),
            ]
        ),
        page.table(header, rows, numeric=range(1, 8)),
    )
    first, last = study.effort.samples[0], study.effort.samples[-1]
    all_false = [int((links(study.uniform(n)) & ~truth).sum()) for n in study.effort.samples]
    result.find(
        "Statistical outliers above the threshold become much fewer with samples",
        "seen in Fig. 2.13",
        (
            f"{grouped(all_false[0])} pairs wrongly above at {grouped(first)}, {grouped(all_false[-1])} at"
            f" {grouped(last)}"
        ),
        verdict(all_false[-1] < all_false[0] / 2, all_false[-1] < all_false[0]),
        (
            f"With {grouped(first)} samples {grouped(all_false[0])} of {grouped(int(truth.size))} pairs lie"
            f" above the threshold only by chance, with {grouped(last)} {grouped(all_false[-1])}."
        ),
    )
    if last == 100000:
        result.find(
            "At 100 000 samples the outliers are gone",
            "none in Fig. 2.13f",
            f"{false_above[-1]} of {len(level_two)} labels",
            verdict(false_above[-1] == 0, false_above[-1] < false_above[0]),
            (
                f"Of the centre transceiver's {len(level_two)} labels on level two {false_above[-1]} still"
                " lie wrongly above the threshold at 100 000 samples; of all pairs"
                f" {grouped(all_false[-1])} do."
            ),
            reference="Fig. 2.13f",
        )
        truth_links = [int((links(study.uniform(n)) != truth).sum()) for n in (50000, 100000)]
        result.find(
            "Beyond 100 000 samples nothing improves notably",
            "tested, not shown",
            f"rms error still {percent(errors[-1], 1)}",
            verdict(errors[-1] < 0.03, errors[-1] < 0.1),
            (
                "At 100 000 samples the rms relative error of the entries that matter is"
                f" {percent(errors[-1], 1)}, and it goes on falling with the square root of the samples."
            ),
            (
                f"Pairs on the wrong side of the threshold: {grouped(truth_links[0])} at 50 000,"
                f" {grouped(truth_links[1])} at 100 000."
            ),
            reference="3.5.4",
        )
    slope = math.log(errors[-1] / errors[0]) / math.log(last / first)
    matter = reference.mean >= ABOVE * reference.requirement[:, None]
    best = study.uniform(last)
    honest = float(
        np.sqrt(np.mean(((best.mean - reference.mean) / np.hypot(best.error, reference.error))[matter] ** 2))
    )
    result.find(
        "Convergence is hard to determine",
        "no criterion given",
        f"true error {honest:.2f} times the standard errors",
        verdict(not 0.8 < honest < 1.25),
        (
            f"At {grouped(last)} samples the differences from the reference are {honest:.2f} times the"
            " standard errors in the signal file (rms)."
        ),
        (
            "So a run tells by itself how far it has converged: batches make noise a number. "
            if 0.8 < honest < 1.25
            else (
                "So far from convergence the standard errors are too small themselves: estimates that come"
                " out low have low errors, too. "
            )
        )
        + f"The differences fall as the power {minus(slope)} of the samples; Monte Carlo has −0.5.",
    )
    return result
