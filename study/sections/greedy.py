"""The greedy algorithm: Table 3.2 and Fig. 3.3."""

import numpy as np

from study.core import page, paper
from study.core.findings import Section, verdict
from study.core.text import grouped, listed, percent, spread
from study.draw import charts
from study.draw.coverage_map import coverage_map


def picks(reach, with_links):
    """Algorithm 1 on a reach matrix (m x n): (column, number of newly reached labels) in the order of choice."""
    open_labels = np.ones(len(reach), dtype=bool)
    cost = 1.0 + (reach.sum(axis=0) if with_links else 0)
    order = []
    while open_labels.any():
        gains = reach[open_labels].sum(axis=0)
        if gains.max() == 0:
            raise ValueError("no candidate reaches some of the labels")
        with np.errstate(divide="ignore"):
            best = int(np.argmin(np.where(gains > 0, cost / gains, np.inf)))
        order.append((best, int(gains[best])))
        open_labels &= ~reach[:, best]
    return order


def nearest_distances(positions):
    """The distance of every transceiver to its nearest neighbour, m."""
    apart = np.linalg.norm(positions[:, None] - positions[None], axis=2)
    np.fill_diagonal(apart, np.inf)
    return apart.min(axis=1)


def section(study):
    result = Section(
        "The greedy algorithm",
        "3.5.1, Table 3.2, Fig. 3.3",
        "How much worse is the greedy algorithm, and do its transceivers form clusters?",
    )
    rows, extra, more_links = [], [], []
    for samples in study.effort.samples:
        row = [grouped(samples)]
        found = [
            study.table_answer(samples, "non-cooperative", objective, "greedy") for objective in ("count", "links")
        ]
        for k, answer in enumerate(found):
            units, share = paper.GREEDY[samples][k]
            row += [answer.units, units, percent(answer.redundant_share), f"{share} %"]
        best = study.table_answer(samples, "non-cooperative", "count")
        row.append(best.units)
        extra.append(found[0].count - best.count)
        more_links.append(found[1].redundant_share > found[0].redundant_share)
        rows.append(tuple(row))
    header = (
        "samples",
        "transceivers",
        "paper",
        "redundant",
        "paper",
        "and links: transceivers",
        "paper",
        "redundant",
        "paper",
        "fewest possible",
    )
    result.tables["table_3_2"] = (header, rows)
    result.add(page.table(header, rows, numeric=range(1, 10), paper=(2, 4, 6, 8), caption="Table 3.2"))

    samples = study.most_samples
    signals = study.uniform(samples)
    reach = signals.mean >= signals.requirement[:, None]
    figures, series, near = [], [], {}
    names = ("greedy", "greedy with links")
    for with_links, name, reference in ((False, names[0], "as Fig. 3.3a"), (True, names[1], "as Fig. 3.3b")):
        answer = study.table_answer(samples, "non-cooperative", "links" if with_links else "count", "greedy")
        order = picks(reach, with_links)
        own = {signals.unit_ids[j] for j, _ in order}
        series.append([gain for _, gain in order])
        near[name] = nearest_distances(signals.units[[j for j, _ in order]])
        note = f"The numbers give the order of choice. Closest pair: {near[name].min():.1f} m."
        if own != set(answer.selected):
            note += " (The program breaks ties by other rules and chooses other transceivers.)"
        figures.append(
            coverage_map(
                study,
                signals,
                [signals.unit_ids[j] for j, _ in order],
                f"{name}, {samples:,} samples".capitalize(),
                note,
                reference,
            )
        )
    best = study.table_answer(samples, "non-cooperative", "links")
    near["optimal"] = nearest_distances(signals.units[signals.columns(best.selected)])
    choices = range(1, max(map(len, series)) + 1)
    axes = charts.axes("choice", "labels newly reached", x_ticks=choices)
    for name, gains in zip(names, series):
        axes.plot(choices[: len(gains)], gains, label=name)
    axes.set_ylim(bottom=0)
    table_rows = [
        (name, len(values), f"{values.min():.1f}", f"{np.median(values):.1f}") for name, values in near.items()
    ]
    result.tables["clustering"] = (
        ("placement", "transceivers", "closest pair, m", "median distance to the nearest neighbour, m"),
        table_rows,
    )
    result.tables["greedy_choices"] = (
        ("placement", "choice", "labels newly reached"),
        [(name, k, gain) for name, gains in zip(names, series) for k, gain in enumerate(gains, 1)],
    )
    result.add(
        page.row_of(figures),
        page.row_of(
            [
                page.figure(
                    "Labels added by each choice", charts.chart(axes, "Labels newly reached by each greedy choice")
                ),
                page.figure("Clustering", page.table(*result.tables["clustering"], numeric=(1, 2, 3))),
            ]
        ),
    )

    printed = [paper.GREEDY[n][0][0] - paper.OPTIMAL[n][0][0] for n in study.effort.samples]
    result.find(
        "Greedy needs more transceivers than necessary",
        f"{spread(printed, '{}'.format)} more",
        f"{spread(extra, '{}'.format)} more",
        verdict(min(extra) > 0, max(extra) > 0),
        (
            f"The greedy algorithm chooses {spread(extra, '{}'.format)} transceivers more than necessary"
            f" (paper: {spread(printed, '{}'.format)})."
        ),
        reference="Table 3.2",
    )
    tail = series[0][-1], series[0][-2], series[0][-3]
    share = sum(tail) / sum(series[0])
    result.find(
        "It adds transceivers late, to close small gaps",
        "described",
        f"last three choices add {percent(share)} of the labels",
        verdict(share < 0.1, share < 0.2),
        f"Its last three of {len(series[0])} choices add {listed(tail[::-1])} of {sum(series[0])} labels.",
        reference="3.5.1",
    )
    closest, with_links, optimal = (near[name].min() for name in (*names, "optimal"))
    result.find(
        "Its transceivers form clusters",
        "seen in Fig. 3.3",
        f"closest pair {closest:.1f} m, with links {with_links:.1f} m, optimal {optimal:.1f} m",
        verdict(max(closest, with_links) < 0.6 * optimal, min(closest, with_links) < optimal),
        (
            f"The closest pair of the greedy placement is {closest:.1f} m apart, with the link term"
            f" {with_links:.1f} m; the closest pair of the optimal placement is {optimal:.1f} m apart."
        ),
        reference="Fig. 3.3",
    )
    rises = [paper.GREEDY[n][1][1] > paper.GREEDY[n][0][1] for n in study.effort.samples]
    result.find(
        "A link term can increase its redundancy",
        f"in {sum(rises)} of {len(rises)} rows",
        f"in {sum(more_links)} of {len(more_links)} rows",
        verdict(any(more_links)),
        (
            f"With the link term the redundant share is larger in {sum(more_links)} of"
            f" {len(more_links)} rows, with {listed([row[5] for row in rows])} transceivers instead of"
            f" {listed([row[1] for row in rows])}."
        ),
        (
            "The link term also charges a transceiver for labels that are already reached. Transceivers that"
            " reach few labels therefore look cheap, and the algorithm chooses many of them."
        ),
        reference="Table 3.2",
    )
    return result
