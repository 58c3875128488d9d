"""Signal beyond the threshold in both models: Fig. 3.5."""

import numpy as np

from study.core import page, paper
from study.core.findings import Section, verdict
from study.core.text import grouped, percent
from study.draw.charts import histogram


def excess(signals, selected):
    """The percentage by which the sum of signals at each label exceeds the requirement."""
    total = signals.mean[:, signals.columns(selected)].sum(axis=1)
    return 100 * (total - signals.requirement) / signals.requirement


def same_count(study, signal_file, threshold, count):
    """A cooperative placement of `count` transceivers, for the smallest raised threshold that requires them.

    The threshold rises in steps of 5 % of the original one. The count grows with it, so the steps are bisected. None
    if no threshold requires exactly `count`.
    """

    def factor(step):
        return 1 + 0.05 * step

    def answer(step, objective):
        return study.place(
            f"raised-{study.most_samples}-{step}-{objective}",
            signal_file,
            "--threshold",
            f"{factor(step) * threshold:.6g}",
            "--objective",
            objective,
        )

    low, high = 0, 64  # the last step known to need fewer; a step that may need `count`
    while high - low > 1:
        middle = (low + high) // 2
        found = answer(middle, "count").count
        if found is None or found >= count:
            high = middle
        else:
            low = middle
    best = answer(high, "signal")
    return (factor(high), best) if best.count == count else None


def section(study):
    result = Section(
        "Excess signal", "3.5.3, Fig. 3.5", "By how much do the signals exceed the threshold in either model?"
    )
    samples = study.most_samples
    signals = study.uniform(samples)
    alone = study.table_answer(samples, "non-cooperative", "links")
    together = study.table_answer(samples, "cooperative", "signal")
    shown = [
        (f"Non-cooperative, {alone.count} transceivers", alone, "as Fig. 3.5a", ""),
        (f"Cooperative, {together.count} transceivers", together, "as Fig. 3.5b", ""),
    ]
    raised = same_count(study, study.uniform_file(samples), signals.requirement[0], alone.count)
    if raised and alone.count > together.count:
        shown.append(
            (
                f"Cooperative, {raised[1].count} transceivers",
                raised[1],
                "as Fig. 3.5c",
                (
                    f"Chosen for a threshold {raised[0]:.2f} times as high, which requires this count; the"
                    " excess is over the true threshold."
                ),
            )
        )
    values = [excess(signals, answer.selected) for _, answer, _, _ in shown]
    edges = list(range(0, 1050, 50))
    counts = [[int(c) for c in np.histogram(np.clip(one, 0, 999), edges)[0]] for one in values]
    most = max(map(max, counts))
    figures = [
        page.figure(
            title,
            histogram(
                edges, count, "excess, % of the threshold", "labels", title, ticks=range(0, 1100, 200), most=most
            ),
            note,
            reference,
        )
        for (title, _, reference, note), count in zip(shown, counts)
    ]
    low, high = paper.NON_COOPERATIVE_EXCESS
    rows = [
        (
            title,
            f"{np.median(one):.0f}",
            f"{np.quantile(one, 0.25):.0f} to {np.quantile(one, 0.75):.0f}",
            f"{one.max():.0f}",
            percent(np.mean(one < paper.COOPERATIVE_EXCESS)),
            percent(np.mean((one >= low) & (one < high))),
        )
        for (title, _, _, _), one in zip(shown, values)
    ]
    header = (
        "placement",
        "median, %",
        "middle half, %",
        "largest, %",
        "labels below 200 %",
        "labels from 400 to 500 %",
    )
    result.tables["excess"] = (header, rows)
    result.tables["excess_histograms"] = (
        ("placement", "from, %", "to, %", "labels"),
        [
            (title, low_edge, high_edge, count)
            for (title, _, _, _), of_one in zip(shown, counts)
            for low_edge, high_edge, count in zip(edges, edges[1:], of_one)
        ],
    )
    result.add(
        page.row_of(figures, "three" if len(figures) == 3 else "pair"),
        page.table(header, rows, numeric=range(1, 6), wide=(0,)),
        page.paragraph(
            (
                f"{grouped(samples)} samples; non-cooperative with the fewest links, cooperative with the"
                " least signal. In both models the signal is the sum over the chosen transceivers. The last"
                " bar includes the labels beyond 1000 %."
            ),
            "note",
        ),
    )
    share = float(np.mean(values[1] < paper.COOPERATIVE_EXCESS))
    result.find(
        "Cooperative: most labels have less than 200 % excess",
        "most",
        percent(share),
        verdict(share > 0.5),
        (
            f"{percent(share)} of the labels have less than 200 % excess with the cooperative placement; the"
            f" median is {np.median(values[1]):.0f} %."
        ),
    )
    share = float(np.mean((values[0] >= low) & (values[0] < high)))
    result.find(
        "Non-cooperative: a significant portion has 400 to 500 %",
        "a significant portion",
        percent(share),
        verdict(share > 0.1, share > 0.05),
        (
            f"{percent(share)} of the labels have 400 to 500 % excess with the non-cooperative placement; the"
            f" median is {np.median(values[0]):.0f} %."
        ),
        (
            ""
            if share > 0.1
            else ("The excess depends on the strength of the transceivers, which the paper chose freely.")
        ),
    )
    widths = [float(np.quantile(one, 0.75) - np.quantile(one, 0.25)) for one in values]
    medians = [float(np.median(one)) for one in values]
    lower = [median < medians[0] for median in medians[1:]]
    narrower = [width < widths[0] for width in widths[1:]]
    counts_of = [answer.count for _, answer, _, _ in shown]
    result.find(
        "Cooperative placements have the better distribution, even with the same count",
        "in all scenarios",
        (
            f"medians {' / '.join(f'{median:.0f}' for median in medians)} %; middle halves"
            f" {' / '.join(f'{width:.0f}' for width in widths)} points wide"
        ),
        verdict(all(lower) and all(narrower), all(lower) or all(narrower)),
        f"The median excess is {medians[0]:.0f} % without cooperation ({counts_of[0]} transceivers) and "
        + " and ".join(f"{median:.0f} % with it ({count})" for median, count in zip(medians[1:], counts_of[1:]))
        + ".",
        (
            ""
            if all(narrower)
            else (
                "The excess is smaller, but not more even: the middle half of the labels spans"
                f" {widths[0]:.0f} points without cooperation and"
                f" {' and '.join(f'{width:.0f}' for width in widths[1:])} with it."
            )
        ),
    )
    return result
